# surfaces so flat that their radius is no number a .dat file can have are planes there
printf 'lens flat\naperture stop\nsurface - 2 1.5 20 c=1e-320\nsurface - 1 air 20 c=-1e-120\nsurface - 2 1.5 20 c=0\nsurface - 1 air 20 c=1e-99\nsurface 50 2 1.6 20\nstop - 90 air 10\n' > flat.lens
lenscalc convert flat.lens --to dat --lossy -o flat.dat
cat flat.dat
lenscalc convert flat.dat
# a stop between two media is a plane and a stop in pbrt's tables
printf 'aperture stop\nsurface 50 5 1.5 20\nstop - 5 1.6 16\nsurface -50 50 air 20\n' > between.lens
lenscalc convert between.lens --to dat
lenscalc convert between.lens --lossy -o between.dat && lenscalc convert between.dat
