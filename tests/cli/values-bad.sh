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
# parts of a value: the whole is shown
for number in 2.. ..2 1..2: '1..2*' 24-70; do lenscalc dof -f 50 -s 2 -N "$number"; done
lenscalc motion -f 50 -s 2 -t 180deg@
lenscalc trace double-gauss --point 1:2:
lenscalc exposure -N 8 --filter '3-stop red'
# crop factors are no sizes; fractions of an inch are
for sensor in 1.5x x1.6 '1.6x crop' 36x x24 24x1.x 1/125 16/9; do lenscalc fov -f 8 --sensor "$sensor"; done
for sensor in 1/1.8 2/3 1/2.3; do lenscalc fov -f 8 --sensor "$sensor" --csv --columns sensor | tail -n 1; done
for filter in '6-stop ND' 'ND 6 stops' '10 stop nd filter' 'ND8 filter' ND64; do
    lenscalc exposure -N 8 -t 1/60 --filter "$filter" --csv --columns loss_stops | tail -n 1
done
