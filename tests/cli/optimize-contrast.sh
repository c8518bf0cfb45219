# goals of contrast: what mtf prints of the lens that was found; what is refused
lenscalc convert cooke-triplet-50 | sed 's/^focus.*/focus table/' > triplet.lens
goals='mtf@20/mm = 1, mtf@40/mm@20deg sagittal > 0.7:0.5'
lenscalc optimize triplet.lens --vary R6,t6 --goals "$goals" -o new.lens --rays 78 --show merit \
    --digits 3 --columns goal,value_after
for field in 0 14 20
do
    lenscalc mtf new.lens --no-clip --field $field --frequency 20 --columns tangential,sagittal \
        --csv --digits 3
done
lenscalc mtf new.lens --no-clip --field 20 --frequency 40 --columns sagittal --csv --digits 3
# by rays, exactly
lenscalc optimize triplet.lens --vary all-R --rays 78 -o new.lens --force --columns status \
    --goals 'gmtf@20/mm@14deg tangential == 0.6, spot, efl = 50'
lenscalc mtf new.lens --no-clip --field 14 --frequency 20 --method geometric --columns tangential \
    --csv --digits 9
# a field of no weight has no residual; one of four counts twice
for fields in 0,10 0:4,10:0
do
    lenscalc optimize triplet.lens --vary R1 --goals 'mtf@30/mm = 1' --field $fields --iterations 1 \
        --columns residuals,merit_before --digits 4 --csv
done
# a wave front that so few rays do not see
lenscalc optimize triplet.lens --vary t6 --goals 'mtf@40/mm@20deg = 1' -N 2.5 --rays 20 \
    --iterations 1 --columns warning --csv | sed 's/they see.*/they see .../'
# refused, with what there is
for goal in 'mtf@400/mm = 1' 'mtf@0/mm = 1' 'mtf@-5/mm = 1' 'mtf@nan/mm = 1' 'mtf@inf/mm = 1' \
    'mtf@1e-300/mm = 1' 'gmtf@1e300/mm = 1' \
    'mtf = 1' 'mtf@40/mm' 'mtf@40/mm = nan' 'mtf@40/mm@20/mm = 1' \
    'mtf@40/mm tangential sagittal = 1' 'spot@40/mm' 'mtf@40/mm@10deg@F tangential > 2:0' \
    'mtf@20/mm > 1.3' 'gmtf@20/mm = -0.1' 'gmtf@40/mm@10deg sagittal : 0.1' 'grazing : 2'
do
    lenscalc optimize triplet.lens --vary R1 --goals "$goal"
    echo "status $?"
done
for more in '--pattern hexapolar' --clip '--rays 2000' '--rays 1'
do
    lenscalc optimize triplet.lens --vary R1 --goals 'mtf@40/mm = 1' $more --iterations 1 \
        --columns residuals --csv
    echo "status $?"
done
# without an image, and with one that is looked for anew
sed 's/focus .*/focus best/' triplet.lens > best.lens
printf '%s\n' 'aperture epd 5' 'focus paraxial' 'surface - 2 1.5 20' 'surface - 9 air 20' > afocal.lens
for lens in best afocal
do
    lenscalc optimize $lens.lens --vary R1 --goals 'mtf@40/mm = 1'
    echo "status $?"
done
# beyond the cut-off of a start that is not yet seen whole: 1/(0.4861 um x 5) = 411/mm
printf '%s\n' 'wavelength d F C' 'field angle 0 14 20' 'aperture f/5' \
    'surface 33.9 3.2 1.6204/60.28 -' 'surface -33.9 4.5 air -' 'surface -18.2 1 1.62/36.37 -' \
    'surface 18.2 4.5 air - stop' 'surface 29.9 3 1.6204/60.28 -' 'surface -29.9 42 air -' > start.lens
lenscalc optimize start.lens --vary all-R --goals 'mtf@5000/mm > 0.5, efl == 50'
echo "status $?"
