# equal exposures of a series: exact steps, labels, and what lies between them
lenscalc exposure -N 16 -t 1/8 --equivalent --series full
lenscalc exposure --ev 14.64 --equivalent --series third --csv --digits 4 |
    cut -d, -f1-6 | sed -n 1,6p
lenscalc exposure --ev 2 --equivalent --series full --film "HP5 Plus" --csv --digits 4 \
    --columns nominal_fnumber,nominal_time,corrected_time | tail -n 3
lenscalc exposure --ev 40 --equivalent
echo "status $?"
