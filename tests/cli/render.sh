# rays from a film: rows and doubles, other seeds, dark corners, and what is refused
lenscalc render --lens cs348b-dgauss-50 --rays - --samples 4 -w d |
    awk -F, 'NR > 1 { for (i = 1; i <= NF; i++) $i = sprintf("%.7g", $i) } { print }'
lenscalc render --lens cs348b-dgauss-50 --rays - --samples 2 -w d --seed 5 | tail -1 | cut -c 1-40
lenscalc render --lens cs348b-dgauss-50 --rays rays.tsv --samples 300 --spectrum d:2,F:1
cut -f 3 rays.tsv | sort | uniq -c | sed 's/^ *//'
lenscalc render --lens cs348b-dgauss-50 --rays rays.raw --samples 4 -w d
head -1 rays.raw
tail -n +2 rays.raw | od -A n -t f8 -w88 -v | awk 'NR == 1 { for (i = 1; i <= NF; i++) printf "%.7g\n", $i }'
# the mean of E/L over the film, by an independent program: 0.110853
lenscalc render --lens cs348b-dgauss-50 --rays - -w d --focus 36.3612 | awk -F, 'NR > 1 { sum += $10 } END { printf "%.4f\n", sum }'
lenscalc render --lens fisheye-16 --rays fisheye.csv --samples 10
lenscalc render --lens nikkor-z-14-24 --position tele --rays - --samples 1 | tail -1 | cut -c 1-30
lenscalc render --lens double-gauss
lenscalc render --lens double-gauss --rays rays.png
lenscalc render --lens double-gauss --rays rays.csv -w d --spectrum photopic
lenscalc render --lens nikkor-z-14-24 --position all --rays rays.csv
lenscalc render --lens double-gauss -N 2,4 --rays rays.csv
lenscalc render --lens double-gauss --rays rays.csv --from sensor
lenscalc render --lens double-gauss --rays rays.csv --full-well 0
# pixels that take little light lose none of the pupil; what is explained of rays
lenscalc render --lens double-gauss-50 --rays rays.csv --samples 64 --acceptance 100
lenscalc render --lens double-gauss-50 --rays rays.csv --samples 64 --explain 2>&1 | sed 's/^[0-9.]* %/P %/'
# behind cylinders; an independent quadrature has 0.2077 in the middle of the film
lenscalc render --lens schneider-anamorphic-31 --rays - -w d --sensor 0.001x0.001mm | awk -F, 'NR > 1 { sum += $10 } END { printf "%.4f\n", sum }'
lenscalc convert phone-6p | sed '/^aperture/d' | lenscalc render --lens - --rays lost.csv
lenscalc render --lens laikin48-telescope --focus 0 --rays lost.csv
printf 'lens afocal\naperture stop\nstop - 1 air 5\nsurface 50 5 1.5 20\nsurface - 100 air 20\nsurface - 5 1.5 20\nsurface -50 0 air 20\n' | lenscalc render --lens - --rays lost.csv
ls lost.csv
# pictures: their formats, and what is said of them
lenscalc render chart:wedge --lens double-gauss-50 -s 1m --size 32x8 --samples 4 -t 1/250 -o wedge.png
head -c 24 wedge.png | tail -c 8 | od -A n -t x1
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 32x8 --samples 4 --bits 16 -o edge.png
head -c 26 edge.png | tail -c 2 | od -A n -t x1
lenscalc render chart:checker --lens fisheye-16 -s 1m --from sensor --size 16x16 --samples 1 -o checker.exr 2> said
sed 's/[0-9.]* x [0-9.]* mm/W x H mm/; s/1\/[0-9.]* s/T/' said
lenscalc render chart:bars --lens double-gauss-50 -s 1m --size 8x8 --samples 1 -t 2 --iso 3200 -o bars.hdr 2>&1 | grep -c saturates
lenscalc render wedge.png --lens double-gauss-50 -s 1m --size 8x8 --samples 1 -o again.pfm 2> said; echo $?
head -2 again.pfm
ls
# more light than a number of a file holds; tiles of a picture that is thinner lose no rays
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 8x8 --samples 1 -t 1e300 -o lost.exr
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 8x8 --samples 1 --luminance 1e300 --radiance -o lost.pfm
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 6000x1 --samples 1 -o thin.png 2>&1 | grep -c arrive; rm thin.png
lenscalc render chart:foo --lens double-gauss-50 -s 1m -o lost.png
lenscalc render chart:cheker --lens double-gauss-50 -s 1m -o lost.png
lenscalc render nowhere.png --lens double-gauss-50 -s 1m -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 6cm --size 8x8 --samples 1 -o near.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m --samples 3 -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 30 -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m --bits 12 -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m -o lost.jpg
lenscalc render chart:edge -s 1m -o lost.png
head -c 100 wedge.png > cut.png
lenscalc render cut.png --lens double-gauss-50 -s 1m -o lost.png
ls lost.*
# an iris of blades
lenscalc render --lens double-gauss-50 --rays - --blades 5 --samples 4096 -w d --sensor 0.001x0.001mm | awk -F, 'NR > 1 { sum += $10 } END { printf "%.3f\n", sum }'
lenscalc render chart:points --lens double-gauss-50 -s 1m --blades 2 -o lost.png
lenscalc render chart:points --lens double-gauss-50 -s 1m --blade-turn 3 -o lost.png
# a sensor: its noise, mosaic and balance, its numbers
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 16x8 --samples 1 --noise --pitch 4um --read-noise 2 --mosaic rggb -o noise.png 2>&1 | sed 1d
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 16x8 --samples 1 --white tungsten -t 1/1000 -o warm.png 2>&1 | sed 1d
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 16x8 --samples 1 --raw --mosaic gbrg -o raw.png 2>&1 | sed 1d
grep -ao 'CFA pattern.gbrg' raw.png | tr '\0' ' '
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 16x8 --samples 1 --noise -t 1us --iso 100 --pitch 1um -o dark.png 2>&1 | sed 1d
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 16x8 --samples 1 --noise -t 10s --full-well 100 -o full.png 2>&1 | sed 1d
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 8x8 --samples 1 -t 10s -o bright.pfm 2>&1 | sed 1d
printf 'Pf\n2 2\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0' > black.pfm
lenscalc render black.pfm --lens double-gauss-50 -s 1m --size 8x8 --samples 1 -o black.png 2>&1 | sed 1d
lenscalc render chart:edge --lens double-gauss-50 -s 1m --noise -o lost.pfm
lenscalc render chart:edge --lens double-gauss-50 -s 1m --white blue -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m --white auto --raw -o lost.png
# what only rays or only pictures take, cards too near, a mirror lens
lenscalc render chart:edge --lens double-gauss-50 -s 1m --spectrum d:1,F:1 --band 40 -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m -w d --band 40 -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m --band 101 -o lost.png
lenscalc render --lens double-gauss-50 --band 40 --rays lost.csv
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 8x8 --samples 1 --band 40 -o band.png 2> said
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 8x8 --samples 1 --spectrum photopic -o grey.png 2> said
ls band.png grey.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m --rays lost.csv
lenscalc render --lens double-gauss-50 --noise --rays lost.csv
lenscalc render chart:edge --lens double-gauss-50 -s 1m --bits 16 -o lost.pfm
lenscalc render chart:edge --lens double-gauss-50 -s 1m --bits 8 --raw -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m --noise --pitch 1e-6um -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 4cm -o lost.png
lenscalc convert asahi-takumar-100 | sed '/^field/d; s/^stop/surface/' | lenscalc render chart:edge --lens - -s 1m -o lost.png
lenscalc render chart:edge --lens mirror-tele-us5331467 -s 30m --size 8x8 --samples 1 -o mirror.png 2>&1 | sed 's/^[0-9.]* x [0-9.]*/W x H/'
# part of a picture
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 40x20 --samples 1 --crop 30:10:10x7 -o crop.pfm; head -2 crop.pfm
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 40x20 --crop 31:10:10x7 -o lost.pfm
lenscalc render chart:edge --lens double-gauss-50 -s 1m --crop 1:2:0x7 -o lost.pfm
lenscalc render chart:edge --lens double-gauss-50 -s 1m --crop 1,2,3x7 -o lost.pfm
lenscalc render chart:edge --lens double-gauss-50 -s 1m --crop 1:2:3x7 --white auto -o lost.png
lenscalc render --lens double-gauss-50 --crop 1:2:3x7 --rays lost.csv
# several exposures, a file each; kinds of files; rays beside a picture
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 40x20 --samples 1 -t 1/100,1/400 --iso 100,200 -o night.d/several.pfm
mkdir night.d
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 40x20 --samples 1 -t 1/100,1/400 --iso 100,200 -o night.d/several.pfm
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 40x20 --samples 1 -t 1/100..1/400#10 -o night.d/plain 2>&1
lenscalc render chart:edge --lens fisheye-16 -s 1m --size 16x16 --samples 1 -t 1/100 -o corners.exr --bits 16 --rays corners.csv
ls night.d corners.*
lenscalc render chart:edge --lens double-gauss-50 -s 1m -t 1/100,1/400 -o - > lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m -t 1/100,1/400 -o lost.png --rays lost.csv
lenscalc render chart:edge --lens double-gauss-50 -s 1m -t 1..2#101 -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m -N 2,4 -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m --packing none -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m --radiance -o lost.png
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 8x8 --samples 1 --luminance 1e9 -t 1 --bits 16 -o lost.exr 2>&1 | tail -1
lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 8x8 --bits 8 -o lost.exr
rm -f lost.png
# parts, and what is refused of them
edge() { lenscalc render chart:edge --lens double-gauss-50 -s 1m --size 40x20 --samples 1 "$@"; }
edge --part 1/2 -o first.part
edge --part 2/2 -o second.part
edge --part 2/2 --resume -o second.part
sed '/^$/,$d' first.part | sed 's/^\(version\|input\|length\|body\) .*/\1 .../'
lenscalc merge second.part first.part -o both.pfm && head -2 both.pfm
lenscalc merge first.part -o lost.pfm
lenscalc merge first.part --incomplete -o half.exr; echo "status $?"; grep -ao 'Incomplete.string.....[a-z ]*' half.exr | tr -d '\0\21'
lenscalc merge first.part second.part --incomplete -o half.pfm && cmp half.pfm both.pfm
lenscalc merge first.part second.part -o lost.part
lenscalc merge first.part second.part -o lost
lenscalc merge first.part lost.part -o lost.pfm
lenscalc merge
edge --part 3/2 -o lost.part
edge --part 1/2 -o lost.pfm
edge --resume -o lost.pfm
edge --seed 1 --part 2/2 --resume -o second.part
edge --part 1/2 --resume -o second.part
edge --part 1/2 -o lost.part --rays lost.csv
edge --part 1/2 -o lost.part --explain
lenscalc convert double-gauss-50 | lenscalc render chart:edge --lens - -s 1m --part 1/2 -o lost.part
lenscalc convert double-gauss-50 -o own.lens && lenscalc render chart:edge --lens own.lens -s 1m --size 40x20 --samples 1 -o own.part
echo >> own.lens && lenscalc merge own.part -o lost.pfm 2>&1 | sed 's/input .*/input .../'
ls lost.*
