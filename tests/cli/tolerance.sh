# a lens as it may be made: the nominal figure is that of spot in the plane that was found
marks='tolerances.txt'
cat > $marks << 'END'
# what a shop gets wrong
tolerance R1..R11 0.1%
tolerance t1..t10 0.02mm normal
tolerance n1 0.0005
tolerance n3..n4 0.0005 truncated
tolerance V3 0.5% two-point
tolerance element 3..5 tilt 2arcmin
tolerance element 7..9 decenter 0.02mm parabolic
END
try() { lenscalc tolerance double-gauss --tolerances $marks "$@"; }
try --limit 57um --digits 6
try --refocus none --of each --trials 50 --columns of,nominal --csv --digits 10
lenscalc spot double-gauss --pattern gauss --rays 21 --columns rms --csv --digits 10
try --criterion wavefront -w d --refocus none --of each --trials 20 --columns of,nominal --csv \
    --digits 8 --rays 400
lenscalc wavefront double-gauss -w d --pattern gauss --rays 400 --columns rms --csv --digits 8
try --criterion efl --trials 500 --limit 0.1mm --digits 4
try --criterion bfl --trials 100 --columns nominal,mean --csv --digits 6
try --criterion distortion --of each --refocus none --trials 50 --columns of,nominal --csv --digits 6
lenscalc distortion double-gauss --columns distortion --csv --digits 6
try --criterion color --of each --refocus none --trials 20 --columns of,nominal --csv --digits 6
try --criterion mtf@40/mm -N 5.6 -w d --of each --refocus none --trials 20 --rays 300 --csv --digits 5 \
    --columns of,nominal
lenscalc mtf double-gauss -N 5.6 -w d --no-clip --frequency 40 --csv --digits 5 \
    --columns tangential,sagittal
try --criterion mtf@40 -N 5.6 --limit 0.5 --digits 4 --trials 50
try --criterion boresight --trials 200 --digits 4
# the limits that yields need
try --show yield --trials 400 --digits 4
# trials are the same however many there are, and whatever came before
try --show trials --trials 6 --of each --digits 6 | head -8
try --show trials --trials 300 --csv | head -7 > some.csv
try --show trials --trials 6 --csv | cmp - some.csv
# the same bytes for any threads and parts
try --trials 3000 --limit 56um --csv > whole.csv
try --trials 3000 --limit 56um --csv --threads 2 | cmp - whole.csv
for part in 1 2 3; do
    try --trials 3000 --limit 56um --csv --part $part/3 -o $part.part > part-$part.csv
done
lenscalc merge [123].part | cmp - whole.csv
lenscalc merge 1.part 3.part
lenscalc merge --incomplete 1.part 3.part | cut -d, -f 21
# what else is adjusted
try --gap last[-0.1,0.1] --trials 20 --digits 4 --columns mean,sd,compensation --csv
try --gap 5:-1,6 --adjust ay9 --trials 5 --show trials --columns trial,refocus,compensation --digits 3
# lenses that are written are what trials looked at
try --trials 40 --no-clip --aim stop --save worst:2 -o made.lens --columns worst --csv --digits 12
lenscalc spot made-1.lens --no-clip --pattern gauss --rays 21 --columns rms --csv --digits 12
grep note made-2.lens
lenscalc tolerance double-gauss -N 2,4 --seed 1 --trials 100 --columns fnumber,nominal,mean --digits 4
# lenses that fail are counted
cat > wide.lens << 'END'
wavelength d
field       angle 0
aperture epd 19.9
focus table
tolerance R1 60%
surface 10 4 1.5 -
surface - 20 air - stop
END
lenscalc tolerance wide.lens --trials 100 --limit 10mm --columns yield_fraction,failed,trials
# refused
try --part 5/4 -o x.part
try --part 1/2
try --part 1/2 --show trials -o x.part
try -o x.part
try --trials 1e10
try --save worst
try --save last:1 -o x.lens
try --criterion sport
try --trials 2.5
try --criterion mtf
try --criterion mtf@40 --clip
try --limit 3deg
try --gap 5 --refocus paraxial
try --adjust R3
try --adjust t5[9,10]
try -o x.lens
lenscalc tolerance double-gauss --grade perfect
