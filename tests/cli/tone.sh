# brackets merged and shown; what files and options say of their exposure; what is refused
card='render chart:wedge --lens double-gauss-50 -s 2m --size 42x28 --samples 4 -N 8'
lenscalc $card -t 1/2,1/8,1/30 -o w.png 2> /dev/null
lenscalc $card -t 1/8 -o light.pfm 2> /dev/null
lenscalc $card --radiance -t 1/8 -o scene.exr 2> /dev/null
same() { cmp "$1" "$2" && echo "$1 and $2 are the same"; }
lenscalc tone w-1.png w-2.png w-3.png -o merged.pfm
# times by the options are those of the files
lenscalc tone w-1.png w-2.png -o by-notes.pfm 2> /dev/null
lenscalc tone w-1.png=1/2 w-2.png=1/8 -o by-names.pfm 2> /dev/null
lenscalc tone w-1.png w-2.png --times 1/2,1/8 -o by-option.pfm 2> /dev/null
same by-names.pfm by-notes.pfm
same by-option.pfm by-notes.pfm
lenscalc tone w-3.png w-1.png w-2.png --times 1/30,1/2,1/8 -o by-option.pfm
lenscalc tone by-names.pfm by-notes.pfm --times 1,1 -o twice.pfm
lenscalc tone w-2.png -N 4 --iso 200 -o single.pfm
lenscalc tone light.pfm=1/8 -o timed.pfm
lenscalc tone w-1.png w-2.png --calibrate 20 --full-well 5000 --read-noise 3 -o given.hdr
lenscalc tone scene.exr --operator linear -o linear.png
lenscalc tone scene.exr --operator gamma --gamma 1.8 --bits 16 -o gamma.png
lenscalc tone scene.exr --operator filmic --white 2000 -o filmic.png
lenscalc tone scene.exr --operator ward --ceiling human --display 2,200 -o ward.hdr
lenscalc tone light.pfm --glare --fov 20deg -o glare.pfm
lenscalc tone scene.exr --falsecolor -o colours.png
lenscalc tone scene.exr --falsecolor --scale 1,1000 --acuity --color-loss -o colours.png
lenscalc tone w-1.png w-2.png w-3.png --response debevec --curves curve.csv -o curve.pfm
wc -l < curve.csv
ls
# one pixel: too few places, no room for a scale; black is shown where the scale is given
printf 'PF\n1 1\n-1.0\n\0\0\240\100\0\0\240\100\0\0\240\100' > five.pfm
printf 'PF\n1 1\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0' > black.pfm
lenscalc tone five.pfm --operator linear -o five.png
lenscalc tone five.pfm --operator linear --fov 2 -o five.png
lenscalc tone five.pfm --operator gamma --white 5 -o five.png
lenscalc tone black.pfm --falsecolor --scale 1,10 -o black.png
rm *.pfm *.hdr curve.csv five.png black.png
cp w-1.png plain=x.png
lenscalc tone plain=x.png w-2.png -o named.png
exec 2>&1
echo "-- refused:"
lenscalc $card -t 1/8 -o light.pfm 2> /dev/null
lenscalc $card -t 1/8 --size 40x28 -o other.png 2> /dev/null
lenscalc $card -t 1/8 --noise --raw --pitch 5um -o raw.png 2> /dev/null
lenscalc $card -t 1/8 --film 'HP5 Plus' -o film.exr 2> /dev/null
lenscalc $card -t 100s -o white.png 2> /dev/null
head -c 700 w-1.png > cut.png
printf 'PF\n1 1\n-1.0\n\377\377\377\177\0\0\0\0\0\0\0\0' > nan.pfm
printf 'PF\n1 1\n-1.0\n\0\0\200\177\0\0\0\0\0\0\0\0' > inf.pfm
printf 'PF\n1 1\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0' > black.pfm
try() { lenscalc tone "$@" -o lost.png; echo "status $?"; }
try w-1.png light.pfm --times 1,2
cp light.pfm light-2.pfm
try light.pfm light-2.pfm
try w-1.png=1/0x w-2.png
try w-1.png=0 w-2.png
try w-1.png=1e-300 w-2.png
try w-1.png w-2.png --times 1,1e300
lenscalc tone w-1.png -o light.hdr 2> /dev/null
try light.hdr=1/4
cp light.hdr light-2.hdr
try light.hdr light-2.hdr
rm light.hdr
try w-1.png w-2.png --times 1
try w-1.png w-2.png --times 1,2,3
try w-1.png w-2.png --times 1,x
try w-1.png=1 w-2.png --times 1,2
try w-1.png other.png
try raw.png
try film.exr
try white.png
cp white.png white-2.png
try white.png=1 white-2.png=2
try cut.png
try nan.pfm
try inf.pfm
try black.pfm
try black.pfm --falsecolor
try none.png
try
try w-1.png --operator none
try w-1.png --operator linear --ceiling human
try w-1.png --operator ward --white 5
try w-1.png --operator linear --gamma 2
try w-1.png --display 100,1
try w-1.png --display 100
try w-1.png --display 1,100,1000
try w-1.png --display 1kg,100
try w-1.png --scale 1,100
try w-1.png --falsecolor --display 1,100
try w-1.png --bits 32
try w-1.png --response debevec
try w-1.png=1 w-2.png=1 --response debevec
try w-1.png w-2.png --calibrate 5 --iso 100
try w-1.png --full-well 5
try w-1.png --full-well 0.5
try w-1.png --align
try light.pfm=1 light-2.pfm=2 --read-noise 5
cp scene.exr scene-2.exr
try scene.exr scene-2.exr=1/4
try scene.exr -N 4
try light.pfm -N 4
try w-1.png --iso 100 --operator linear --white 5 --fov 30
lenscalc tone w-1.png --falsecolor -o lost.pfm
lenscalc tone w-1.png --fov 30 -o lost.pfm
lenscalc tone w-1.png --display 1,100 -o lost.pfm
lenscalc tone w-1.png w-2.png --curves lost.csv
lenscalc tone w-1.png -o lost.jpg
ls
