# fields from where no light, or no chief ray, arrives: what is said of them
printf 'lens x\nobject inf\nfield angle 0 90\naperture epd 5\nsurface 50 5 1.5 20\nsurface -50 50 air 20\nstop - 1 air 20\n' > edge.lens
lenscalc check edge.lens --steps 1
lenscalc check edge.lens --steps 1 --csv --columns quantity,field,exact,trusted,trusted_field,status,surface --digits 4
lenscalc draw edge.lens | grep -o 'the oblique[^<]*'
printf 'lens near\nobject 200\nfield angle 0 90\naperture na 0.01\nsurface 50 5 1.5 20\nsurface -50 50 air 20\nstop - 1 air 20\n' | lenscalc check - --steps 1 --csv --columns verdict | grep field
lenscalc draw double-gauss -N 1e6 | grep -o 'the oblique[^<]*\|no ray[^<]*'
