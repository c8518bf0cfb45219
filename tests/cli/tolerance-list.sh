# grades of tolerances, the user's own first
lenscalc list tolerances --kind precision
lenscalc list tolerances tilt --csv --columns grade,quantity,value,unit,distribution
mkdir own
printf 'grade\tquantity\tvalue\tunit\nours\tradius\t0.3\t%%\n' > own/tolerances.tsv
lenscalc list tolerances radius --lensdb own --csv --columns grade,value,unit,database
printf 'grade\tquantity\tvalue\tunit\nours\tradius\t-1\t%%\n' > own/tolerances.tsv
lenscalc list tolerances --lensdb own
echo "status $?"
printf 'grade\tquantity\tvalue\nours\tradius\t1\n' > own/tolerances.tsv
lenscalc list tolerances --lensdb own
echo "status $?"
lenscalc list tolerances --kind gold
