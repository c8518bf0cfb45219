# a glass comes from the catalogues that a file names, as nd and Vd in its line say
lens() {
    printf 'MODE SEQ\nUNIT MM\nENPD 10\nGCAT %s\nSURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n' "$1"
    printf '  CURV 0.02\n  DISZ 4\n  GLAS %s\nSURF 2\n  CURV -0.02\n  DISZ 90\nSURF 3\n  DISZ 0\nMNUM 1 1\n' "$2"
}
lens CDGM 'BAF6 0 0 1.60801 46.21' > baf6.zmx
# the model glass of nd 1.60801: 1/f = (n - 1) (2/R - (n - 1) d/(n R^2)), f = 41.7492 mm
lenscalc lens baf6.zmx --csv --columns efl,warning --digits 6
# in the infrared nd and Vd do not describe a glass
sed 's/^GCAT/WAVM 1 4 1\nGCAT/' baf6.zmx > infrared.zmx
lenscalc lens infrared.zmx
echo "status $?"
lens 'SCHOTT CDGM' 'F2 0 0 1.61293 36.96' > f2.zmx
lenscalc convert f2.zmx | tail -n 2
lens MISC 'WATER 0 0 1.5 40' > water.zmx
lenscalc lens water.zmx --csv --columns wavelength,warning
# a damaged glass of an AGF file is left out, the others are read
printf 'NM ONE 2 517642 1.5168 64.17\nED 7.8 - 5.2\nCD 1.04 0.006 0.23 0.02 1.01 103.56\n' > own.agf
printf 'NM TWO 1 0 1.5 0\nCD 2.25 0\n0 0\nLD 0.4\n0.7\n' >> own.agf
lenscalc glass TWO --agf own.agf -w d --columns glass,catalog,index,from,to
lenscalc glass ONE --agf own.agf
printf 'NM THREE 1 0 1.5 0\nCD 2.56 0 0 0 0 0\nLD 0.4 0.7\n' > other.agf
lenscalc glass TWO --agf own.agf --agf=other.agf -w d --csv --columns glass,catalog,index
lenscalc glass THREE --agf own.agf --agf other.agf -w d --csv --columns glass,catalog,index
lenscalc glass THREE --agf own.agf --agf other.agf --agf own.agf
lenscalc glass THREE --agf other.agf --agf
echo "status $?"
# makers without a prefix of their own in .len
printf 'focus table\naperture epd 5\nsurface 50 4 CDGM:BAF4 12 stop\n' > baf4.lens
printf 'surface -50 3 HIKARI:4786 12\nsurface 60 90 air 12\n' >> baf4.lens
lenscalc convert baf4.lens -o baf4.len
grep -n 'glass\|GLA' baf4.len
lenscalc convert baf4.len | tail -n 3
# the catalogue among several of a name is said in every format, where no chosen column says it
lenscalc glass SF6 -w d --columns index --csv --digits 6
lenscalc glass nbk7,SF6 -w d --columns index --jsonl --digits 6
lenscalc glass SF6 -w d --columns index,taken_as --csv --digits 6
