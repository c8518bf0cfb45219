# a column that is asked for and has no value: its name, a dash, and when it would have one
lenscalc focus -m 1:2 -f 50 --columns distance,working_distance
echo "status $?"
lenscalc exposure -N 8 --ev 12 --columns filter,time --format markdown
lenscalc focus -m 1:2,1:3 -f 50 --columns working_distance
lenscalc focus -m 1:2 -f 50 --columns working_distance --csv
lenscalc exposure -N 8 --ev 12 --columns filter --jsonl
lenscalc lens double-gauss --columns warning,position
# some rows have it, rows that fail have nothing, a later row has it
printf 'front_mm\n""\n5\n' | lenscalc focus -f 50 -m 0.5 --batch - --columns working_distance
printf 'f\n-5\nx\n' | lenscalc focus -m 0.5 --batch - --csv --columns working_distance
echo "status $?"
printf 'm,front_mm\n0.5,\n0.5,5\n' | lenscalc focus -f 50 --batch - --csv --columns working_distance
# with the option that brings it, and in a table of two options
lenscalc exposure -N 8 --ev 12 --filter ND8 --columns filter
lenscalc focus -f 50 -m 1:2,1:3 -P 1,2 --table m,P:working_distance
lenscalc focus -f 50 -m 1:2,1:3 -P 1,2 --table m,P:working_distance --csv
