# what is no value: the position, the reason, the legal range, and the exit status
for f in 50nn 50s nan 1e999 1e-999 -0 0 -5 '' 50mm5 mm 0x32 1_000 1e; do
    lenscalc dof -f "$f" -N 2.8 -s 3m
    echo "[$f] status $?"
done
for n in f/ T 1/2.8 f/0 2.8mm; do
    lenscalc dof -f 50 -N "$n" -s 3m
    echo "[$n] status $?"
done
lenscalc dof -f 50 -N 2.8 -s 40mm
echo "status $?"
