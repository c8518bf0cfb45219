# Seidel sums in their three forms, what they leave out, and what is refused
lenscalc seidel double-gauss
lenscalc seidel double-gauss -w F,d --field 0,14deg -N 4 --csv --digits 6
lenscalc seidel double-gauss --form transverse
lenscalc seidel double-gauss --form waves --json --digits 5
lenscalc seidel phone-80deg --columns surface,S1,asphere_S1,S5,asphere_S5,lagrange_um
lenscalc seidel hubble-rc --form waves
lenscalc seidel double-gauss --height 20 --object 2000 --columns surface,S1,S5 | tail -n 4
lenscalc seidel double-gauss --field-x 3,5deg --field 4deg --csv --digits 4 | grep sum
lenscalc seidel schneider-anamorphic-31 --section x --field 5deg --columns surface,S1,C1
lenscalc seidel canon-nfd-70-210 --position all --field 3deg --csv --digits 4 | grep sum
printf 'lens telescope\naperture epd 20\nfield angle 1\nsurface 75 0 1.5/60 - stop\nsurface - 100 air -\nsurface -25 0 1.5/60 -\nsurface - 0 air -\n' > telescope.lens
lenscalc seidel ./telescope.lens --form transverse
lenscalc seidel ./telescope.lens --form transverse --csv --digits 4 | tail -n 1
printf 'lens near\nobject 100\nfield height 4\naperture stop\nwavelength d g\nsurface 60 5 1.5/60 -\nstop - 2 air 6\nthick 80 0 air - distortion=-0.1\n' > near.lens
lenscalc seidel ./near.lens
lenscalc seidel ./near.lens --chromatic lens --columns surface,C1,C2
printf 'lens table\nfield angle 4\naperture epd 4\nwavelength 1um 1.2um\nsurface 60 5 {1000nm 1.5, 1200nm 1.49} - stop\n' | lenscalc seidel -
printf 'lens bent\nfield angle 4\naperture epd 4\nsurface 60 5 1.5 - stop tilt=1,0\n' | lenscalc seidel -
printf 'lens one\naperture epd 4\nsurface 60 5 1.5 - stop\n' | lenscalc seidel -
printf 'lens one\naperture epd 4\nwavelength d\nsurface 60 5 1.5 - stop\n' | lenscalc seidel - --chromatic lens
printf 'lens odd\nfield angle 4\naperture epd 4\nsurface 60 5 1.5 - stop A3=1e-5\n' | lenscalc seidel -
printf 'lens stopless\nfield angle 4\naperture epd 4\nsurface 60 5 1.5 -\n' | lenscalc seidel -
printf 'lens dark\nfield angle 4\nsurface 60 5 1.5 - stop\n' | lenscalc seidel -
lenscalc seidel
lenscalc seidel double-gauss --form standard
lenscalc seidel double-gauss --field 3deg --height 5
lenscalc seidel canon-nfd-70-210 --position all --plot bars.svg
lenscalc seidel double-gauss --plot bars.svg > /dev/null && grep -c '<rect' bars.svg
lenscalc seidel double-gauss --explain --columns surface,S1 | tail -n 5
# a field that nobody states is said to be none of the lens
lenscalc seidel edmund-achromat-120 --plot bars.svg > /dev/null && grep -o "field 5°[^,]*" bars.svg
lenscalc seidel double-gauss --form transverse --explain --columns surface,TAchC | tail -3
# an image infinitely far away has no height; the drawing names the beam that an object limits
for field in image real; do
    printf 'lens far\nobject 98.2105263158 telecentric\nfocus afocal\nfield %s 0 5\naperture na 0.1\nsurface 51.68 4 1.5168/64.2 30\nsurface - 0 air 30\n' $field |
        lenscalc seidel -
done
printf 'lens relay\nobject 100 telecentric\nfield height 5\naperture na 0.1\nsurface 50 4 1.5 -\nsurface -50 0 air -\n' |
    lenscalc seidel - --plot bars.svg > /dev/null && grep -o 'NA [0-9.]* in object space' bars.svg
# the fifth order: mm in the image, angles of an afocal lens, its parts, and what does not go with it
lenscalc seidel double-gauss --order 5
lenscalc seidel double-gauss --order 5 --csv --digits 5 | tail -n 1
lenscalc seidel double-gauss --order 5 --columns surface,B5,intrinsic_B5,induced_B5,E5,intrinsic_E5,induced_E5 --digits 4 --csv
lenscalc seidel ./telescope.lens --order 5
lenscalc seidel double-gauss --order 5 --json --digits 4 --columns surface,C5,PI5 | tail -n 8
lenscalc seidel phone-80deg --order 5 --columns surface,B5,E5 | tail -n 5
lenscalc seidel ./near.lens --order 5 --columns surface,B5,M2
printf 'lens odd\nfield angle 4\naperture epd 4\nsurface 60 5 1.5 - stop A5=1e-5\n' | lenscalc seidel - --order 5
printf 'lens axis\naperture epd 4\nfield angle 0\nsurface 60 5 1.5 - stop\n' | lenscalc seidel - --order 5 --field 0
lenscalc seidel double-gauss --order 5 --form waves
lenscalc seidel double-gauss --order 5 --chromatic lens
lenscalc seidel double-gauss --order 7
lenscalc seidel double-gauss --order fifth
lenscalc seidel double-gauss --order 5 --plot fifth.svg > /dev/null && grep -o 'N3 elliptical[^<]*\|lines: intrinsic parts' fifth.svg
lenscalc seidel double-gauss --order 5 --explain --columns surface,F2 | tail -n 3
