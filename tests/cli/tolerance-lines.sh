# tolerances in lens files: read, written, changed, refused
cat > typed.lens <<'END'
tolerance R1 0.1% uniform
tolerance t3 0.02mm normal
tolerance element 3..4 tilt 2arcmin pivot 4
tolerance R1..R4 3fringes two-point
tolerance surface 1..4 irregularity 0.5fringes parabolic
tolerance surface 2 tilt 0.1   # degrees
tolerance elements 1..4 decenter 0.02 truncated 3sigma
tolerance elements 1..4 wedge 0.01mm
tolerance element 3..4 roll 1arcmin
tolerance focus 10um
tolerance n1..n3 0.0005
tolerance surface 1 abbe 0.5%
tolerance A4_1 1e-9
tolerance k1 0.01
tolerance surface 2..3 air 0.05
surface 50 5 1.5/60 20 k=-1 A4=1e-6
surface -50 5 air 20
surface 70 5 1.6/40 20
surface -50 50 air 20
END
lenscalc convert typed.lens -o own.lens; grep '^tol' own.lens | tee own
lenscalc convert own.lens | diff own.lens - && echo same
lenscalc convert own.lens -o own.json && lenscalc convert own.json | grep '^tol' | diff own - && echo same
grep -o '"tolerances":[^]]*]' own.json
echo scaled; lenscalc convert own.lens --scale 2 | grep '^tol' | diff own -
echo in inches; lenscalc convert own.lens --unit in -o inches.lens; grep '^tol' inches.lens | diff own -
lenscalc convert inches.lens --unit mm | grep '^tol' | diff own - && echo same
lenscalc convert inches.lens --to json | grep -o 'A4_1[^"]*'
echo reversed; lenscalc convert own.lens --reverse -o turned.lens; grep '^tol' turned.lens
lenscalc convert turned.lens --reverse | grep '^tol' | diff own -
sed -i 's/^tolerance *t3.*/tolerance t1..t4 0.02/; s/n1..n3/n4/' own.lens
lenscalc convert own.lens --reverse | grep '^tol.* [tn]'
# other programs' files have none
for to in zmx seq; do lenscalc convert own.lens --to $to > out; done
say() { printf 'tolerance %s\nsurface 50 5 1.5 20\nsurface - 5 air 20\n' "$1" > bad.lens; lenscalc lens bad.lens > out; }
say 'R9 0.1%'
say 'Q1 0.1%'
say 'r1 0.1%'
say 'surface 1 tlt 3deg'
say 'surface 1'
say 'element 1..2 shift 3'
say 'surfce 1 tilt 3'
say 'R1'
say 'R1 x'
say 'R1 0.1furlong'
say 'n1 0.1mm'
say 'R1 0'
say 'R1 100%'
say 'R1 1 unform'
say 'R1 1 uniform normal'
say 'R1 1 fringes'
say 'R1 1 3sigma'
say 'R1 1 normal 9sigma'
say 'R1 1 pivot 2'
say 'elements 1..2 tilt 1 pivot 2'
say 'element 1..2 tilt 1 pivot 9'
say 'element 2..1 tilt 1'
say 'R2..R1 1mm'
say 'R1..t2 1mm'
say 'element 0 tilt 1'
say 'dx1 1'
say 'surface 1 irregularity 1'
say ''
say 'focus'
say 'R1 inf'
say 'R1 1e400'
say 'element 1..2 tilt 95deg'
sed 's/"R1 0.1% uniform"/"R1 0.1% unifrm"/' own.json > bad.json; lenscalc convert bad.json
printf '# how well\n   tolerance   n1    500\n' > wide.tol
lenscalc tolerance double-gauss --tolerances wide.tol
