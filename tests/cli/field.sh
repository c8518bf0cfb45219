# foci of a field: fields of the lens, a sweep, wavelengths, near objects, heights, afocal, refusals
lenscalc field double-gauss
lenscalc field double-gauss --field 0..14#3 --csv --digits 8 --columns field,tangential,sagittal,medial,astigmatism,petzval,image_height
lenscalc field double-gauss --field 14 -w d,F,C --csv --digits 6 --columns wavelength,tangential,sagittal
lenscalc field double-gauss --height 20 --real --focus best --defocus -0.1 --json --digits 6
lenscalc field double-gauss --object 1000 --field 10 --csv --digits 6 --columns tangential,sagittal,tangential_z,sagittal_z,image
lenscalc field double-gauss --field 3 --field-x 10 --csv --digits 6 --columns tangential,sagittal,image_height,image_height_x,section_turn
lenscalc field questar-35 --csv --digits 5 --columns field,tangential,sagittal,status,surface
lenscalc field nikkor-z-14-24 --position wide,tele --field 20 --csv --digits 5 --columns position,tangential,sagittal
printf 'lens telescope\nobject inf\naperture epd 10\nfield angle 0 1\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n' |
    lenscalc field - --csv --digits 5 --columns field,tangential,tangential_per_m,sagittal_per_m
printf 'lens cylinder\nobject inf\naperture stop\nfield angle 0 5\nstop - 5 air 4\nsurface 50 2 1.5 - cyl=y\nsurface - 98 air -\n' |
    lenscalc field - --focus table --csv --digits 5 --columns field,tangential,sagittal,medial
printf 'lens no stop\nobject inf\naperture epd 4\nfield angle 5\nsurface 50 2 1.5 -\nsurface - 98 air -\n' | lenscalc field -
lenscalc field double-gauss --field 0,80,10 --csv --digits 4 --columns field,tangential
lenscalc field double-gauss --field 80
lenscalc field double-gauss --field 200
lenscalc field double-gauss --field 1 --height 2
lenscalc field double-gauss --spectrum d,F
lenscalc field double-gauss --field 14 --explain --columns tangential,petzval
lenscalc field double-gauss --field 0..14#3 -w d,F --table field,wavelength:sagittal
lenscalc field double-gauss --field 0..14#5 -w d,F --plot field.svg --columns tangential --csv --digits 3 | tail -1
grep -o '<text[^>]*>[^<]*</text>' field.svg | sed 's/<[^>]*>//g' | head -12
# working f-numbers: fields, stopped down without clipping, a mirror with its obstruction, afocal, refusals
lenscalc field double-gauss --show fnumbers
lenscalc field double-gauss --show fnumbers --no-clip -N 4 --field 0..14#3 --csv --digits 6
lenscalc field questar-35 --show fnumbers --json --digits 5 --threads 2
lenscalc field double-gauss --show fnumbers --field 0,80 --csv --digits 5
printf 'lens telescope\nobject inf\naperture epd 10\nfield angle 0 1\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n' |
    lenscalc field - --show fnumbers --field 1
lenscalc field double-gauss --clip
lenscalc field double-gauss --show fnumber
lenscalc field double-gauss --show fnumbers --plot fnumbers.svg --csv --digits 3 | tail -1
grep -o '<text[^>]*>[^<]*</text>' fnumbers.svg | sed 's/<[^>]*>//g' | head -5
