# paraxial results against exact rays: verdicts, cases, and what is refused
lenscalc check double-gauss
lenscalc check double-gauss --steps 1 --csv --digits 5 -N 4 --field 10deg
lenscalc check double-gauss --steps 1 -w F --tolerance 0.1% --csv --digits 5 --columns wavelength,quantity,exact,trusted_fnumber,trusted_field,verdict
lenscalc check fisheye-16 --field 100deg --steps 2 --json --digits 4 --columns quantity,field,paraxial,exact,difference,relative,surface | tail -32
lenscalc check canon-nfd-70-210 --position all --steps 1 --csv --digits 4 --columns position,quantity,relative,order
printf 'lens relay\nobject 100\nfield height 5\naperture na 0.05\nsurface 60 5 1.5 -\nsurface -60 2 air -\nstop - 100 air -\n' |
    lenscalc check - --steps 1
printf 'lens telescope\nobject inf\naperture epd 10\nfield angle 1\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n' |
    lenscalc check - --steps 1 --csv --digits 4
printf 'lens x\nobject inf\naperture epd 5\nsurface 50 5 1.5 - tilt=1,0\nsurface - 0 air -\n' | lenscalc check -
printf 'lens x\nobject inf\nsurface 50 5 1.5 -\nsurface - 0 air -\n' | lenscalc check -
printf 'lens x\nobject inf\naperture epd 5\nsurface 50 5 1.5 -\nsurface - 0 air -\n' | lenscalc check - --steps 1 --csv --columns quantity,order --digits 3
lenscalc check double-gauss --steps 0
lenscalc check double-gauss --tolerance 0
lenscalc check double-gauss --tolerance 3mm
lenscalc check
lenscalc check double-gauss --plot check.svg > /dev/null && grep -c '<path\|<poly' check.svg
lenscalc check double-gauss -N 2,4 --plot no.svg --csv --columns quantity | tail -1
test -e no.svg || echo none
lenscalc check double-gauss --plot check.svg > /dev/null && grep -o '>[^<]*focal[^<]*<\|>working[^<]*<' check.svg
