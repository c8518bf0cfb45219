# a wanted field: focal length, distance or sensor, pixels on the subject, line-scan cameras
lenscalc fov -f 85 --field-height 1.8m
lenscalc fov --field-width 400mm -s 600mm --sensor imx264 --explain
lenscalc fov 16mm --field-width 100mm --field-height 75mm --sensor 2/3in --json
lenscalc fov 16mm 1m --field-width 400mm --pixels 2448x2048
lenscalc fov 16mm 1m --field-width 400mm --columns sensor_width,sensor_height,solved_for --csv
lenscalc fov --field-width 50mm -s 605mm --from sensor --sensor 1in --columns focal,distance
lenscalc fov 2.8mm 20m --sensor 1/2.8in --pixels 2688x1520 --columns density,object_pixel
lenscalc fov 2.8mm --sensor 1/3in --pixels 4Mpx --dori --csv --digits 6 --columns task,distance_m,density_px_ft
lenscalc fov --sensor 1/2.8in --pixels 1080p --task identify,validate -s 20m
lenscalc fov --pixels 2448x2048,4096x3000 --pitch 3.45um -f 25 --density 10px/mm --csv --digits 6
lenscalc fov --line-scan --pixels 4096 --pitch 7um --field-width 0.5m -s 1m -v 2m/s --explain
lenscalc fov --line-scan --pixels 1024 --pitch 10um -f 50 --field-width 20mm --line-rate 45kHz --csv --digits 6
lenscalc fov --line-scan --pixels 2048 --field-width 550mm -v 4m/s
lenscalc fov --line-scan --pixels 2048,4096 --pitch 10um --field-width 550mm --line-rate 20kHz --csv --digits 6
lenscalc fov --telecentric -m 0.5 --sensor imx264 --na 0.05 --explain
lenscalc fov --telecentric -m 0.5x,1 --working-fnumber 8 --blur 2px --sensor imx250 --csv --digits 6
lenscalc fov --telecentric --field 50x40mm,20x20mm --sensor 2/3in --columns magnification,field_width,solved_for
printf 'field,f_mm\n100x75mm,16\n1x1m,16\n100,16\n' | lenscalc fov --sensor 2/3in --batch - --csv --digits 6 --columns distance,solved_by
printf 'f_mm,field_width_m\n16,0.4\n25,wide\n' | lenscalc fov --sensor imx264 --batch - --csv --digits 6 --columns distance_m
lenscalc fov -f 50 --field-width 2 --sensor imx264 --csv | lenscalc fov --batch - --sensor imx264 --csv --digits 6
# rows of other commands, whose fields, speeds and angles are not asked for here
for words in 'fov -f 50 -s 2 --sensor imx264' 'panorama -f 24' 'motion -f 50 -s 10 --speed 5km/h' 'dof -f 50 -N 8 -s 3'; do
    lenscalc $words --csv | lenscalc fov --batch - --csv --digits 5 --columns focal,distance,horizontal | tail -1
done
for words in '16mm --field-width 400mm -s 1m --sensor imx264' '--field-width 400mm' \
    '-f 50 -s 3 --pixels 6000x4000' '-f 35 -s 1m --pixels 4096 --pitch 7um' '-f 35 --density 100' \
    '-f 35 --pixels 4k --pitch 2um --sensor 1in' '-f 35 -s 1 --line-scan' '-f 35 -s 1 --line-scan --pixels 2048x4 --pitch 5um' '-f 35 -s 1 --pixels 4x' \
    '-f 8 -s 1 --sensor imx264 --pixels 100x100' '--line-scan --pixels 9 --pitch 5um -f 9 -v 1' \
    '-f 9 --field-width 1m --horizontal 40deg' '-f 9 --field-width 1m --projection equisolid' \
    '--telecentric -m 1 -f 50' '--telecentric' '--telecentric -m 1 --working-fnumber 8' '--telecentric -m 1 -N 8' '-f 50 --na 0.1' \
    '-f 16 --field 100x75' '-f 16 --field 9x9mm --field-width 1m' '-f 9 --task identfy --sensor imx264' '-f 9 --density 250px --sensor imx264'; do
    lenscalc fov $words
    echo "status $?"
done
