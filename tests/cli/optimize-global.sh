# long: a triplet from plane plates: the same bytes whatever the number of threads is
cat > plates.lens << 'END'
lens        Triplet from plates
wavelength  d F C
field       angle 0 14 20
aperture    epd 10
focus       table
goal        poly, efl = 50 : 0.1
goal        edge > 0.5, center > 0.8, air > 0.1
surface     - 3.3 1.6204/60.3 -
surface     - 6   air         -
surface     - 1   1.62/36.4   -
surface     - 4.7 air         - stop
surface     - 3   1.6204/60.3 -
surface     - 42  air         -
END
bounds='[-0.06,0.06]'
vary="c1$bounds,c2$bounds,c3$bounds,c4$bounds,c5$bounds,c6$bounds,t2[0.5,10],t4[0.5,10],t6[25,50]"
search() { lenscalc optimize plates.lens --vary "$vary" --rays 9 "$@"; }
for threads in 0 1 2 3; do
    search --global 4 --keep 2 --seed 2 --threads $threads -o best-$threads.lens --csv \
        > rows-$threads.csv
done
for threads in 0 2 3; do
    cmp rows-1.csv rows-$threads.csv
    cmp best-1-1.lens best-$threads-1.lens
    cmp best-1-2.lens best-$threads-2.lens
done
search --global 4 --keep 2 --seed 2 --digits 4 --columns rank,merit_after,status
# what was kept is what optimize makes of it again
lenscalc optimize best-1-1.lens --vary "$vary" --rays 9 --digits 4 --columns merit_before,merit_after
# another seed, other starts; the lens itself is the first, and one start keeps no more
search --global 2 --keep 1 --seed 3 --escapes 0 --columns rank,status,search --csv
lenscalc optimize double-gauss --vary R1..R11 --goals poly,efl=100 --rays 9 --global 1 --escapes 0 \
    --digits 6 --columns merit_after,search --csv
lenscalc optimize double-gauss --vary R1..R11 --goals poly,efl=100 --rays 9 --digits 6 \
    --columns merit_after --csv
# goals and variables of each that is kept; what nothing depends on stays
search --global 4 --keep 2 --seed 2 --digits 3 --show merit --columns rank,goal,value_after
lenscalc optimize double-gauss --vary R1,R2,t11 --goals spot,efl=100 --rays 9 --global 3 \
    --show variables --digits 3 --columns rank,variable,note
# gaps keep their signs, mirrors' too
lenscalc optimize hubble-rc --vary t1,t2,k1 --goals spot,efl=57600:100 --rays 9 --global 3 \
    --show variables --columns variable,low,high --csv
# fewer minima than are to be kept: no file is made of what is not there
lenscalc optimize double-gauss --vary R1 --goals efl=101 --rays 9 --global 5 --keep 5 -o one.lens \
    --columns rank,status
ls one*
# one of an earlier run that has the name of such a file stays, and is told
touch two-2.lens
lenscalc optimize double-gauss --vary R1 --goals efl=101 --rays 9 --global 2 --keep 2 -o two.lens \
    --columns rank,status --force
# warnings are those of each lens, but for what is said of all
search --global 4 --keep 2 --seed 2 --goals 'poly, efl = 50 : 0.1, length < 3' --digits 3 \
    --columns rank,warning --csv
# seconds count for starts that have not begun
timeout 20 lenscalc optimize double-gauss --vary R1 --goals efl=101 --global 1000000 --escapes 0 \
    --seconds 0.3 --columns status --csv
# and for the last descents, of starts that all are done
search --global 2 --state two.state --columns rank,status --csv
search --global 2 --state two.state --columns rank,status --csv --seconds 1e-9
# refused
search --global 2 --show glasses
search --global 0
search --global 3 --keep 0
search --global 3 --keep 4
search --keep 4
search --escapes 4
search --global 3 --spread 0
search --global 2 --keep 2 -o -
lenscalc optimize double-gauss --vary R1 --goals efl=101 --global 5 --keep 2 -o one.lens
lenscalc optimize double-gauss --vary R1 --goals efl=101 --global 5 --glasses SCHOTT
