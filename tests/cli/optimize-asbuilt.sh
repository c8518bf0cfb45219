# lenses that are easier to build: the nominal spots and what errors add to them
cat > errors.tol <<'END'
tolerance element 1..2 decenter 0.1mm
tolerance element 3..4 decenter 0.1mm
tolerance element 5..6 decenter 0.1mm
tolerance element 1..2 tilt 10arcmin
tolerance element 3..4 tilt 10arcmin
tolerance element 5..6 tilt 10arcmin
END
vary='all-R,t1[1,6],t2[2,12],t3[0.9,4],t4[2,12],t5[1,6]'
for goal in asbuilt poly; do
    told=
    test $goal = asbuilt && told='--tolerances errors.tol'
    lenscalc optimize cooke-triplet-50 --vary "$vary" --goals $goal,efl=50:0.01 $told \
        -o $goal.lens --columns status --csv | sed 1d
    # as designed, and as made
    lenscalc tolerance $goal.lens --tolerances errors.tol --of mean --no-clip --trials 2000 \
        --columns nominal,mean --csv | sed 1d > $goal.csv
done
# better as designed, worse as made: by 5 %
cat asbuilt.csv poly.csv |
    awk -F, '{ design[NR] = $1; made[NR] = $2 }
             END { print (design[1] > design[2] ? "designed larger" : "designed smaller"),
                         (made[1] < 0.96*made[2] ? "made smaller" : "made larger") }'
# without errors of its own a lens is made with the grade precision; a row of its own
lenscalc optimize double-gauss --vary R1 --goals asbuilt,efl=100 --columns status
lenscalc optimize double-gauss --vary R1 --goals asbuilt,efl=100 --show merit --digits 3
# what makes nothing worse adds nothing: an image plane is focused anew
echo 'tolerance focus 0.1mm' > focus.tol
for goal in 'asbuilt --tolerances focus.tol' poly; do
    lenscalc optimize double-gauss --vary R1 --goals $goal --show merit --columns value_before \
        --csv --digits 9
done
# refused
lenscalc optimize cooke-triplet-50 --vary R1 --goals asbuilt
lenscalc optimize double-gauss --vary R1 --goals poly --grade high
lenscalc optimize double-gauss --vary R1 --goals asbuilt=1
lenscalc optimize double-gauss --vary R1 --goals asbuilt --grade medium
