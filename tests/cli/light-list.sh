# films, scenes, filters; the user's own first
lenscalc list films hp5 --csv --digits 4
lenscalc list films --kind fujifilm --columns film,onset,longest,model,confidence
lenscalc list scenes sunny --csv
lenscalc list filters --kind polarizer --columns filter,factor,published,loss --digits 3
lenscalc list films kodachrome
echo "status $?"
mkdir own
printf 'maker\tfilm\tmodel\tparameters\tonset_s\tvalid_to_s\nMy\tHP5 Plus\tpower\tp=1.5\t1\t-\n' \
    > own/films.tsv
printf 'name\tev100\nmy-room\t6.5\n' > own/scenes.tsv
printf 'name\tfactor\nmy-red\t10\n' > own/filters.tsv
lenscalc exposure --lensdb own -t 4s --film "HP5 Plus" --columns corrected_time,film
lenscalc exposure --lensdb own -N 8 --scene my-room --filter my-red+polarizer --columns time,loss
printf 'maker\tfilm\tmodel\tparameters\tonset_s\tvalid_to_s\nA\tX\tpower\tp=1.5\t1\t-\n' > own/films.tsv
printf 'B\tX\tstep\t0:0;120:0.5\t120\t1000\n' >> own/films.tsv
lenscalc exposure --lensdb own -t 4s --film X
echo "status $?"
lenscalc exposure --lensdb own -t 200s --film "B X" --csv --digits 6 --columns corrected_time
printf 'B\tY\tstep\t0:0;120\t120\t1000\n' >> own/films.tsv
lenscalc exposure --lensdb own -t 4s --film Y
echo "status $?"
printf 'name\tev100\nmy-room\tbright\n' > own/scenes.tsv
lenscalc exposure --lensdb own -N 8 --scene my-room
echo "status $?"
