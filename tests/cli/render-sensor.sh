# sensors: their channels, gain and bits, tables, and what is refused
set -- chart:wedge --lens double-gauss-50 -s 1m --size 21x4 --samples 4
printf '# two filters of a kind\nwavelength_nm,R,G,B\n400,0.01,0.02,0.4\n500,0.03,0.4,0.5\n600,0.4,0.3,0.02\n700,0.5,0.01,0.01\n' > qe.csv
printf 'wavelength_nm\tW\n400\t0.4\n700\t0.6\n' > grey.tsv
printf 'angle_deg,share\n0,1\n20,0.7\n40,0.1\n' > lens.csv
lenscalc render "$@" --response mono --pitch 4um -o mono.png 2>&1 | sed 1d
lenscalc render "$@" --response xyz --raw --adc 12 --black 64 --fill 0.5 --efficiency 0.8 --pitch 4um -o xyz.png 2>&1 | sed 1d
grep -ao 'White level.4095' xyz.png | tr '\0' ' '
lenscalc render "$@" --response qe.csv --mosaic rggb --noise --pitch 4um -o table.png 2>&1 | sed 1d
lenscalc render "$@" --response grey.tsv --gain 0.5 --pitch 4um -o gain.png 2>&1 | sed 's/^.*white of/white of/'
lenscalc render "$@" --full-well 500 --pitch 4um -t 100 -o full.png 2>&1 | sed 1d
lenscalc render "$@" --full-well 500 --pitch 4um --dark-current 1e4 -t 0.1 -o dark.png 2>&1 | sed 1d
lenscalc render "$@" --acceptance lens.csv -o slanting.exr 2> said
lenscalc render --lens double-gauss-50 --acceptance 2 --rays - --samples 8 -w d | wc -l
ls
lenscalc render "$@" --response mono --mosaic rggb -o lost.png
lenscalc render "$@" --response grey.tsv --mosaic rggb -o lost.png
lenscalc render "$@" --response qe.csv --efficiency 0.7 -o lost.png
lenscalc render "$@" --response qe.csv -w d -o lost.png
lenscalc render "$@" --response none.csv -o lost.png
lenscalc render "$@" --response lens.csv -o lost.png
printf 'wavelength_nm,R\n500,0.4\n700,0.5\n' > short.csv
lenscalc render "$@" --response short.csv -o lost.png
printf 'wavelength_nm,R,G\n400,0.4,0.2\n700,0.5,0.3\n' > two.csv
lenscalc render "$@" --response two.csv -o lost.png
printf 'wavelength_nm,R\n400,0.4\n700,1.5\n' > large.csv
lenscalc render "$@" --response large.csv -o lost.png
printf 'wavelength_nm,R\n400,0.4\n700,\n' > hole.csv
lenscalc render "$@" --response hole.csv -o lost.png
printf 'wavelength_nm,R,G,B\n400,0.4,0.4,0.4\n700,0.5,0.5,0.5\n' > same.csv
lenscalc render "$@" --response same.csv -o lost.png
lenscalc render "$@" --response mono --white tungsten -o lost.png
lenscalc render "$@" --white 5600K --pitch 4um -o white.png 2>&1 | sed 1,2d
grep -ao 'White balance.x 0.3302' white.png | tr '\0' ' '
rm white.png
lenscalc render "$@" --white 900K -o lost.png
lenscalc render "$@" --gain 1 --iso 200 -o lost.png
lenscalc render "$@" --black 20000 -o lost.png
lenscalc render "$@" --adc 18 -o lost.png
lenscalc render "$@" --fill 0 -o lost.png
lenscalc render "$@" --response xyz -o lost.pfm
lenscalc render "$@" --acceptance 101 -o lost.png
lenscalc render "$@" --acceptance none.csv -o lost.png
lenscalc render "$@" --acceptance qe.csv -o lost.png
printf 'angle_deg,share\n5,1\n20,0.7\n' > late.csv
lenscalc render "$@" --acceptance late.csv -o lost.png
lenscalc render --lens double-gauss-50 --adc 12 --rays lost.csv
ls lost.*
