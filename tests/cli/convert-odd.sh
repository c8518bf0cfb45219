# aspheres with odd powers of r through every format that has them
cat > odd.lens <<'END'
lens odd
unit in
aperture epd 0.3
surface 1.2 0.2 1.5168 0.5 k=-0.7 A3=2.1e-2 A4=-1.5e-2 A5=3e-3
stop - 0.1 air 0.3
surface -1.5 0.2 1.6/50 0.5 A2=1e-2 A3=-1e-3 A19=2e-9 A20=-1e-9
surface 2 1 air 0.6 A1=0.01 A6=1e-4
END
lenscalc convert odd.lens -o own.lens
cat own.lens
lenscalc surfaces odd.lens --columns surface,kind,radius,conic --csv
for to in zmx seq len json; do
    lenscalc convert odd.lens -o odd.$to && lenscalc convert odd.$to -o $to.lens
    grep '^surface' $to.lens
done
tr -d '\r' < odd.zmx | grep 'TYPE\|PARM\|XDAT'
grep 'SPS\|SCO' odd.seq
grep 'ASP\|AS[0-9]' odd.len
grep -o '"coefficients_mm":{[^}]*}' odd.json
lenscalc convert odd.lens --to dat --lossy
lenscalc convert odd.lens --scale 2 --unit mm | grep surface
lenscalc convert odd.lens --reverse | grep surface
lenscalc trace odd.lens --point 0:0.1in:-1mm --direction 0:0:1 --csv
# what cannot be: a radius that r is divided by, other shapes, more terms
sed 's/SPS ODD 0.0/SPS ODD 2.5/' odd.seq > bad.seq; lenscalc convert bad.seq
sed 's/SPS ODD 0.0/SPS XYP/' odd.seq > bad.seq; lenscalc convert bad.seq
sed 's/SCO AR3/SCO AR23/' odd.seq > bad.seq; lenscalc convert bad.seq
sed 's/SCO AR3/SCO C4/' odd.seq > bad.seq; lenscalc convert bad.seq --to lens | grep -c A3
sed 's/XDAT 21 /XDAT 23 /' odd.zmx > bad.zmx; lenscalc convert bad.zmx
sed 's/ASP ARA 20/ASP ASX 20/' odd.len > bad.len; lenscalc convert bad.len
printf 'surface 5 2 1.5 2 A21=1\n' | lenscalc lens -
printf 'stop - 2 1.5 2 A3=1\n' | lenscalc lens -
printf 'surface 5 2 1.5 2 cyl=x A3=1\n' | lenscalc convert - --to seq
printf 'surface 5 2 1.5 2 cyl=x A3=1\n' | lenscalc convert - --to zmx
