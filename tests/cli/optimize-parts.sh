# long: parts of a search are the bytes of one run, whichever they are; so is a state that is gone on from
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
search() { lenscalc optimize plates.lens --vary "$vary" --rays 9 --global 4 --seed 2 --csv "$@"; }
search --keep 2 -o whole.lens > whole.csv
for i in 1 2 3; do
    search --keep 2 --part $i/3 -o part-$i.part --threads 2 > rows-$i.csv
done
lenscalc merge part-3.part part-1.part part-2.part -o merged.lens > merged.csv
cmp whole.csv merged.csv; cmp whole-1.lens merged-1.lens; cmp whole-2.lens merged-2.lens
# more parts than starts: some have none
for i in 1 2 3 4 5; do
    search --part $i/5 -o few-$i.part --columns rank,status > few-$i.csv
done
lenscalc merge few-*.part -o few.lens > few.csv
cmp few.lens merged-1.lens
cat few-*.csv | sort | uniq -c
# what is missing is said, or made do without; what is there stays
lenscalc merge part-1.part part-2.part
lenscalc merge part-1.part part-2.part --incomplete -o half.lens > half.csv; echo "status $?"
sed -n 's/^note *//p' half-1.lens
lenscalc merge part-*.part -o merged.lens > merged.csv; echo "status $?"
lenscalc merge part-*.part -o merged.lens --force > merged.csv; cmp whole.csv merged.csv
# a state: cut short, gone on from, and asked again with other rows; another question is refused
search --state one.state --seconds 0.1 > cut.csv 2> cut.err
search --keep 2 --state one.state --threads 2 -o state.lens > state.csv
cmp whole.csv state.csv; cmp whole-1.lens state-1.lens; cmp whole-2.lens state-2.lens
search --state one.state --show variables --columns rank,variable
lenscalc optimize plates.lens --vary "$vary" --rays 9 --global 4 --seed 3 --state one.state
search --state one.state --escapes 1
search --state one.state --part 1/2 -o other.part
search --state plates.lens
search --state missing/one.state
head -c 400 one.state > cut.state
search --state cut.state 2>&1 | cut -d: -f1-3
sed -i 's/42/43/' plates.lens
search --state one.state 2>&1 | sed 's/input .*/input .../'
lenscalc merge part-*.part 2>&1 | sed 's/input .*/input .../'
# refused
search --part 5/4 -o x.part
search --part 1/4
search --part 1/4 -o x.lens
search --part 1/4 --seconds 3 -o x.part
search -o x.part
lenscalc optimize plates.lens --vary c1 --state x.state
lenscalc optimize plates.lens --vary c1 --part 1/2 -o x.part
search -N 8,9 --state x.state
