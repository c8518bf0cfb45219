# a card with a depth map: what is said of it, and what is refused
map() { # NAME COLUMNS ROWS LAST: all at 1 m, but the last, the upper right one
    { printf 'Pf\n%d %d\n-1.0\n' "$2" "$3"; for _ in $(seq 2 $(($2 * $3))); do printf '\000\000\200\077'; done; printf "$4"; } > "$1"
}
map flat.pfm 6 4 '\000\000\200\077'
map far.pfm 6 4 '\000\000\200\177'
map zero.pfm 6 4 '\000\000\000\000'
map minus.pfm 6 4 '\000\000\200\277'
map nan.pfm 6 4 '\000\000\300\177'
map lens.pfm 6 4 '\315\314\114\075'
map card.pfm 16 8 '\000\000\200\077' # a PFM says nothing of its pixels
map square.pfm 4 4 '\000\000\200\077'
head -c 60 flat.pfm > cut.pfm
small="--lens double-gauss-50 -s 1m --size 16x8 --samples 1 -t 1/400"
lenscalc render chart:grid $small --depth-map flat.pfm -o flat.png
lenscalc render chart:grid $small --depth-map far.pfm --hidden black -o far.exr
lenscalc render chart:wedge $small -o card.png
lenscalc render card.png $small --depth-map card.png --depth 0.8m..inf -o lost.png
lenscalc render chart:wedge $small --bits 16 -w d -o grey.png
lenscalc render chart:grid $small --depth-map grey.png --depth 0.8m..inf -o graded.png
for map in zero minus nan lens cut nowhere; do
    lenscalc render chart:grid $small --depth-map $map.pfm -o lost.png
    echo $?
done
lenscalc render card.png $small --depth-map square.pfm -o lost.png
lenscalc render card.png $small --depth-map flat.pfm -o lost.png && rm lost.png # 16 x 0.75 to 8
lenscalc render card.png $small --depth-map card.pfm -o lost.png
lenscalc render card.png $small --depth-map grey.png --depth 0.8m..inf -o shaped.png && rm shaped.png # so does grey.png
lenscalc render chart:grid $small --depth-map grey.png -o lost.png
lenscalc render chart:grid $small --depth-map flat.pfm --depth 1..2 -o lost.png
lenscalc render chart:grid $small --depth-map grey.png --depth 0..2 -o lost.png
lenscalc render chart:grid $small --depth-map grey.png --depth 1.. -o lost.png
lenscalc render chart:grid $small --depth-map grey.png --depth 2 -o lost.png
lenscalc render chart:grid $small --depth-map grey.png --depth 3..2 -o lost.png
lenscalc render chart:grid $small --depth 1..2 -o lost.png
lenscalc render chart:grid $small --hidden black -o lost.png
lenscalc render chart:grid $small --depth-map flat.pfm --hidden grey -o lost.png
lenscalc render --lens double-gauss-50 --depth-map flat.pfm --rays lost.csv
ls lost.*
# what charts measure: 36 cycles/(2 pi 0.48 460.6 mm) of the card, 1/0.05303 on the film
for chart in edge star grid checker bars wedge points stars; do
    lenscalc render chart:$chart --lens double-gauss-50 -s 1m --size 16x8 --samples 1 -t 1/400 -o chart.png 2>&1 | grep -v -e saturates -e 'of the card'
done
