# pixels that are not square: said, written into files, and kept by who reads them
card="render chart:wedge --lens double-gauss-50 -s 2m --sensor 24x24mm --size 9x6 --samples 4 -N 8 -t 1/8"
for type in png exr hdr pfm; do lenscalc $card -o flat.$type; done
# 24/9 over 24/6 is 2/3: pixels across and down behind the type, in no unit
grep -abo pHYs flat.png | cut -d: -f1 | { read at; tail -c +$((at + 5)) flat.png | head -c 9 | od -An -tu4 --endian=big | tr -s ' '; }
grep -abo pixelAspectRatio flat.exr | cut -d: -f1 | { read at; tail -c +$((at + 28)) flat.exr | head -c 4 | od -An -tf4; }
grep -a PIXASPECT flat.hdr
# another picture made of it has the same
lenscalc tone flat.exr -o toned.hdr 2> /dev/null && grep -a PIXASPECT toned.hdr
lenscalc tone flat.hdr -o toned.exr 2> /dev/null
grep -abo pixelAspectRatio toned.exr | cut -d: -f1 | { read at; tail -c +$((at + 28)) toned.exr | head -c 4 | od -An -tf4; }
lenscalc tone flat.png -o toned.hdr 2> /dev/null && grep -a PIXASPECT toned.hdr
# of a bracket all have the same
lenscalc render chart:wedge --lens double-gauss-50 -s 2m --size 9x6 --samples 4 -N 8 -t 1/4 -o square.exr 2> /dev/null
lenscalc tone flat.exr square.exr -o lost.png
lenscalc $(echo $card | sed s,1/8,1/4,) -o longer.exr 2> /dev/null
lenscalc tone flat.exr longer.exr -o merged.hdr 2> /dev/null && grep -a PIXASPECT merged.hdr
# a card in a scene, too: half a metre high where its picture says so, and black beyond
printf 'camera at=0,0,1 look=0,0,0 focus=1\ncard file=flat.png size=0.5 luminance=100\n' > flat.scene
sed 's/size=0.5/size=0.5,0.5/' flat.scene > given.scene
for name in flat given; do lenscalc render $name.scene --lens double-gauss-50 --model thin --size 30x20 --samples 4 -N 8 -t 1 -o $name.pfm 2> /dev/null; done
cmp flat.pfm given.pfm && echo same
# as a card it is as high as wide: 9 x 2/3 to 6
for type in png exr hdr; do
    lenscalc render flat.$type --lens double-gauss-50 -s 2m --size 6x4 --samples 1 --field-width 1m -t 1 -o card.pfm 2>&1 | grep card
done
lenscalc $card --noise --pitch 5um -o sensed.png 2>&1 | grep square
grep -ac pHYs sensed.png
# a square as large as 24/9 x 24/6 mm has sides of 4 sqrt(2/3) mm
lenscalc $card --noise -o sensed.png 2>&1 | grep -o 'a pixel of .* um'
# a crop has the pixels of the whole; 480 x 316 are as near to 23.7 x 15.6 as can be, and so are 13 x 9
lenscalc $card --crop 1:1:3x3 -o crop.hdr && grep -a PIXASPECT crop.hdr
lenscalc render chart:wedge --lens double-gauss-50 -s 2m --sensor 23.7x15.6mm --samples 1 -N 8 -o near.hdr
lenscalc render chart:wedge --lens double-gauss-50 -s 2m --size 13x9 --samples 1 -N 8 -o near.hdr
grep -ac PIXASPECT near.hdr
# files that say what cannot be
sed 's/PIXASPECT=1.5/PIXASPECT=-1/' flat.hdr > wrong.hdr
lenscalc tone wrong.hdr -o lost.png
sed 's/PIXASPECT=1.5/PIXASPECT=wide/' flat.hdr > wrong.hdr
lenscalc tone wrong.hdr -o lost.png
