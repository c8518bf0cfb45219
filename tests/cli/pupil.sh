# shapes of pupils: fields, film points, outlines, and what is refused
lenscalc pupil double-gauss
lenscalc pupil fisheye-16 --field 0,54,75,85,95deg --side entrance
lenscalc pupil laikin114-wide170 --field 90,95deg --csv --digits 5
lenscalc pupil double-gauss -N 8 --field 14deg --json --digits 5
lenscalc pupil nikkor-z-14-24 --position all --side exit --csv --columns position,z,y_max,fraction --digits 5
lenscalc pupil cs348b-dgauss-50 --height 0..21.6:7.2 --side exit --digits 5 --csv --columns height,film,irradiance_per_radiance,illumination,fraction
lenscalc pupil double-gauss --height 20 --focus table --side exit
lenscalc pupil double-gauss --height 20 --focus best --side exit --csv --columns film --digits 6
lenscalc pupil double-gauss --field 14deg --side exit --outline 8 --csv --digits 5
lenscalc pupil double-gauss --field 14deg --side entrance --outline 4
lenscalc pupil hubble-rc --height 10 --side exit
printf 'lens x\nobject 100\nfield height 0 5\naperture stop\nsurface 60 5 1.5 -\nsurface -60 20 air -\nstop - 30 air 6\n' |
    lenscalc pupil -
printf 'lens x\nobject inf\naperture stop\nsurface 60 5 1.5 20 tilt=2,0\nsurface -60 20 air 20\nstop - 30 air 6 decenter=0,1\n' |
    lenscalc pupil - --field 5deg
printf 'lens x\nobject inf\nsurface 50 5 1.5 -\nsurface - 0 air -\n' | lenscalc pupil -
printf 'lens x\nobject inf\nstop - 5 air -\nsurface 50 5 1.5 -\nsurface - 0 air -\n' | lenscalc pupil -
lenscalc pupil double-gauss --field 5deg --height 5
lenscalc pupil double-gauss --height inf
lenscalc pupil double-gauss --height 5 --focus inf
lenscalc pupil double-gauss --height 5 --focus nowhere
lenscalc pupil double-gauss --field 181deg
lenscalc pupil double-gauss --outline 2
lenscalc pupil
lenscalc pupil fisheye-16 --field 0..75:25 --plot pupil.svg > /dev/null && grep -c '<path\|<poly' pupil.svg
lenscalc pupil rudolph-tessar-100 --field 35 --csv --digits 6 --columns pupil,area_mm2,projected_mm2,warning
