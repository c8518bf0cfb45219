# a mask beside the axis, (3, -2) mm: towards one corner light ends 2 (10 - |(3, -2)|) + 5 = 17.79 mm
# from the axis, and by interpolation between columns it is said to end no nearer
printf 'lens mask\nunit mm\nwavelength d\nobject inf\naperture stop\nstop - 20 air 10\nsurface - 20 air 20 decenter=3,-2\n' > mask.lens
lenscalc render --lens mask.lens --focus 20 --rays - --samples 64 --sensor 36x24mm > rays.csv
# all corners are lit
lenscalc render --lens mask.lens --focus 20 --rays - --samples 64 --sensor 28x18mm > rays.csv
