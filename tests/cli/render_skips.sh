# what a picture does without: said by --explain, done all the same by --no-skip
small="--lens double-gauss-50 -s 1m --size 96x64 --samples 8"
lenscalc render chart:edge $small -t 1/400 -w d --explain -o edge.png 2>&1 | sed 's/[0-9.]* % of/N % of/'
lenscalc render chart:edge $small -t 1/400 -w d --explain --no-skip blur,uniform,pupil -o all.png 2>&1 | sed 's/[0-9.]* % of/N % of/'
lenscalc render chart:edge $small -t 1/400,1/800 --no-skip all --explain -o two.png 2>&1 | grep exposures
ls *.png
lenscalc render chart:edge $small -t 1/400 --no-skip blur,glass -o lost.png
lenscalc render chart:edge $small -t 1/400 --no-skip time,color -o lost.png
lenscalc render chart:edge $small -t 1/400 --no-skip none -o lost.png
lenscalc render chart:edge $small -t 1/400 --no-skip Blur,ALL -o kept.png
lenscalc render chart:edge $small -t 1/400 --no-skip '' -o lost.png
lenscalc render --lens double-gauss-50 --no-skip all --rays lost.csv
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 16x8 --blades 5 --no-skip pupil -o lost.png
ls lost.*
