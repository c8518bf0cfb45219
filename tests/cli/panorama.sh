# frames, steps, size and parallax
lenscalc panorama -f 24 --portrait
lenscalc panorama -f 50 --portrait --arc 120deg --sensor "Nikon D1"
lenscalc panorama -f 20 --portrait --span 180deg --each-row
lenscalc panorama -f 35 --offset 10mm --near 1m --pixels 6000 --explain
lenscalc panorama --horizontal 100deg --vertical 140deg --json --digits 6
lenscalc panorama -f 14,20,24,35,50 --portrait --overlap 20%,30%,50% --table f,overlap:columns
lenscalc panorama -f 24 --per-row 8,10,12
lenscalc panorama -f 24 --per-row 1 --arc 60
lenscalc panorama --horizontal 60 --vertical 40 --rows 2,3,4 --span 75
lenscalc panorama --horizontal 60 --vertical 40 --rows 3
lenscalc panorama --horizontal 60 --vertical 40 --rows 3 --each-row --columns row,elevation
for words in '' '-f 24 --per-row 4' '-f 24 --arc 400' '-f 24 --overlap 1' '-f 24 --horizontal 50' \
    '-f 24 --near 5mm --offset 10mm' '-f 24 --each-row --per-row 9' '-f 24 -s 20mm' \
    '-f 24 --span 180 --elevation 60 --each-row' '-f 24 --span 120 --rows 2' '-f 24 --rows 0'; do
    lenscalc panorama $words
    echo "status $?"
done
