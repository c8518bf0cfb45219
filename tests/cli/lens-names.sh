# the name of a lens goes through a pipe, the title beside it is read as none
lenscalc spot double-gauss cooke-triplet-50 --field 0 -w d --csv --digits 4 \
    --columns lens_name,lens,rms_um > spots.csv
cat spots.csv
lenscalc mtf --batch spots.csv --field 0 --frequency 30 -w d --csv --digits 3 \
    --columns lens_name,tangential
# files and positions, one lens and none
lenscalc convert canon-nfd-70-210 -o zoom.lens
lenscalc dof --lens zoom.lens --position all -N 8 -s 5m --csv --digits 4 --columns lens_name,near
lenscalc dof -f 50 -N 8 -s 5m --csv --digits 4 --columns lens_name,near
lenscalc lens zoom.lens -w d --columns lens_name,efl
# on request only
lenscalc lens double-gauss cooke-triplet-50 -w d --csv | head -n 1 | grep -c lens_name
lenscalc list columns spot lens_name --csv
# in whatever order; a file that has the title alone names no lens
printf '%s\n' 'lens,lens_name' 'a title,double-gauss' | lenscalc lens --batch - -w d --csv \
    --digits 4 --columns lens_name,lens,efl
printf '%s\n' lens 'Double Gauss 100 mm f/2' | lenscalc lens --batch - -w d --csv --columns efl
# a mark within a name of a surface or a glass: written, it could not be read again
printf 'lens marks\nsurface 50 1 1.5 3 name=q"a b"\nsurface - 1 air 3\n' | lenscalc convert -
printf 'lens marks\nsurface 50 1 N-"BK 7" 3\nsurface - 1 air 3\n' | lenscalc convert -
