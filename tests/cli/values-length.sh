# lengths in every unit and notation that the trade writes
for f in 50 +50 5e1 .5e2 50. 0050 50mm ' 50 mm ' 5cm 0.05m 50000um 50e6nm 2in '2"' 0.05e-3km; do
    echo "[$f]"
    lenscalc dof -f "$f" -N 2.8 -s 3m --csv --columns focal_mm | tail -n 1
done
for s in 3 3m 300cm 3000mm 10ft 10feet 5ft6in "5'6\"" '5′6″' '5ft 6in' 5ft6 3yd 1mi inf; do
    echo "[$s]"
    lenscalc dof -f 50mm -N 2.8 -s "$s" --csv --columns distance_m | tail -n 1
done
