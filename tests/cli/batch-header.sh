# headers that cannot be read
printf 'f,N,s\n' > none.csv
printf 'f,f\n1,2\n' > twice.csv
printf 'f,N,s,focal_mm\n1,2,3,4\n' > same.csv
printf 'f_kg,N,s\n1,2,3\n' > unit.csv
: > empty.csv
printf 'note,f_mm,N,s_m\ra,50,4,3\rb,50,4,4\r' > returns.csv
for file in none twice same unit empty missing returns; do
    lenscalc dof --batch $file.csv --csv --columns near_m
    echo "$file status $?"
done
lenscalc dof --batch none.csv -f 50 --csv --columns near_m
echo "status $?"
lenscalc dof --batch none.csv --batch-format xml
echo "status $?"
printf 'f,N,s\n50,2.8,3\n' | lenscalc dof --batch - -P 1,2
echo "status $?"
# line breaks of either kind within a quoted name are the name's
printf '"a\r\nb",f,N,s\r\n1,50,2.8,3\r\n' | lenscalc dof --batch - --csv --columns near_m
echo "status $?"
# nor are carriage returns within one, or before a line break, the ends of lines
printf '"a""\rb",f,N,s\r\r\n1,50,2.8,3\r\r\n' | lenscalc dof --batch - --csv --columns near_m
echo "status $?"
# lines of values where names are expected, also where options say all
printf '3,50,2.8\n4,50,4\n' | lenscalc dof --batch - --csv
echo "status $?"
printf 'Lens A;f/2.8;1/125 s;\n' | lenscalc exposure --batch - -N 2 --time 1 --csv
echo "status $?"
# empty columns behind a table
printf 'f,N,s,,\n50,2.8,3,,\n50,4,3,,x\n50,4,3,kept,\n' |
    lenscalc dof --batch - --csv --columns near_m --digits 4
echo "status $?"
printf '"a","f","N","s"\r1,50,2.8,3\r' | lenscalc dof --batch - --csv
echo "status $?"
