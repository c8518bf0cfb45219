# wave fronts, images of points, contrast: no image, no stop, no diameter, no aperture, no light, fields out of reach, lost rows keep their place
afocal='lens telescope\nobject inf\naperture epd 10\nfield angle 0\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n'
thick='lens ideal\nobject inf\naperture stop\nfield angle 0\nstop - 0 air 10\nthick 50 0 air 12\n'
stopless='lens stopless\nobject inf\naperture epd 5\nfield angle 5\nsurface 50 3 1.5 10\nsurface -50 10 air 10\n'
narrow='lens narrow\nobject inf\naperture stop\nfield angle 0\nsurface 50 3 1.5 - stop\nsurface -50 10 air -\n'
open='lens open\nobject inf\nfield angle 0\nsurface 50 3 1.5 - stop\nsurface -50 10 air -\n'
dark='lens dark\nobject inf\naperture epd 10\nfield angle 0\nsurface 50 3 1.5 20 stop\nsurface -50 10 air 20\nblock circle 20\n'
for command in wavefront psf mtf; do
    for lens in "$thick" "$narrow" "$open" "$dark"; do
        printf "$lens" | lenscalc $command - --csv; echo "status $?"
    done
    lenscalc $command double-gauss -N 8 --field 80; echo "status $?"
    lenscalc $command nobody; echo "status $?"
done
for words in 'psf - --pitch 3um' 'mtf -'; do
    printf "$afocal" | lenscalc $words --csv; echo "status $?"
done
printf "$afocal" | lenscalc wavefront - --csv --digits 4 --columns field,rms_waves,sphere; echo "status $?"
printf "$stopless" | lenscalc psf - --method huygens; echo "status $?"
lenscalc psf double-gauss -N 8 --field 0 -w d --method fft --pitch 20um; echo "status $?"
lenscalc wavefront double-gauss -N 8 --field 0,80,10 --csv --digits 3 --columns field,rms_waves,warning; echo "status $?"
lenscalc psf double-gauss -N 8 --field 0,80,10 --size 16 --csv --digits 3 --columns field,peak,warning; echo "status $?"
lenscalc mtf double-gauss -N 8 --field 0,80,10 --frequency 20 --csv --digits 3 --columns field,sagittal,warning; echo "status $?"
