# focus stack, equal picture on another format, distances from the sensor, pupil magnification
lenscalc dof -f 100mm -N 8 --near 30cm --far 31cm --stack --csv --digits 8 \
    --columns shot,shots,distance_m,near_m,far_m
lenscalc dof -f 50 -N 2.8 -s 3 --equal-on micro-four-thirds --csv --digits 8 \
    --columns equal_sensor,equal_focal_mm,equal_fnumber,equal_coc_mm
lenscalc dof -f 50 -N 2.8 -s 3 --from principal,sensor,entrance -P 0.8 --csv --digits 8 \
    --columns distance_from,distance_m,near_m,far_m
lenscalc dof -f 50 -N 2.8 -s 3 --stack
echo "status $?"
lenscalc dof -f 50 -N 2.8 --near 2 --far 3 --stack -s 2
echo "status $?"
