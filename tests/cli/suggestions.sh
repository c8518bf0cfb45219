# a misspelt word gets a suggestion and status 2
lenscalc dog
echo "status $?"
lenscalc zzzzzz
echo "status $?"
lenscalc dof --focal-lenght 50
echo "status $?"
lenscalc dof -f 50 -N 4 -s 3 --sensor 'half-frane'
echo "status $?"
lenscalc list cmaeras
echo "status $?"
lenscalc dof -f 50 -N 4 -s 3 --model exct
echo "status $?"
lenscalc help dfo
echo "status $?"
lenscalc dof -Q 3
echo "status $?"
