# focus stacks of a camera on a rail
lenscalc dof -m 2:1 -N 5.6 --dof 8mm --stack --rail
lenscalc dof -m 2:1 -N 5.6 --dof 8mm --stack --rail --overlap 20%,40% -f 100 --csv \
    --columns shots,step,travel,dof,working_fnumber
lenscalc dof -m 1:1,2:1,5:1 -N 5.6 -c 0.02 --dof 8mm --stack --rail
for wrong in "-m 2:1 -N 5.6 --stack" "-N 5.6 --dof 8mm --stack" "-m 2:1 -N 5.6 --dof 8mm" \
    "-m 2:1 -N 5.6 --dof 8mm --stack --near 10cm" "-m 0 -N 8 --dof 8mm --stack" \
    "-m 2:1 -N 5.6 --dof 8mm --stack -s 3"; do
    lenscalc dof --rail $wrong
    echo "status $?"
done
