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
# the work of each question counts: rays, rows, trials
over() {
    echo "[$*]"
    lenscalc "$@" | wc -l
}
over dof --lens double-gauss --exact -N 1.5..22:0.1 -s 1..100:0.1
over hyperfocal --lens double-gauss --exact -N 1.5..22:0.0001
over fov --lens double-gauss --exact -s 1..20000:0.1
over focus --lens double-gauss --exact -s 1..20000:0.1
over exposure --lens double-gauss --exact -N 2..22:0.0001 -t 1/60
over tolerance double-gauss --grade precision -N 2..22:0.0001
over tolerance double-gauss --grade precision -N 2,4 --trials 500001
over trace double-gauss --rays 10000000 --pattern sobol -N 2..22:0.001
over trace double-gauss --rays 1,1000000 --pattern sobol -N 2,4
over trace double-gauss --all -N 2..22:0.0001
over spot double-gauss --rays 100000 -N 2..22:0.001
over surfaces double-gauss -N 2..22:0.0001
over seidel double-gauss -N 2..22:0.0001
# all values count, wherever they stand: 201 of (10 + 100000 + 10) rows
over spot double-gauss --rays 10,10000000,10 -N 2..4:0.01
# and each as itself: three fields of 1 + 2 + 3 + 100000 rays, and the head
over trace double-gauss --rays 1,2,3,100000 --pattern sobol --csv
lenscalc dof -f 50 -N 8 -s 1..1.5
lenscalc dof -f 50 -N 8 -s 1..2:5 --csv --columns distance
