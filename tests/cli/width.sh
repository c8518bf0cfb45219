# an f-number wider than the lens is said, where its clear apertures are in the way
for command in spot wavefront psf mtf fan illumination distortion color field pupil seidel lens check surfaces conjugate; do
    lenscalc $command double-gauss -N 1,2.0304 -w d --jsonl 2>&1 |
        sed -n "s/.*\"warning\":\([^}]*\)}.*/$command \1/p" | sort | uniq -c | tr -s ' '
done
lenscalc trace double-gauss -N 1,2 -w d --pupil-point 0:1 --field 0 --columns fnumber,status,surface,warning --csv
lenscalc mtf double-gauss -N 1,1.95,1.98 -w d --field 0 --frequency 20 --columns fnumber,tangential,warning \
    --csv --digits 4
# nothing is in the way of what is not clipped, or has no diameters; the stop opens
lenscalc spot double-gauss -N 1,8 -w d --field 0 --no-clip --columns fnumber,rms,warning --csv --digits 4
# a plano-convex lens of f = 50/(1.5 - 1) = 100 mm: a front of 20 mm passes f/5
for diameter in - 20; do
    cat >bare.lens <<END
lens plano-convex
aperture f/8
surface 50 5 1.5 $diameter
stop - 95 air -
END
    lenscalc spot ./bare.lens -N 4,5.1,8 -w d --field 0 --columns fnumber,rms,warning --csv --digits 3
done
# commands that know a lens by its first-order figures say the same, of rows too
for command in 'dof -s 3' hyperfocal diffraction 'exposure -t 1/60' 'focus -s 3'; do
    echo "$command" | sed 's/ .*//'
    lenscalc $command --lens double-gauss-50 -N 1,1.98 --columns N,warning --csv
done
printf 'lens,N\ndouble-gauss-50,1\ndouble-gauss-50,2\n' > rows.csv
lenscalc dof -s 3 --batch rows.csv --csv --columns N,warning
lenscalc dof -s 3 --lens double-gauss-50 -N 1 --coc 0.2 --model exact 2>&1 | tail -2
