# pictures on film: prints, densities, and what has none
set -- --lens double-gauss-50 -s 1m --size 21x4 --samples 4
lenscalc render chart:wedge "$@" --film "HP5 Plus" -o print.png 2>&1 | sed 1d
grep -ao 'Film.Ilford HP5 Plus' print.png | tr '\0' ' '
lenscalc render chart:wedge "$@" --film hp5+ --grain 17 -o negative.pfm 2>&1 | sed 's/.*; //; 2d'
head -2 negative.pfm
lenscalc render chart:wedge "$@" --film hp5+ --grain 17 --crop 7:1:5x2 -o part.pfm 2> said
tail -c 20 part.pfm > part
tail -c 168 negative.pfm | tail -c +29 | head -c 20 | cmp - part && echo "the crop is the same"
rm part part.pfm said
lenscalc render chart:wedge "$@" --film "Tri-X 400" -t 100 --luminance 0.01 -o negative.exr 2>&1 | sed 1d
lenscalc render chart:wedge "$@" --film "t-max 400" -t 1us -o clear.png 2>&1 | sed 1d
lenscalc render chart:wedge "$@" --film "delta 100" -t 100 -o white.png 2>&1 | sed 1d
printf "Pf\n2 2\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0" > black.pfm
lenscalc render black.pfm "$@" --film hp5+ -o black.png 2>&1 | sed 1d
ls
lenscalc render chart:wedge "$@" --film hp5+ -o lost.hdr
lenscalc render chart:wedge "$@" --film hp5+ --iso 200 -o lost.png
lenscalc render chart:wedge "$@" --film hp5+ --noise -o lost.png
lenscalc render chart:wedge "$@" --grain 17 -o lost.png
lenscalc render chart:wedge "$@" --film velvia -o lost.png
lenscalc render chart:wedge "$@" --film "velvia 50" -o lost.png
lenscalc render chart:wedge "$@" --film "ortho+" -o lost.png
lenscalc render chart:wedge "$@" --film "tri-x" -o lost.png
lenscalc render chart:wedge "$@" --film "Tri-X 320" -t 1h -o lost.png
lenscalc render --lens double-gauss-50 --film hp5+ --rays lost.csv
mkdir own
printf 'film\tmodel\tparameters\tonset_s\tvalid_to_s\tiso\nMine\tpower\tp=1.5\t1\t-\t50\n' > own/films.tsv
lenscalc render chart:wedge "$@" --lensdb own --film mine -o lost.png
