# tolerances that meet: two of one element, one of many surfaces, parts of a run
try() { lenscalc tolerance "$@"; }
# both surfaces about one centre: only the second moves, by 20 mm x 1 deg in x and in y, and the
# image by 0.349 mm x root 2 x 6 mm/60 mm = 49.4 um; so it is with two that add up to 1 deg
cat > half.lens << 'END'
wavelength d
object inf
field angle 0 5
aperture f/4
surface 10 20 1.5 8
surface -30 9 air 8
END
printf 'tolerance element 1..2 %s two-point\n' 'tilt 30arcmin' 'roll 30arcmin' > both.txt
echo 'tolerance element 1..2 tilt 60arcmin two-point' > one.txt
for marks in both one; do
    try half.lens --tolerances $marks.txt --criterion boresight --trials 40 --columns worst --csv \
        --digits 4
done
# each is a row of its own, with all that its line says, and the proposal is such a line
cat > marks.txt << 'END'
tolerance R1..R2 0.1% normal 3sigma
tolerance R3 3fringes
tolerance V1 0.5%
tolerance element 1..2 tilt 1arcmin pivot 2
tolerance element 1..2 roll 10arcmin
tolerance element 1..2 wedge 0.01mm
tolerance surface 1..2 irregularity 0.5fringes
END
try double-gauss --tolerances marks.txt --show inverse --drop 5um --digits 3 \
    --columns perturbation,tolerance,proposed,factor,line
try double-gauss --tolerances marks.txt --show inverse --drop 5um --columns line --csv |
    tail -n +2 > proposed.txt
try double-gauss --tolerances proposed.txt --show inverse --drop 5um --columns line --csv --digits 2
# in the unit of the lens: 12753 x 1e-7 of inches
printf '%s\n' 'unit in' 'tolerance A4_1 1e-7' 'field angle 0 5' 'aperture f/4' \
    'surface 3 0.3 1.5 1 A4=1e-6' 'surface -3 2.9 air 1' > inches.lens
try inches.lens --show inverse --drop 1um --columns factor,line --csv --digits 4
# more reasons than there is room for: counted the same by any threads
printf 'tolerance %s\n' 'R1..R11 60%' 'n1..n11 0.5' > wild.txt
for threads in 1 3 4; do
    try double-gauss --tolerances wild.txt --field 0,2,4,6,8,10,12,14 --rays 6 --trials 1000 \
        --threads $threads --part 1/1 -o wild.part --force --csv 2> said.$threads > rows
    sed -n '12p; / is lost /p' wild.part > reasons.$threads
    cut -d' ' -f 1-2,4- reasons.$threads | grep -c ' is lost '
    cmp reasons.1 reasons.$threads
    cmp said.1 said.$threads
done
cut -d: -f 3- said.1
# the gap to the image plane is not the refocus, which stays
try double-gauss --gap last --show sensitivity --digits 3 | sed -n '1,4p'
# best focus takes back what a focus is off by: nobody is to blame
echo 'tolerance focus 0.1mm' > focus.txt
try double-gauss --tolerances focus.txt --show offenders --columns share_first,share_total --csv
# in the unit that is printed
for asked in 'mtf@20/mm -N 8 --limit 40%' 'wavefront --limit 2waves' 'distortion --limit 2%'; do
    try double-gauss --criterion $asked --trials 5 --columns limit --csv
done
for limit in 120% 1 2waves; do
    try double-gauss --criterion mtf@20/mm -N 8 --limit $limit --trials 5
done
try double-gauss --limit 2% --trials 5
# one thing is adjusted once
try double-gauss --gap 5 --adjust t5 --trials 5
# what notes say of a figure that a lens has not
try double-gauss --trials 5 --save trial:2 -o made.lens --columns trials --csv
grep note made.lens
# without diameters a grade cannot be, but lines can
printf '%s\n' 'field angle 0 1' 'aperture f/8' 'surface 100 5 1.5 -' 'surface -100 95 air -' > bare.lens
try bare.lens --trials 5
echo 'tolerance R1..R2 0.1%' > radii.txt
try bare.lens --tolerances radii.txt --trials 5 --columns trials --csv
# a part is no lens
try double-gauss --part 1/2 --save worst:1 -o one.lens
# how far rays and methods are right is said of each row
lenscalc tolerance double-gauss -N 2,4 --trials 40 --digits 3 | sed 's/^.*  //' | head -3
lenscalc tolerance double-gauss --seed 0,1 --trials 40 --method differential --digits 2 |
    grep -c '(exact trials differ by .* rms, .* at most) *21 gauss'
# heights of the real image are not looked for in every lens, those of the paraxial image are
printf '%s\n' 'aperture f/8' 'surface 100 5 1.5 20' 'stop - 2 air 20' 'surface -100 95 air 20' > end.txt
for kind in real image; do
    { echo "field $kind 0 5"; cat end.txt; } > $kind.lens
    try $kind.lens --tolerances radii.txt --trials 5 --aim stop --columns trials --csv
done
try real.lens --tolerances radii.txt --trials 5 --columns trials --csv
try real.lens --tolerances radii.txt --trials 5 --aim stop --field 0,2 --columns trials --csv
