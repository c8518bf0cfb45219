# long sweeps need --force, the sooner the longer an answer takes
exec 2>&1
lenscalc dof -f 10..20#1001 -s 1..2#1001 -N 4 --csv --columns near_m | wc -l
lenscalc dof -f 10..20#1000 -s 1..2#1000 -N 4 --csv --columns near_m | wc -l
lenscalc dof -f 10..20#1001 -s 1..2#1001 -N 4 --csv --columns near_m --force | wc -l
lenscalc spot double-gauss -N 4..8#100001
echo "status $?"
lenscalc mtf double-gauss -N 4..8#10001
echo "status $?"
lenscalc dof -f 1..2#10001 -s 1..2#10001 -N 4 --force
echo "status $?"
