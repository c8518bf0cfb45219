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
