# the same picture on other formats
lenscalc equivalent -f 50 -N 1.8 --sensor 4/3
lenscalc equivalent -f 80 -N 2.8 --sensor 6x6 --to 35mm,aps-c,4/3
lenscalc equivalent -f 23 -N 2 --sensor aps-c --keep exposure --json --digits 6
lenscalc equivalent -f 100 -N 8 -m 1:1 --to aps-c --explain
lenscalc equivalent -f 50 --sensor 4/3 --by diagonal,width,height,area
lenscalc equivalent -f 14,25,45 --to 35mm,6x6 --sensor 4/3 --table f,to
for words in '-N 2' '-f 50 -s 40mm' '-f 50 -s 2 -m 1' '-f 50 --to 36m'; do
    lenscalc equivalent $words
    echo "status $?"
done
