# f-numbers, ratios, angles, circles of confusion, sensors
for n in 2.8 f/2.8 f2.8 F/2.8 T2.2 t2.2 2.80; do
    echo "[$n] $(lenscalc dof -f 50 -s 3 -N "$n" --csv --columns fnumber | tail -n 1)"
done
for m in 0.5 1:2 0.5x 2:1 1:1 10:1; do
    echo "[$m] $(lenscalc dof -f 50 -N 8 -m "$m" --csv --columns magnification,distance_m | tail -n 1)"
done
for a in 90 90deg 1.5707963267948966rad 5400arcmin 324000arcsec; do
    echo "[$a] $(lenscalc fov --horizontal "$a" --csv --columns focal_mm --digits 12 | tail -n 1)"
done
for c in 0.03 0.03mm 30um d/1500 d/1730 2px airy print; do
    echo "[$c] $(lenscalc dof -f 50 -N 8 -s 3 --sensor 'Nikon D1' -c "$c" --csv --digits 12 \
        --columns coc_mm,coc_criterion | tail -n 1)"
done
for d in 35mm full-frame 'Nikon D1' nikon-d1 NIKON_D1 36x24mm '36 x 24 mm' 23.7x15.6mm 1.5x1in; do
    echo "[$d] $(lenscalc dof -f 50 -N 8 -s 3 --sensor "$d" --csv --digits 12 \
        --columns coc_mm,sensor | tail -n 1)"
done
for w in 550 550nm 0.55um; do
    echo "[$w] $(lenscalc dof -f 50 -N 8 -s 3 -c airy -w "$w" --csv --digits 12 \
        --columns coc_mm | tail -n 1)"
done
