# long: energy in circles and squares: radii, centres, spectra, fields, images at infinity, drawings, refusals
lenscalc energy double-gauss -N 8
lenscalc energy double-gauss -N 8 --field 14 --radius 2,5um --reference chief --csv --digits 4 --columns field,radius,encircled,ensquared,limit,energy_error
lenscalc energy double-gauss -N 8 --field 0 --spectrum d:1,F:0.5 --radius 5um --json --digits 3 --columns radius,encircled,spectrum,reference
lenscalc energy double-gauss -N 8 --field 0,80 --radius 5um --csv --digits 3 --columns field,radius,encircled,warning
lenscalc energy double-gauss -N 8 --field 0 -w d --radius 5um --value encircled
lenscalc energy double-gauss -N 8 --field 0 -w d --defocus -0.1,0,0.1 --radius 5,10um --table defocus,radius
telescope='lens telescope\nobject inf\naperture epd 10\nfield angle 0\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n'
printf "$telescope" | lenscalc energy - --csv --digits 3 --columns radius,encircled,limit
printf "$telescope" | lenscalc energy - --radius-angle 0.5mrad --value encircled --digits 3
printf "$telescope" | lenscalc energy - --radius 5um
lenscalc energy double-gauss -N 8 --radius-angle 1mrad
lenscalc energy double-gauss -N 8 --field 0 -w d --radius 5mm
lenscalc energy double-gauss --radius 0
lenscalc energy double-gauss -N 8 --radius 5deg
lenscalc energy fisheye-270 --field 0 -w d
lenscalc energy double-gauss -N 8 --radius 5um,10um --columns radius,encircled --plot energy.svg > rows && grep -o '>[^<>]*</text>' energy.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
lenscalc energy double-gauss -N 4..11/third --plot many.svg > rows; test -e many.svg || echo none
