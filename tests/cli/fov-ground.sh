# what a drone sees of the ground: by altitude, or the altitude for a wanted ground sample
lenscalc fov -f 8.8mm --sensor 13.2x8.8mm --pitch 2.41um --altitude 100m --explain
lenscalc fov -f 8.8mm --sensor 13.2x8.8mm --pitch 2.2um --gsd 1cm,2cm --csv \
    --columns gsd_cm,altitude_m,ground_width_m,ground_height_m
lenscalc fov -f 50mm --sensor "Nikon D850" --altitude 120 --columns gsd,ground_width
lenscalc fov -f 8.8mm --sensor 13.2x8.8mm --altitude 60,120
lenscalc fov --lens fisheye-16 --altitude 100 --pitch 4um --json --columns gsd_cm
lenscalc fov -f 8.8mm --csv --columns altitude_m,gsd_cm,ground_width_m,pitch_um
for wrong in "--gsd 2" "--pitch 3um --gsd 2cm --altitude 3m" "--altitude 0" \
    "--altitude 50 --pitch 3mm"; do
    lenscalc fov -f 8.8mm --columns gsd $wrong
    echo "status $?"
done
