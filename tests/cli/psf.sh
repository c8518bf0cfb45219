# images of points: methods, sizes, pixels, spectra, focus, obstruction, maps, refusals
lenscalc psf double-gauss -N 5.6 --columns field,peak,width_x,width_y,radius80,inside,pitch
lenscalc psf double-gauss -N 8 --field 14 -w d --size 64 --pitch 1um --csv --digits 4 --columns peak,peak_y,centroid_y,width_x,width_y,inside,method
lenscalc psf double-gauss -N 8 --field 14 -w d --size 64 --pitch 1um --method fft --csv --digits 3 --columns peak,peak_y,centroid_y,width_x,width_y,inside,method
lenscalc psf double-gauss -N 8 --field 14 -w d --size 32 --pitch 1um --method huygens --csv --digits 4 --columns peak,peak_y,width_x,width_y,inside,method
lenscalc psf double-gauss -N 8 --field 0 --spectrum d:1,F:0.5 --size 32 --json --digits 3 --columns peak,width_x,inside,spectrum
lenscalc psf double-gauss -N 8 --field 0 -w d --size 32 --defocus -0.2,0,0.2 --csv --digits 4 --columns defocus,peak
lenscalc psf questar-35 -w d --field 0 --size 64 --csv --digits 4 --columns peak,width_x,radius80,inside
lenscalc psf double-gauss -N 8 --field 0,80 --size 16 --csv --digits 3 --columns field,peak,warning
telescope='lens telescope\nobject inf\naperture epd 10\nfield angle 0\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n'
printf "$telescope" | lenscalc psf -
printf "$telescope" | lenscalc psf - --field 1 --method fft --size 64 --pitch-angle 0.05mrad --json --digits 4
printf "$telescope" | lenscalc psf - --pitch 3um
printf "$telescope" | lenscalc psf - --method huygens
printf "$telescope" | lenscalc psf - --method fft --pitch-angle 1mrad
printf "$telescope" | lenscalc psf - --size 16 --columns field,width_x --plot telescope.svg && grep -o '>[^<>]*</text>' telescope.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
lenscalc psf double-gauss --field 0 -w d --pitch-angle 1mrad
lenscalc psf double-gauss --field 0 -w d --pitch 1um --pitch-angle 1mrad
printf 'lens ideal\nobject inf\naperture stop\nstop - 0 air 10\nthick 50 0 air 12\n' | lenscalc psf -
lenscalc psf double-gauss -N 8 --field 0 -w d --method fft --pitch 20um
lenscalc psf double-gauss --field 14 -w d --method fft --pitch 0.05um --no-clip --size 16
lenscalc psf double-gauss --field 14 -w d --pitch 900um --size 2048
lenscalc psf double-gauss --field 0 -w d --pitch 20um
lenscalc psf double-gauss --field 0 -w d --pitch 20um --size 63 --csv --digits 4 --columns peak,inside,radius80,warning
lenscalc psf double-gauss --field 14 -w d --method fft --pitch 0.05um --size 16
lenscalc psf fisheye-270 --field 0 -w d --method plane
# by rays, where that is not asked for
lenscalc psf fisheye-270 --field 0 -w d --csv --digits 3 --columns radius80,inside,pitch,method,warning
lenscalc psf double-gauss --log
lenscalc psf double-gauss -N 8 --field 0 --size 16 --log --map map.pfm
lenscalc psf double-gauss --size 4
lenscalc psf double-gauss -N 8 --size 16 --columns field --map map.pfm
lenscalc psf double-gauss -N 8 --field 0 --size 16 --columns field --map map.pfm && head -c 9 map.pfm && wc -c < map.pfm
lenscalc psf double-gauss -N 8 --log --plot maps.svg > rows && grep -o '>[^<>]*</text>' maps.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
printf "$telescope" > telescope.lens && lenscalc psf double-gauss telescope.lens --field 0 --size 16 --columns field,width_x --csv --plot both.svg; test -e both.svg || echo none
# of a sweep it is said once
lenscalc psf double-gauss -N 4,8 --field 0,7deg --pitch-angle 1mrad --columns peak
lenscalc psf double-gauss -N 8 --field 0 --linear --map image.pfm
lenscalc psf double-gauss -N 8 --field 0 --linear --log --plot both.svg
