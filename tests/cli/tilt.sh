# hinge rule, wedge of sharpness, image circle; a drawing
lenscalc tilt -f 150 -N 22 --hinge 1.6m --angle 90deg --sensor 4x5 --explain
lenscalc tilt -f 24 -N 8 --tilt 1..8 --angle 90deg
lenscalc tilt -f 90 -N 11 --tilt 8 -s 1.2m --sight -20..20:5
lenscalc tilt -f 90 -N 16 --through 2m:-1.5m,30m:0m --csv --digits 8
lenscalc tilt -f 90 -N 16 --through inf:0,2m:-30deg --json --digits 6
lenscalc tilt -f 90 -N 16 --tilt 0 -s 3 --circle 67
lenscalc tilt -f 90 -N 16 --tilt 8 -s inf --circle 67 --rise 11 --columns needed_circle,covers
lenscalc tilt -f 150 -N 22 --tilt 5 --angle 90 --sensor 4x5 --wedge wedge.svg --columns hinge
grep -c 'hinge line' wedge.svg
for words in '--tilt 95 -s 2' '--tilt 5' '--tilt 5 --hinge 2 -s 3' '--hinge 0.05 -s 3' \
    '--tilt 0 --angle 90' '--tilt 5 --angle 3' '--tilt 5 -s 8cm' '--tilt 5 -s 2 --sight 100' \
    '--through 2m,30m:0m' '--through 2m:-1.5m' '--through 2m:-1.5x,30m:0m' \
    '--through 2m:0m,30m:0m' '--through inf:3m,2m:1m' '--through 2m:0,3m:1m --tilt 5' \
    '--tilt 1..3 -s 2 --wedge w.svg'; do
    lenscalc tilt -f 90 -N 16 $words > output
    echo "status $?"
done
lenscalc tilt -f 90 --tilt 5 --angle 90
