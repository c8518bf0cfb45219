# tables of sag and slope; edges, volumes and masses of glass: refusals
lenscalc sag double-gauss --surface 1 --steps 4
lenscalc sag double-gauss --surface 2 --height 0,5,10 --csv --digits 6
lenscalc sag double-gauss --height 5 --json --digits 4 --columns surface,height,sag,slope
printf 'lens asphere\nobject inf\naperture epd 10\nsurface 50 6 N-BK7 40 k=-0.6 A4=1e-6\nsurface - 10 air 40\n' > asphere.lens
lenscalc sag asphere.lens --steps 4 --columns surface,height,sag,angle,departure
lenscalc surfaces asphere.lens --csv --digits 6 --columns surface,edge_thickness,volume_mm3,mass
lenscalc surfaces double-gauss --json --digits 4 --columns surface,edge_thickness,volume_mm3,mass
printf 'lens thin\nobject inf\naperture epd 10\nsurface 30 2 N-BK7 20\nsurface -30 10 air 20\n' | lenscalc surfaces - --csv --digits 6 --columns surface,edge_thickness,volume,mass
lenscalc sag asphere.lens --surface 2
lenscalc sag asphere.lens --surface 3
lenscalc sag asphere.lens --height 400
lenscalc sag double-gauss --surface 6 --steps 1
lenscalc sag double-gauss --surface 1 --height 5deg
lenscalc sag double-gauss --surface 1 --height 5 --steps 3
printf 'lens bare\nobject inf\naperture epd 10\nsurface 50 6 1.5 -\nsurface - 10 air -\n' | lenscalc sag -
printf 'lens flat\nobject inf\naperture epd 10\nsurface - 6 1.5 -\nsurface - 10 air -\n' | lenscalc sag -
lenscalc sag double-gauss --plot sag.svg > rows && grep -o '>[^<>]*</text>' sag.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$' | sort
# the y-ybar diagram
lenscalc surfaces double-gauss --plot ybar.svg > rows && grep -o '>[^<>]*</text>' ybar.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
lenscalc surfaces canon-nfd-70-210 --position all --plot zoom.svg > rows && grep -o '>[^<>]*</text>' zoom.svg | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
printf 'lens bare\nobject inf\nsurface 50 6 1.5 -\nsurface - 10 air -\n' | lenscalc surfaces - --csv --plot none.svg > rows
