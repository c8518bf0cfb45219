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
# an equivalent focal length whose unit is not whole
for focal in 26-eq 26eq "24 mm eq"; do lenscalc dof -f "$focal" -N 2 -s 2m; done
