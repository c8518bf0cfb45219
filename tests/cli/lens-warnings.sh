# what first-order data leave out is said: tilted surfaces, bends, the best focus
printf 'focus best\nsurface 50 5 1.5 20 tilt=1,0\nsurface -50 90 air 20\n' > tilted.lens
printf 'surface 50 5 1.5 20\nbend tilt=10,0,0\nsurface -50 90 air 20\n' > bent.lens
printf 'focus best\nwavelength d F\naperture f/4\nsurface 50 5 1.5 20\nsurface -50 90 air 20 stop\n' > best.lens
lenscalc lens tilted.lens
lenscalc lens tilted.lens --csv --columns efl_mm,warning
lenscalc lens bent.lens
lenscalc lens best.lens
lenscalc surfaces tilted.lens --columns surface,power
lenscalc surfaces tilted.lens
lenscalc matrix bent.lens
lenscalc matrix bent.lens --perspective --csv
lenscalc conjugate bent.lens --object 1m --columns magnification
lenscalc draw best.lens | grep -o 'warning:[^<]*'
lenscalc lens asahi-takumar18-bad -w d,F
