# the colour of lamps and the filters that convert it; lamps that flicker with the mains
lenscalc exposure --kelvin 3200 --balance 5500 --explain
lenscalc exposure --kelvin 5500K --filter 81A+ND8 --balance 3200
lenscalc exposure --kelvin 3200,5500 --filter 80A,85B
lenscalc exposure -N 8 --ev 12 --filter 85B --csv --columns time_s,mired_shift,filtered_K
lenscalc exposure --filter yellow --kelvin 5500 -N 8 --ev 12 --csv --columns mired_shift,filtered_K
lenscalc exposure --mains 50,60 --frame-rate 24,25
lenscalc exposure --mains 50Hz --frame-rate 24 --shutter-angle 180,172.8 --ev 10 --iso 800 --csv \
    --columns time_s,flicker,flicker_free_time_s
lenscalc exposure --mains 60 -N 2.8 -t 1/125,1/60,1/500 --csv --columns flicker,flicker_free_time_s
lenscalc exposure --mains 60 --frame-rate 24 -N 2.8 -t 1/500 --csv --columns flicker
lenscalc exposure --mains 50 --frame-rate 240
lenscalc exposure --mains 16.7 --json --columns flicker_free_times,mains
lenscalc list filters 80 --csv --columns filter,mired
for wrong in "--balance 3200" "--kelvin 100" "--filter yellow --kelvin 5500 --balance 3200" \
    "--mains 0" "--kelvin 5500 --balance 3200m" "--kelvin 10000 --filter 80A"; do
    lenscalc exposure $wrong
    echo "status $?"
done
