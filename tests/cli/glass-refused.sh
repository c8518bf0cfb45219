# what is refused, and what is said
for words in "BK7" "N-BK8" "SCHOT:N-BK7" "N-BK7 -w 200" "N-BK7 -w q" "N-BK7 --nd 1.5..1.6" \
    "--nd 0.5" "--vd 0" "--vd 1e4" "--nd 1.5x" "--nd 1.6..1.5" "--pgf 0.5" "--like N-BK7 --nd 1.5" \
    "N-BK7 --nd 1.5" "--nd 3..4" "HWS1" "0/50" "N-BK7 --temperature 200" \
    "SCHOTT:AF32ECO --temperature 50" "N-BK7 --label F2" "N-BK7 --abbe x.svg"; do
    lenscalc glass $words
    echo "status $?"
done
mkdir -p own/glass
printf 'name\tformula\tcoefficients\nMine\ttable\t0.4:1.53 0.5:1.52 0.6:1.516 0.7:1.513\n' \
    > own/glass/ME.tsv
lenscalc glass mine -w 500,550 --lensdb own --csv --columns glass,catalog,index --digits 7
printf 'name\tformula\tcoefficients\nMine\tschott\t1 2 3\n' > own/glass/ME.tsv
lenscalc glass mine --lensdb own
echo "status $?"
printf 'name\tformula\tcoefficients\nMine\tmagic\t1 2 3\n' > own/glass/ME.tsv
lenscalc glass mine --lensdb own
echo "status $?"
printf 'name\tformula\tcoefficients\tto_um\nMine\tschott\t2.3 0 0 0 0 0\t2\n' > own/glass/ME.tsv
lenscalc glass mine --lensdb own
echo "status $?"
