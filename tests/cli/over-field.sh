# maps over the image: what is drawn, formats, lenses that are not round, numbers, dark places, refusals
words() { grep -o '>[^<>]*</text>' "$1" | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'; }
lenscalc spot double-gauss --over-field spot.svg > rows && words spot.svg
lenscalc spot double-gauss -N 4,8 --sensor 35mm --over-field stops.svg --threads 2 > rows && words stops.svg
lenscalc spot double-gauss --field 0..14#4 --over-field again.svg > rows && cmp spot.svg again.svg && echo alike
lenscalc wavefront double-gauss -N 8 --sensor 24x16mm --mapped strehl --over-field strehl.svg > rows && words strehl.svg
lenscalc wavefront double-gauss -N 8 --over-field rms.pfm > rows && head -c 15 rms.pfm && echo
lenscalc mtf double-gauss -N 8 --frequency 40 --over-field mtf.svg > rows && words mtf.svg
lenscalc field double-gauss --over-field bars.svg > rows && words bars.svg
lenscalc field double-gauss questar-35 --over-field bars.svg > rows && words bars.svg
lenscalc spot fisheye-16 --sensor 35mm --over-field dark.svg > rows && words dark.svg | tail -2
cylinder='lens cylinder\nwavelength d\nobject inf\naperture epd 4\nfield angle 3\nstop - 1 air -\nsurface 60 4 1.6 -\nsurface -80 5 air -\nsurface 400 2 1.5 - cyl=x\nsurface - 53 air -\nfocus table\n'
printf "$cylinder" | lenscalc spot - --rays 20 --over-field cylinder.svg > rows && words cylinder.svg
telescope='lens telescope\nobject inf\naperture epd 10\nfield angle 0 1\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n'
printf "$telescope" | lenscalc spot - --over-field afocal.svg > rows && words afocal.svg
printf "$telescope" | lenscalc field - --over-field afocal.svg > rows
printf "$telescope" | lenscalc spot - --sensor 35mm --over-field afocal.svg > rows
printf 'lens axis\nobject inf\naperture epd 10\nsurface 50 3 1.5 - stop\nsurface - 10 air -\n' | lenscalc spot - --over-field axis.svg
lenscalc spot double-gauss -N 4,8 --over-field numbers.pfm > rows
lenscalc spot double-gauss --over-field numbers.csv
lenscalc spot double-gauss --to 3 --over-field map.svg
lenscalc spot double-gauss --sensor 35mm
lenscalc mtf double-gauss --over-field map.svg
lenscalc wavefront double-gauss --zernike noll --over-field map.svg
lenscalc wavefront double-gauss --mapped strehl
lenscalc field double-gauss --show fnumbers --over-field map.svg
lenscalc field double-gauss --over-field map.pfm
