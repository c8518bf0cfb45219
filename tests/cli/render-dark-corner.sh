# long: a mask beside the axis, (3, -2) mm: towards one corner light ends 2 (10 - |(3, -2)|) + 5 = 17.79 mm
# from the axis, and by interpolation between columns it is said to end no nearer
printf 'lens mask\nunit mm\nwavelength d\nobject inf\naperture stop\nstop - 20 air 10\nsurface - 20 air 20 decenter=3,-2\n' > mask.lens
lenscalc render --lens mask.lens --focus 20 --rays - --samples 64 --sensor 36x24mm > rays.csv
# all corners are lit
lenscalc render --lens mask.lens --focus 20 --rays - --samples 64 --sensor 28x18mm > rays.csv
# the middle is dark: a hole of 1 mm in the mask shows the stop about 2 (3, -3) mm from it
printf 'lens beside\nunit mm\nwavelength d\nobject inf\naperture stop\nstop - 1 air 6\nsurface 50 2 1.5 12\nsurface - 17 air 12\nsurface - 20 air 2 decenter=3,-3\n' > beside.lens
printf 'Pf\n1 1\n-1\n\0\0\200\077' > white.pfm
beside="render white.pfm --lens beside.lens --focus 20 -s 1m --field-width 9m --sensor 30x30mm --size 64x64"
# that is 6.06 mm beside the middle and above it, in the pixel (19, 19), which has the white of 1000
# cd/m2, or half a stop below what saturates: 78/100/sqrt(2) = 0.55 lx s
there() { tail -c 12 $1 | od -An -tf4 -N 4 | xargs printf '%.2g\n'; }
lenscalc $beside --samples 4096 --crop 19:19:1x1 --radiance -o seen.pfm && there seen.pfm
lenscalc $beside --samples 4096 --crop 19:19:1x1 -o metered.pfm && there metered.pfm
lenscalc $beside --samples 256 --error 2% -t 1 -o sure.pfm
lenscalc render --lens beside.lens --focus 20 --rays - --samples 64 --sensor 30x30mm > rays.csv
# what the corners of the film see is not known: they are dark, and so is all on the way there
lenscalc render white.pfm --lens beside.lens --focus 20 -s 1m --sensor 30x30mm -o lost.pfm
# a leaf shutter's light is followed to there as well: of the stop, 3 mm wide from its middle, the
# mask's hole leaves 1.95 mm, so that r is 2/3 0.65 on average: 10 + 2 (sqrt(1/2) - 0.433) ms = 1/94.8 s
lenscalc render white.pfm --lens beside.lens --focus 20 -s 1m --field-width 9m --sensor 30x30mm --shutter leaf --opening-time 1ms -t 1/100 \
    --size 12x8 --samples 4 -o leaf.pfm
