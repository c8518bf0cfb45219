# ranges that never end, that reach too far, and lists with holes
for f in 1..10:-1 1..10:0 1..2*1 1..2*0.5 0..2*2 1..2#1 1..2#2.5 1..inf 2..1:1 1..1e9 1..2:1e-9 \
    1..2#1e9 1..2,,3 , 1,; do
    lenscalc dof -f "$f" -N 2.8 -s 3m
    echo "[$f] status $?"
done
