# equivalent focal lengths in the rows of a batch: without a sensor, with one of the row, an option's
printf 'f,N,s\n26mm-eq,2,2\n50,2,2\n' | lenscalc dof --batch - --csv --columns focal
echo "status $?"
# a row with one behind rows that wait
printf 'f,N,s\n50,2,2\n50,2,\n26mm-eq,2,2\n' | lenscalc dof --batch - --csv --columns focal
echo "status $?"
printf 'f,sensor,N,s\n26mm-eq,,2,2\n26mm-eq,18x13.5mm,2,2\n' | lenscalc dof --batch - --csv --columns focal --digits 6
echo "status $?"
printf '{"f":"26mm-eq","N":2}\n{"f":"26mm-eq","N":2,"s":3}\n' | lenscalc dof --batch - --jsonl --columns focal
echo "status $?"
printf 'sensor,N,s\n18x13.5mm,2,2\n,2,2\n' | lenscalc dof -f 26mm-eq --batch - --csv --columns focal --digits 6
echo "status $?"
