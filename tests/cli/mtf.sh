# contrast: frequencies, methods, pixels, spectra, focus, phases, cut-offs, obstruction, drawings, refusals
lenscalc mtf double-gauss -N 5.6
lenscalc mtf double-gauss -N 5.6 --field 14 -w d --frequency 20,40 --csv --digits 4 --columns frequency,tangential,sagittal,limit_tangential,limit_sagittal,phase_tangential,phase_sagittal
lenscalc mtf double-gauss -N 5.6 --field 0,14 -w d --frequency 0 --csv --digits 5 --columns field,tangential,sagittal,cutoff_tangential,cutoff_sagittal,method
lenscalc mtf double-gauss -N 5.6 --field 10 --method geometric --frequency 20 --json --digits 4
lenscalc mtf double-gauss -N 5.6 --field 0 -w d --pitch 6um --frequency 40,80 --csv --digits 4 --columns frequency,sagittal,limit
lenscalc mtf double-gauss -N 5.6 --field 0 --spectrum photopic --frequency 40 --csv --digits 4 --columns sagittal,limit,spectrum
lenscalc mtf double-gauss -N 8 --field 0 -w d --frequency 40 --defocus -0.1,0,0.1 --csv --digits 4 --columns defocus,tangential,sagittal
lenscalc mtf questar-35 -w d --field 0 --frequency 20,60,100 --csv --digits 4 --columns frequency,sagittal,limit,cutoff_sagittal
lenscalc mtf double-gauss -N 5.6 --field 0,80 --frequency 40 --csv --digits 4 --columns field,sagittal,warning
telescope='lens telescope\nobject inf\naperture epd 10\nfield angle 0\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n'
printf "$telescope" | lenscalc mtf -
printf 'lens ideal\nobject inf\naperture stop\nstop - 0 air 10\nthick 50 0 air 12\n' | lenscalc mtf -
printf 'lens ideal\nobject inf\naperture stop\nstop - 0 air 10\nthick 50 0 air 12\n' | lenscalc mtf - --method geometric --defocus 0.1 --frequency 20 --csv --digits 4 --columns frequency,tangential,limit,cutoff_sagittal,warning
lenscalc mtf double-gauss --frequency -1
lenscalc mtf double-gauss --pitch 2mm
lenscalc mtf double-gauss --spectrum d --wavelength F
lenscalc mtf double-gauss -N 5.6 -w d --plot frequency.svg > rows && lenscalc mtf double-gauss -N 5.6 -w d --field 0 --frequency 30 --defocus -0.1..0.1#3 --plot focus.svg > rows && lenscalc mtf double-gauss -N 5.6 -w d --field 0..14#5 --frequency 30 --plot field.svg > rows
for drawing in frequency.svg focus.svg field.svg; do
    grep -o '>[^<>]*</text>' $drawing | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$' | sort
done
lenscalc mtf double-gauss -N 5.6 -w d --field 0 --frequency 30,40 --defocus -0.1..0.1#3 --columns defocus --csv --plot focus.svg
# square bars
lenscalc mtf double-gauss -N 5.6 --field 0,14 -w d --square --csv --digits 4 --columns field,frequency,tangential,sagittal,limit,contrast_error
lenscalc mtf double-gauss -N 5.6 --field 0 -w d --square --pitch 6um --frequency 0,40 --json --digits 3
lenscalc mtf double-gauss -N 5.6 --field 0 -w d --square --method geometric --frequency 10 --csv --digits 3 --columns tangential,warning
lenscalc mtf double-gauss -N 8 -w d --field 0 --square --plot bars.svg > rows && grep -o '>[^<>]*</text>' bars.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
# through focus curves are called by their fields, in the order of these; what all share is in the subtitle
lenscalc mtf double-gauss -N 5.6 -w d --field 0,7,14 --frequency 30 --defocus -0.1..0.1#5 --plot focus.svg >/dev/null &&
    grep -o '>[TS][, S]* [0-9]*°[^<]*<\|f/5.6[^<]*' focus.svg
