# surfaces so flat that their radius is no number a .dat file can have are planes there
printf 'lens flat\naperture stop\nsurface - 2 1.5 20 c=1e-320\nsurface - 1 air 20 c=-1e-120\nsurface - 2 1.5 20 c=0\nsurface - 1 air 20 c=1e-99\nsurface 50 2 1.6 20\nstop - 90 air 10\n' > flat.lens
lenscalc convert flat.lens --to dat --lossy -o flat.dat
cat flat.dat
lenscalc convert flat.dat
