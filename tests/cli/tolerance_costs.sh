# long: what single errors cost, which tolerances cost the same, trials to second order
try() { lenscalc tolerance double-gauss "$@"; }
# both signs against lenses whose file has the error: RMS of spot in the same plane
cat > plain.lens << 'END'
wavelength d F
object inf
aperture stop
field angle 0 14
focus table
surface 58.950 7.520 1.670/47.1 50.4
surface 169.660 0.240 air 50.4
surface 38.550 8.050 1.670/47.1 46.0
surface 81.540 6.550 1.699/30.1 46.0
surface 25.500 11.410 air 36.0
stop - 9.000 air 34.2
surface -28.990 2.360 1.603/38.0 34.0
surface 81.540 12.130 1.658/57.3 40.0
surface -40.770 0.380 air 40.0
surface 874.130 6.440 1.717/48.0 40.0
surface -79.460 72.1 air 40.0
END
printf 'tolerance %s\n' 'R3 0.05mm' 't5 0.05mm' 'surface 7 tilt 6arcmin' 'R1..R2 0.1%' > marks.txt
lenscalc tolerance plain.lens --tolerances marks.txt --refocus none --aim stop --no-clip \
    --show sensitivity --columns perturbation,of,plus,minus --csv --digits 8
rms() { lenscalc spot "$1" --no-clip --pattern gauss --rays 21 --columns rms --csv --digits 10; }
rms plain.lens
sed 's/^surface 38.550/surface 38.600/' plain.lens > R3.lens && rms R3.lens
sed 's/^\(surface 25.500\) 11.410/\1 11.360/' plain.lens > t5.lens && rms t5.lens
sed 's/^\(surface -28.990 .*\)/\1 tilt=0.1,0/' plain.lens > tilt.lens && rms tilt.lens
# of a grade
try --show sensitivity --digits 3 | sed -n 1,8p
try --show sensitivity --criterion efl --digits 4 --columns perturbation,field,linear,plus | head -4
try --show offenders --digits 3 | head -8
try --show inverse --drop 5um --digits 3 | head -16
# other seeds, the same rays
for seed in 0 1; do
    try --seed $seed --pattern sobol --trials 1 --columns nominal --csv --digits 8
done
# proposals are tolerances, and cost what they should
try --show inverse --drop 5um --columns line --csv | tail -n +2 > proposed.txt
try --tolerances proposed.txt --show inverse --drop 5um --columns together,factor --csv --digits 4 | head -4
try --grade high --show inverse --drop 0.1um --columns together --digits 3 | tail -5
# to second order: what it says of itself, and the same whatever the threads and parts
try --method differential --trials 5000 --digits 4
try --method differential --trials 3000 --csv > whole.csv
try --method differential --trials 3000 --csv --threads 2 | cmp - whole.csv
for part in 1 2; do
    try --method differential --trials 3000 --part $part/2 -o $part.part --csv > part.csv
done
lenscalc merge [12].part | cmp - whole.csv
# drawings
try --trials 200 --limit 57um --plot spread.svg --columns trials --csv
try --trials 200 --show yield --plot yield.svg --columns trials --csv | head -2
try --show offenders --plot offenders.svg --columns rank --csv | tail -1
grep -c '<rect' spread.svg offenders.svg
grep -o '>nominal [^<]*<' spread.svg yield.svg
# refused
try --show inverse
try --drop 5um
try --show inverse --drop 0um
try --of each --plot x.svg
try --method differential --adjust t5[0,20]
try --show sensitivity --limit 5um
try --show offenders --part 1/2 -o x.part
try --show inverse --drop 5um --method differential
try --show sensitivity --trials 50
try --show inverse --drop 5um --seed 1
try --show offenders --threads 2
