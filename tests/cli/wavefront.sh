# wave fronts: figures, coefficients in three orders, references, afocal, vignetted, maps, refusals
lenscalc wavefront double-gauss -N 5.6 --columns field,rms_waves,pv_waves,strehl,strehl_marechal,clear
lenscalc wavefront double-gauss -N 5.6 --field 14deg --reference best --csv --digits 5 --columns rms_waves,pv_waves,strehl,sphere,reference,weights
lenscalc wavefront double-gauss -w F,d --field 10 --reference centroid --csv --digits 5 --columns wavelength,rms_waves,clear,rays
lenscalc wavefront double-gauss -N 5.6 --field 14deg --zernike noll --terms 11
lenscalc wavefront double-gauss -N 5.6 --field 14deg --zernike ansi --terms 6 --csv --digits 5 --columns index,n,m,coefficient_waves,residual_waves
lenscalc wavefront double-gauss -N 5.6 --field 14deg --zernike fringe --terms 4 --json --digits 5
lenscalc wavefront questar-35 --csv --digits 5 --columns field,rms_waves,pv_waves,clear
telescope='lens telescope\nobject inf\naperture epd 10\nfield angle 0 1\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n'
printf "$telescope" | lenscalc wavefront - --csv --digits 5 --columns field,rms_waves,strehl,sphere
printf "$telescope" | lenscalc wavefront - --reference best
lenscalc wavefront double-gauss -N 5.6 --field 0,80 --csv --digits 4 --columns field,rms_waves,warning
lenscalc wavefront double-gauss --field 0 --pattern hexapolar --rays 127 --no-clip --csv --digits 4 --columns rms_waves,error_waves,rays
lenscalc wavefront double-gauss -N 5.6 --explain --field 0 --columns rms_waves | tail -12
lenscalc wavefront double-gauss -N 8 --spectrum d:1,F:0.5 --csv --digits 4
lenscalc wavefront double-gauss -N 8 --spectrum d,F --zernike noll
lenscalc wavefront double-gauss -N 8 --spectrum d,F --plot none.svg
lenscalc wavefront double-gauss --terms 5
lenscalc wavefront double-gauss --size 64
lenscalc wavefront double-gauss --zernike born
lenscalc wavefront double-gauss --field 14 --zernike noll --terms 400 --rays 200
lenscalc wavefront double-gauss -N 5.6 --plot maps.svg > rows && grep -o '>[^<>]*</text>' maps.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
lenscalc wavefront double-gauss -N 5.6 --columns field --map map.png
lenscalc wavefront double-gauss -N 5.6 --field 0 --map map.pfm --size 16 > rows && head -c 9 map.pfm && wc -c < map.pfm
lenscalc wavefront double-gauss -N 5.6 --field 0 --map map.png --size 16 > rows && head -c 4 map.png | tail -c 3
printf 'lens ideal\nobject inf\naperture stop\nstop - 0 air 10\nthick 50 0 air 12\n' | lenscalc wavefront -
lenscalc wavefront questar-35 hubble-rc --field 0 --size 8 --columns field --csv --plot both.svg && grep -c '<image' both.svg && grep -o '>[^<>]*peak to valley[^<>]*</text>' both.svg
printf "$telescope" | lenscalc wavefront - --size 8 --columns field --csv --plot telescope.svg && grep -o '>against[^<]*' telescope.svg
# interferograms: pictures alone, without a scale of colours
lenscalc wavefront double-gauss -N 5.6 --field 14 --fringes --size 32 --plot fringes.svg > rows && grep -o '>[^<>]*</text>' fringes.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
lenscalc wavefront double-gauss -N 5.6 --field 14 --fringes --size 32 --map fringes.pfm
lenscalc wavefront double-gauss -N 5.6 --field 14 --fringes
# curves of the RMS
for swept in '--field 0..14:7 --spectrum d,F' '--field 0,14 -N 5.6,8 --defocus -0.1..0.1#5' '-w 450..650:50 -N 8'; do
    lenscalc wavefront double-gauss $swept --curve curve.svg > rows && grep -o '>[^<>]*</text>' curve.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
done
lenscalc wavefront double-gauss -N 8 --field 0..14:7 --defocus -0.1..0.1#40 -w 400..700:10 --columns field --curve many.svg > rows; test -e many.svg || echo none
lenscalc wavefront double-gauss -N 8 --field 14 --spectrum F:0,d:1 --csv --digits 4 --columns rms,strehl
# of two lenses the curves are called by them, and the title has none
for curve in 'laikin45-achromat -N 8 --field 0..1:0.5 --columns strehl' '-N 8 --field 0..14:7 --zernike fringe --terms 9 --across --columns c5,c9_waves' '-N 8 --field 14 --defocus -0.1..0.1#5 --reference chief,best' '-N 8 -w 450..650:50 --field 14 --zernike ansi --terms 5 --across'; do
    lenscalc wavefront double-gauss $curve --curve curve.svg > rows && grep -o '>[^<>]*</text>' curve.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
done
lenscalc wavefront double-gauss -N 8 --field 0,14 --zernike noll --terms 5 --across --csv --columns field,c1,c2,c3,c4,c5,c6,residual_waves
lenscalc wavefront double-gauss -N 8 --field 0 --zernike noll --terms 38 --across
lenscalc wavefront double-gauss -N 8 --field 0..14:7 --zernike noll --curve none.svg
lenscalc wavefront double-gauss -N 8 --field 0..14:7 --columns rms,strehl --curve none.svg > rows
lenscalc wavefront double-gauss -N 8 --field 0..14:7 --zernike noll --across --curve none.svg > rows
lenscalc wavefront double-gauss -N 8 --field 0..14:7 --aim stop,entrance --curve none.svg > rows
