# spots: all fields, one through focus, patterns, energy, footprints, afocal lenses, refusals
lenscalc spot double-gauss
lenscalc spot double-gauss --field 0,14 -w d --defocus -0.1,0.1 --csv --digits 6 --columns field,defocus,rms,rms_chief,x,y,clear,rays
lenscalc spot double-gauss -w d,F --height 20 --real --weight beam --json --digits 5 | tail -2
lenscalc spot double-gauss -w d -N 2 --aim entrance --no-clip --focus paraxial --field 14 --pattern square --rays 52 --csv --digits 8 --columns rms,rms_x,rms_y,rms_chief,rays
lenscalc spot double-gauss --spectrum d:1,F:0.5 --field 10 --energy 50%,80% --error 1e-3 --csv --digits 4 --columns energy,energy_radius,spectrum
lenscalc spot double-gauss --to 6 -w d --field 14 --csv --digits 4 --columns rms,x,y
lenscalc spot double-gauss --object 500 -w d --field 5 --csv --digits 6 --columns rms,image
printf 'lens telescope\nobject inf\naperture epd 10\nfield angle 0 1\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n' |
    lenscalc spot - --csv --digits 5 --columns field,rms_mrad,error_mrad
lenscalc spot double-gauss --field 80
lenscalc spot double-gauss --field 0,80,10 -w d --csv --digits 4 --columns field,rms
lenscalc spot double-gauss --to 99
lenscalc spot double-gauss --spectrum d:1,Q:2
lenscalc spot double-gauss --spectrum d:0
lenscalc spot double-gauss --spectrum d:-1
lenscalc spot double-gauss --spectrum d -w F
lenscalc spot double-gauss --energy 0
lenscalc spot double-gauss --field 1 --height 2
lenscalc spot double-gauss --field 14 --pattern square --weight beam --rays 1000 --csv --digits 3 --columns rms,weights
lenscalc spot double-gauss --rays 100 --error 1e-3
lenscalc spot double-gauss --error 2
lenscalc spot double-gauss --field 14 -w d --energy 80% --reference chief --csv --digits 6 --columns radius,energy_radius
lenscalc spot double-gauss --defocus -0.1..0.1#3 --plot spots.svg > /dev/null && grep -c "<text" spots.svg
lenscalc spot double-gauss -w d --field 0,14 --defocus -0.1..0.1#11 --plot curves.svg > /dev/null && grep -c "<path\|<poly" curves.svg
# what RMS figures may be off, and why a row fails
lenscalc spot double-gauss --field 0,95 --csv --digits 3 --columns rms,error
lenscalc spot double-gauss --field 0 -w d --csv --digits 3 --columns rms,error
lenscalc spot questar-35 --to 2 --plot feet.svg > /dev/null && grep -o ">[^<]* mm<" feet.svg | sort -u
# several lenses and positions: a row each, all at one scale
for question in "double-gauss cooke-triplet-50" "canon-nfd-70-210 --position wide,tele"; do
    lenscalc spot $question --plot several.svg > /dev/null && grep -o '>[^<>]*</text>' several.svg | sed 's/^>//; s/<.*//'
done
# no exponents in labels
lenscalc spot double-gauss -w d --field 0,14 --defocus 20 --plot wide.svg > /dev/null && grep -o ">RMS [^<]*<" wide.svg
# without a stop the beam is weighed; on the axis nothing is left of aiming
lenscalc convert asahi-takumar-100 | sed '/^field/d; s/^stop/surface/' | lenscalc spot - --csv --digits 4 --columns rms,weights
lenscalc spot cooke-anamorphic-bad --csv --digits 4 --columns rms,x,y,chief_x,chief_y
