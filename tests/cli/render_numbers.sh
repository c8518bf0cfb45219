# sizes, areas and places are written in one way: digits, no signs, blanks, hexadecimal, no more
try() { lenscalc render chart:edge --lens double-gauss-50 -s 1m --samples 1 "$@" -o lost.pfm; }
for size in +6x4 '6x 4' ' 6x4' 6x+4 6x4x 6x4,2 6.0x4 6e0x4 6x x4 6 -6x4 0x4 6x65536 6x18446744073709551620; do try --size "$size"; done
for crop in '1:1:3 x2' +1:1:3x2 1:+1:3x2 1:1:3x2: 1:1:3 1:1:3x 1e0:1:3x2 1.0:1:3x2 18446744073709551617:1:3x2; do try --size 6x4 --crop "$crop"; done
for place in 0x0p0:0.5 0x1p-1:0.5 ' 0.5:0.5' '0.5: 0.5' +0.5:0.5 -0:0.5 0.5:nan inf:0.5 0.5:0.5: 0.5 : .:.5 1.01:0; do try --size 6x4 --autofocus "$place"; done
ls
# the same areas
for words in '--size 6X4 --crop 1:1:3X2' '--size 6x4 --crop 01:1:3x02' '--size 9x4 --autofocus .5:1.' '--size 8x4 --autofocus 5e-1:1'; do
    try $words 2> said; grep -c error said; head -2 lost.pfm | tail -1
done
