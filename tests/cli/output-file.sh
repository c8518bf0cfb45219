# -o: the file holds what standard output would, and only appears whole
lenscalc dof -f 50 -N 4 -s 3 --csv --columns near_m -o answer.csv
cat answer.csv
lenscalc dof -f 50 -N 4 -s 3 --csv --columns near_m > direct.csv
cmp answer.csv direct.csv && echo same
lenscalc dof -f 50 -N 4 -s 0.01 --csv -o bad.csv
echo "status $?"
lenscalc dof -f 50 -N 4 -s 3 --csv -o nowhere/bad.csv
echo "status $?"
ls
