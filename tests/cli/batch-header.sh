# headers that cannot be read
printf 'f,N,s\n' > none.csv
printf 'f,f\n1,2\n' > twice.csv
printf 'f,N,s,focal_mm\n1,2,3,4\n' > same.csv
printf 'f_kg,N,s\n1,2,3\n' > unit.csv
: > empty.csv
for file in none twice same unit empty missing; do
    lenscalc dof --batch $file.csv --csv --columns near_m
    echo "$file status $?"
done
lenscalc dof --batch none.csv -f 50 --csv
echo "status $?"
lenscalc dof --batch none.csv --batch-format xml
echo "status $?"
printf 'f,N,s\n50,2.8,3\n' | lenscalc dof --batch - -P 1,2
echo "status $?"
