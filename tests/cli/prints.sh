# prints: by paper, size or long side, with viewing distance and eye
dof() { lenscalc dof -f 50 -N 8 -s 3 --csv --digits 6 --columns coc_mm,coc_criterion "$@"; }
dof --print A2,A4@1m,b5,letter,A3+,16x24in,24x16in,'10 x 15 cm',30cm,300,30cm@50cm,A3@20/20,A3@1m@6/9
dof --print A2 --sensor 4/3
dof --print A2 --viewing 1m --acuity 6.875
dof --coc print --print A4
dof --coc d/1500,print --print A4
dof --print 20..40:10mm
dof --print 20,30cm
printf 'print,s\nA2@1m,3\n254,3\n,3\nA12,3\n' | lenscalc dof -f 50 -N 8 --batch - --csv \
    --digits 5 --columns coc_mm,coc_criterion,error
lenscalc hyperfocal -f 50 -N 8,11 --print A4,A3@1m,300 --table print,N
lenscalc stars -f 24 --print A3@1m --columns allowed_trail
lenscalc diffraction -N 8 --print A3@1m --csv --columns coc_mm
for wrong in 16x24 xx A2@1 A2@1m@2m A2@20/20@20/10 -3 0x3in 1:2 A2@ A2@0m A2@0/20; do
    dof --print $wrong
    echo "status $?"
done
dof --print A2@1m --viewing 1m
dof --print A2@20/20 --acuity 5
dof --print A2 -c d/1500
