# a row that fails keeps its place, the others are answered
cat > rows.csv <<'END'
id,f,N,s
good,50,2.8,3
near,50,2.8,40mm
last,50,2.8,5
END
lenscalc dof --batch rows.csv --csv --digits 6
echo "status $?"
lenscalc dof --batch rows.csv --csv --columns near_m,error --digits 6
lenscalc dof --batch rows.csv --jsonl --columns near_m --digits 6
echo "status $?"
printf 'f,N,s\n50,2.8,0.01\n50,2.8,0.02\n' > bad.csv
lenscalc dof --batch bad.csv --jsonl --columns near_m
echo "status $?"
lenscalc dof --batch rows.csv --csv --digits 6 --fail-fast -o whole.csv
ls
# every row names its options, though what is alike is said once
lenscalc dof -f 50mm -N 2,3,4 -s 10mm --csv --columns near_m,error
lenscalc dof -f 50mm -N 2 -s 1m,10mm,20mm --csv --columns near_m,error --fail-fast
