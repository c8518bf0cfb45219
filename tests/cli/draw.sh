# cross-sections as SVG: to a file, to standard output, and what is refused
printf 'lens Singlet\naperture f/4\nsurface 50 6 1.5 20\nsurface -50 40 air 20\n' > one.lens
lenscalc draw ./one.lens --no-rays | sed 's/ d="[^"]*"//' | grep -v '^<g\|^</g'
lenscalc draw double-gauss -o lens.svg
lenscalc draw nikkor-z-14-24 --position tele --planes -o zoom.svg
lenscalc draw double-gauss --construction --title "Gauss rays" -o rays.svg
ls
grep -o '>[^<]*</text>' rays.svg
lenscalc convert erfle-eyepiece | sed '/^aperture/d' | lenscalc draw - -o none.svg
lenscalc draw nikkor-z-14-24 --position wide,tele -N 4 | grep -o '>[^<]*</text>'
lenscalc draw double-gauss --construction --planes
lenscalc draw schmidt-flat --construction
printf 'surface 50 0 1.5 20\nsurface 50 0 air 20\n' | lenscalc draw - --construction
printf 'surface - 5 air 20\n' | lenscalc draw -
lenscalc draw
ls none.svg
# a folded lens: elements, mirror and axis where they are
printf 'surface 60 8 1.5 30\nsurface -60 40 air 30\nbend tilt=45,0,0\nsurface - 0 mirror 50\nbend tilt=45,0,0\nsurface - -40 air 10\nsurface -40 -6 1.6 24\nsurface 80 -30 air 24\n' > folded.lens
lenscalc draw folded.lens | sed 's/ d="[^"]*"//' | grep -v '^<g\|^</g'
lenscalc draw folded.lens --section x | grep -o '>[^<]*left out<'
lenscalc draw folded.lens --planes
lenscalc draw folded.lens --construction
# the aperture that cuts the axial beam is the one that a ray a little farther out is lost at
lenscalc draw canon-rf50-f18 | grep -o 'axial beam is cut by the clear aperture of surface [0-9]*'
lenscalc trace canon-rf50-f18 --field 0 --pupil-point 0:0.9958,0:0.9959 -w d --csv --columns status,surface
# a table of the elements; fields that the lens does not state
lenscalc draw ./one.lens --list | grep -o '>[^<]*</text>'
# an element for the shop: what the file states, dashes for the rest
lenscalc convert double-gauss > shop.lens
printf 'tolerance R1..R11 0.1%%\ntolerance t4 0.02mm\ntolerance n4 0.0005\n' >> shop.lens
printf 'tolerance surface 4..5 irregularity 0.5fringes\ntolerance element 4..5 wedge 1arcmin\n' >> shop.lens
lenscalc draw ./shop.lens --element 3 --iso10110 | grep -o '^<svg[^>]*viewBox="[^"]*"\|>[^<]*</text>'
lenscalc draw phone-80deg --element 5 --iso10110 | grep -o '>[^<]*A[0-9]* = [^<]*</text>'
lenscalc draw double-gauss --element 7 --iso10110
lenscalc draw double-gauss --element 2
lenscalc draw double-gauss --iso10110 --element 2 --list
# equal radii of 10, 5 apart: they cross where 10 - sqrt(100 - h^2) = 2.5, h = 6.614
printf 'lens b\naperture epd 5\nsurface 10 5 1.5 17\nsurface -10 90 air 16\n' > crossing.lens
lenscalc draw ./crossing.lens --element 1 --iso10110
# an empty title is none, also without an empty element; chief rays have the colour of a field
lenscalc draw double-gauss --title '' | grep -c 'bold\|<text[^>]*></text>'
lenscalc draw double-gauss | grep -A1 '#1f5fa8" stroke-width="1.5"' | grep -c '<line'
