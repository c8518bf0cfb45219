# tables that cannot be
lenscalc dof -f 50 -N 4 -s 3 --table s,N
echo "status $?"
lenscalc dof -f 50 -N 4,5 -s 3,4 --table s
echo "status $?"
lenscalc dof -f 50 -N 4,5 -s 3,4 --table s,Q
echo "status $?"
lenscalc dof -f 50 -N 4,5 -s 3,4 --table s,N --json
echo "status $?"
lenscalc dof -f 50 -N 4,5 -s 3,4 -c 0.02,0.03 --table s,N
echo "status $?"
# one name for two columns
lenscalc dof -f 50 -N 2.8,2.8 -s 1,30 --table s,N:near --csv
echo "status $?"
lenscalc dof -f 50 -N 4 -s 2,3 --sensor 35mm,aps-c,35mm --table s,sensor:near --tsv
echo "status $?"
lenscalc dof -f 50 -N 4,5 -s 3,4 --table s,N:near+near --csv
echo "status $?"
# an option that would do nothing
lenscalc dof -f 50 -N 2.8,4 -s 1,30 --table s,N --columns far
echo "status $?"
# words of a cell are those of the rows
lenscalc exposure -N 4,5.6 --iso 100,200 --ev 12 --table N,iso:nominal_time --csv
lenscalc exposure -N 4,5.6 --iso 100,200 --ev 12 --columns nominal_time --csv
