# which neutral-density filters make a time longer
lenscalc exposure --metered 1/125 -t 30s --propose
lenscalc exposure --metered 1/125 -t 30s --propose --own ND8,ND64,ND1000 --csv \
    --columns filters,longer,time_to_set,timer
lenscalc exposure --scene sunny-16 -N 11 --iso 100 -t 1min --propose
lenscalc exposure --metered 1/4 -t 2min --propose --film "HP5 Plus"
lenscalc exposure --metered 1/125,1/60 -t 4min --filter polarizer --propose --json \
    --columns filters,time_to_set
lenscalc exposure --metered 1/125 --filter ND64k
# ND64000 alone would make more of it than the film is known for
lenscalc exposure -N 8 --ev 12 -t 30s --film Provia --propose --csv --columns filters,corrected_time
for wrong in "-t 1/1000 --propose" "--propose" "-t 30" "-t 30 --own ND8" "-t 30 --propose --own ND8,,ND4" \
    "-t 30 --propose --own ND1" "-t 30 --propose --own big" "-t 30 --propose --equivalent" \
    "--filter NDk"; do
    lenscalc exposure --metered 1/125 $wrong
    echo "status $?"
done
for wrong in "--ev -2 --film FP4" "--ev 12 --shutter-angle 180deg --frame-rate 24" \
    "--ev 12 --corrected-time 60s --film FP4"; do
    lenscalc exposure -N 8 $wrong -t 30s --propose
    echo "status $?"
done
