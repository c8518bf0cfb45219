# ray fans: all fields, sections, references, near and afocal images, vignetting, drawings, refusals
lenscalc fan double-gauss --field 14 -w d --points 5
lenscalc fan double-gauss --field 14 -w d --points 3 --show opd --no-clip
lenscalc fan double-gauss --points 3 --csv --digits 5
lenscalc fan double-gauss --field 14 -w d --points 3 --no-clip --json --digits 6 | head -22
lenscalc fan double-gauss -w d,F --field 10 --points 3 --no-clip --csv --digits 5 --columns wavelength,pupil_y,dy,opd_waves
lenscalc fan double-gauss --spectrum d:1,F:0.5 --field 10 --points 3 --reference centroid --no-clip --csv --digits 5 --columns wavelength,dy,reference_y,spectrum
lenscalc fan double-gauss -w d --field 0 --points 3 --reference best --no-clip --csv --digits 4 --columns pupil_y,opd_waves,reference_z,sphere
lenscalc fan double-gauss -w d --field 0 --points 3 --aim entrance --no-clip -N 2 --csv --digits 8 --columns pupil_y,dy
lenscalc fan double-gauss -w d --height 20 --height-x 15 --real --points 3 --no-clip --csv --digits 5 --columns section,height,height_x,pupil_x,pupil_y,dx,dy,opd_waves
lenscalc fan double-gauss -w d --object 500 --field 5 --defocus -0.1,0.1 --points 3 --no-clip --csv --digits 5 --columns defocus,dy
lenscalc fan questar-35 -w d --field 0 --points 9 --csv --digits 4 --columns section,pupil_x,pupil_y,dx,dy,opd_waves,status,surface
telescope='lens telescope\nobject inf\naperture epd 10\nfield angle 0 1\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n'
printf "$telescope" | lenscalc fan - --points 3
printf "$telescope" | lenscalc fan - --points 3 --field 1 --csv --digits 5 --columns section,pupil_x,pupil_y,dx_um,dx_mrad,dy_mrad,opd_waves,sphere
printf "$telescope" | lenscalc fan - --reference best
lenscalc fan double-gauss -w d --field 0,80,10 --points 3 --csv --digits 4 --columns field,pupil_y,dy
lenscalc fan double-gauss --field 80
lenscalc fan double-gauss --points 4
lenscalc fan double-gauss --points 1
lenscalc fan double-gauss --reference primary
lenscalc fan double-gauss --show both
lenscalc fan double-gauss --clip --no-clip
lenscalc fan double-gauss --points 21 --plot fan.svg > rows && lenscalc fan double-gauss -w d,F,C --field 0,14 --show opd --plot paths.svg > rows
for drawing in fan.svg paths.svg; do
    grep -c clipPath $drawing
    grep -o '>[^<>]*</text>' $drawing | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
done
lenscalc fan fisheye-16 --field 0,54.565deg,77.95deg --plot dark.svg > rows
grep -c 'no ray arrives' dark.svg
printf 'lens ideal\nobject inf\naperture stop\nstop - 0 air 10\nthick 50 0 air 12\n' | lenscalc fan - --points 3 --csv --digits 4 --columns pupil_y,opd_waves,warning
printf 'lens ideal\nobject inf\naperture stop\nstop - 0 air 10\nthick 50 0 air 12\n' | lenscalc fan - --reference best
# pupil aberrations: fields and colours, without clipping, a stop in front, a dark field, refusals
lenscalc fan double-gauss --show pupil --points 3 -w d
lenscalc fan double-gauss --show pupil --points 3 -w d,F --no-clip --field 14 --field-x 5 --csv --digits 5
lenscalc fan double-gauss --show pupil --points 3 -w d --field 0,80 --json --digits 5
printf 'lens front\nobject inf\naperture epd 4\nfield angle 5\nstop - 2 air -\nsurface 50 2 1.5 -\nsurface - 98 air -\n' | lenscalc fan - --show pupil --points 3
printf 'lens no stop\nobject inf\naperture epd 4\nfield angle 5\nsurface 50 2 1.5 -\nsurface - 98 air -\n' | lenscalc fan - --show pupil
lenscalc fan double-gauss --show pupil --reference best
lenscalc fan double-gauss --show pupil --defocus 0.1
lenscalc fan double-gauss --show pupil --aim entrance
lenscalc fan double-gauss --show pupils
lenscalc fan double-gauss --show pupil --plot pupil.svg > rows
grep -o '>[^<>]*</text>' pupil.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
