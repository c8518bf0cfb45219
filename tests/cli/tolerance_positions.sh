# what the positions set is perturbed in each of them, and lenses are written as they were looked at
cat > zoom.lens << 'END'
wavelength d F
position a b c
field angle 0 5
aperture epd 8
focus table
let gap 2 3 4
surface 50 4 1.5168/64.17 12
surface -50 gap air 12
surface -60 2 1.62/36.4 12 decenter=0,0
surface -200 60 air 12
set dy3 0 1 0.5
set R1 50 51 52
set glass1 1.5168/64.17 1.52/60 1.51/64
END
shown() { sed -n '/^let/p; /^set/p' made.lens | sed 's/\(\.[0-9]\{6\}\)[0-9]*/\1/g'; }
for mark in 'element 3..4 tilt 10arcmin' 'element 1..2 tilt 10arcmin' 'surface 3 decenter 0.1' \
    'R1 0.01' 'n1 0.001' 'V1 0.4' 't2 0.1'; do
    echo "tolerance $mark" > marks.txt
    lenscalc tolerance zoom.lens --tolerances marks.txt --aim stop --no-clip --trials 1 --of each \
        --show trials --columns figure --csv --digits 9 --save trial:1 -o made.lens --force > trial.csv
    lenscalc spot made.lens --position all --no-clip --rays 21 --columns rms --csv --digits 9 > spot.csv
    sed 1d trial.csv | cut -d, -f 1 > of-trial
    sed 1d spot.csv | cmp - of-trial && echo "$mark: the same"
done
# a displacement of its own in every position
shown
echo 'tolerance element 3..4 tilt 10arcmin' > marks.txt
lenscalc tolerance zoom.lens --tolerances marks.txt --trials 1 --save trial:1 -o made.lens --force \
    --columns trials --csv
shown
