# long: --exact: limits, focus and light by the rays of a lens
lens=double-gauss
lenscalc dof --lens $lens -N 8 -s 2m --exact --columns near_m,far_m,depth_of_focus_mm,least_blur_um
lenscalc dof --lens $lens -N 8 -s 2m --exact --criterion energy80 --columns near_m,far_m
lenscalc dof --lens $lens -N 8 -s 2m --exact --criterion mtf@20/mm --columns near_m,far_m
lenscalc dof --lens $lens -N 2.8..8 -s 2m -w d --exact --digits 6 --csv --columns fnumber,near_m,far_m,least_blur_um
lenscalc dof --lens $lens -N 8 -s 2m --from sensor --exact --columns distance_sensor_m,near_m
lenscalc hyperfocal --lens $lens -N 8 --exact --explain
lenscalc focus --lens $lens -s 2m -N 2,4,8 --exact --digits 6 --csv --columns fnumber,image_mm,focus_shift_mm,least_blur_um
lenscalc exposure --lens $lens -N 4 -t 1/60 --exact --digits 6 --csv --columns transmittance,t_stop,loss_stops
lenscalc exposure --lens $lens -N 4 -t 1/60 --exact --fresnel -m 1:4 --digits 6 --csv --columns transmittance,t_stop
lenscalc fov --lens $lens -s 1m,inf --exact --digits 6 --csv --columns diagonal_deg,breathing_percent
lenscalc fov --lens $lens -s 1m,inf --gap last --digits 6 --csv --columns diagonal_deg,breathing_percent
lenscalc fov --lens $lens -s 1m --focus-by lens --digits 6 --csv --columns breathing_percent
# refused
lenscalc dof --lens $lens -N 2 -s 2m --exact
lenscalc dof --lens $lens -N 2,8 -s 2m --exact --digits 6 --csv --columns fnumber,near_m
lenscalc dof --lens $lens -N 8 -s 2m --exact --criterion energy
lenscalc dof --lens $lens -N 8 -s 2m --exact --criterion energy100
lenscalc dof --lens $lens -N 8 -s 2m --exact --criterion mtf@0
lenscalc dof --lens $lens -N 8 -s 2m --exact --criterion mtf@100/mm
lenscalc dof --lens $lens -N 8 -s 2m --criterion rms
lenscalc dof -f 50 -N 8 -s 2m --exact
lenscalc dof --lens $lens -N 8 -s 2m --exact -P 1
lenscalc dof --lens $lens -N 8 -s 2m --exact --tube 20
lenscalc dof --lens $lens --near 1m --far 2m --exact
lenscalc dof --lens $lens --near 1m --far 2m -N 8 --stack --exact
lenscalc dof --lens $lens -N 8 -s 2m --exact --model no-f
lenscalc dof --lens $lens -N 8 -s 2m --exact --scale out.svg
lenscalc hyperfocal --lens $lens --near 10m --exact
lenscalc hyperfocal --lens $lens -N 2 --exact
lenscalc focus --lens $lens --image 110mm --exact
lenscalc focus --lens $lens -s 2m --tube 20 --exact
lenscalc exposure --lens $lens -t 1/60 --t-stop 2.2 --exact
lenscalc exposure --lens $lens -t 1/60 --fresnel
lenscalc fov --lens $lens -s 1m --exact --gap last
lenscalc fov --lens $lens -m 1:2 --gap last
lenscalc fov --lens $lens -s 1m --gap d99
# a lens that states no aperture has no focus shift; one without a stop no pupils of its own
printf 'object inf\nsurface 50 3 1.5168/64.2 -\nstop - 5 air -\nsurface -50 0 air -\n' > open.lens
printf 'object inf\nsurface 50 3 1.5168/64.2 -\nsurface -50 0 air -\n' > bare.lens
lenscalc focus --lens open.lens -s 2m -N 8 --exact --digits 6 --csv --columns image_mm,focus_shift_mm
lenscalc fov --lens open.lens -s 2m --exact
lenscalc exposure --lens open.lens --ev 12 --exact
lenscalc dof --lens bare.lens -N 16 -s 2m --exact
lenscalc dof --lens bare.lens -N 16 -s 2m --exact -P 1 --digits 6 --csv --columns near_m,far_m,least_blur_um
# the distance from the sensor is that of the subject, not of infinity
lenscalc fov --lens $lens -s 2m --from sensor --exact --digits 6 --csv --columns distance_sensor_m,breathing_percent
# wider than the lens is
lenscalc dof --lens $lens -N 1 -s 2m -c 0.2 --exact --columns near_m,far_m
# a T-stop is that of one f-number
lenscalc exposure --lens $lens -t 1/60 --ev 12 --iso 100 --exact
lenscalc exposure --lens $lens -t 1/60 -N 8 --equivalent --exact
lenscalc exposure --lens $lens -t 1/60 -N 8 --exact --fresnel --columns t_stop
# of a batch a word that is none is refused before its rows, in a column in its row
printf 's,criterion\n3,rsm\n4,rms\n' > rules.csv
lenscalc dof --lens double-gauss-50 -c 0.1 --batch rules.csv --exact --csv --columns near
cut -d , -f 1 rules.csv | lenscalc dof --lens double-gauss-50 -c 0.1 --batch - --exact --criterion rsm --csv --columns near
