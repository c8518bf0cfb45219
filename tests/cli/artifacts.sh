# what is made beside rows or in their place: endings, places and exclusions come before any row
say() { lenscalc "$@"; echo "status $?"; }
exec 2>&1
say dof -f 50 -N 4 -s 3 --columns near_m --scale scale.gif
say dof -f 50 -N 4 -s 1..3 --columns near_m --plot plot.csv
say dof -f 50 -N 4 -s 1..3 --columns near_m --scale scale.svg
say dof -f 50 -N 4 -s 3 --columns near_m --scale
say dof -f 50 -N 4 -s 3 --columns near_m --scale ''
say dof -f 50 -N 4 -s 3 --columns near_m --scale nowhere/scale.svg
say dof -f 50 -N 4 -s 3 --columns near_m --scale same.svg -o same.svg
say dof -f 100 -N 8 --near 30cm --far 33cm --stack --columns shot --scale scale.svg
say dof -f 50 -N 4 -s 0.01 --scale scale.svg
say glass N-BK7 --abbe abbe.svg
say glass --catalog SCHOTT --nd 1.5..1.51 --label N-BK7
say tilt -f 150 -N 22 --tilt 5 --angle 90 --depth 5m
say check double-gauss -w d,F --plot check.svg
say check double-gauss --plot check.svg --csv --columns relative -o rows.csv > /dev/null && ls
say check nikkor-z-14-24 --position wide,tele --plot check.svg
say pupil double-gauss --field 0,5 --columns error --plot pupils.eps
say lensmaker --r1 50 --r2 -50 -n 1.5 --lens-file lens.zmx
say draw double-gauss -o lens.tif
say draw double-gauss -o lens.txt
say draw double-gauss -N 2,4
say convert double-gauss -o lens
say convert double-gauss -o lens --to json && head -c 1 lens && echo
printf 'wavelength_nm,index\n500,1.52\n600,1.51\n700,1.505\n800,1.5\n' > glass.csv
say fit --glass glass.csv --formula cauchy --terms 2 --columns rms -o glass.lens
say fit --glass glass.csv --formula cauchy --terms 2 --columns rms --name MINE
say fit double-gauss --columns efl_mm -o lens.tsv
say fit double-gauss --columns efl_mm -o fitted
# a drawing's name says so, or nothing at all, as that of a device
say dof -f 50 -N 4 -s 3 --csv --columns near_m --digits 4 --scale scale
head -c 5 scale; echo
say dof -f 50 -N 4 -s 3 --csv --columns near_m --digits 4 --scale scale.
lenscalc dof -f 50 -N 4 -s 3 --csv --columns near_m --digits 4 --scale /dev/null
ls
