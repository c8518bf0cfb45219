# lens files of other programs: written, read again, scaled, turned; what is lost
lenscalc convert double-gauss -o dg.zmx
head -n 30 dg.zmx | tr -d '\r'
lenscalc convert dg.zmx -o dg.lens
lenscalc convert double-gauss -o own.lens
diff own.lens dg.lens
lenscalc lens dg.zmx --csv --columns efl,bfl,fnumber
lenscalc lens double-gauss --csv --columns efl,bfl,fnumber
lenscalc convert double-gauss --scale 0.1 --unit cm | tail -n 3
lenscalc convert double-gauss --focal-length 50mm | lenscalc lens - --columns efl --csv
lenscalc convert double-gauss --reverse | lenscalc lens - --columns efl,bfl --csv
lenscalc convert nikkor-z-14-24 --position tele --to zmx | grep -c 'THIC\|MNUM 1'
lenscalc convert nikkor-z-14-24 -o zoom.zmx
lenscalc lens zoom.zmx --position tele --columns efl --csv
cat > odd.zmx <<'END'
MODE SEQ
NAME Odd # 1
UNIT MM
ENPD 10
GCAT SCHOTT
WAVM 1 0.5875618 1
PWAV 1
SURF 0
  DISZ INFINITY
SURF 1
  STOP
  CURV 0.02
  DISZ 4
  GLAS N-BK7 0 0
SURF 2
  TYPE DGRATING
  PARM 1 0.2
  DISZ 10
  COMM a "rear" side
  COAT MGF2
  MAZH 0 0
  USAP slit.uda
SURF 3
  DISZ 0
MNUM 1 1
END
lenscalc lens odd.zmx
lenscalc convert odd.zmx --lossy
lenscalc convert odd.zmx --lossy -o odd.lens
lenscalc convert ./odd.lens --to zmx | tr -d '\r' | tail -n 22
iconv -f UTF-8 -t UTF-16 odd.lens | lenscalc convert - --to lens
sed 's/N-BK7/XYZ9/' odd.zmx | lenscalc convert - --lossy
sed 's/N-BK7 0 0/XYZ9 0 0 1.62 36/' odd.zmx | lenscalc convert - --lossy | grep XYZ\\\|1.62
printf 'surface 50 4 1.5 20 R~\nsurface -50 - air 20\n' | lenscalc convert - --to zmx
printf 'aperture f/4\nsurface 50 4 1.5 20\nsurface -50 - air 20\n' | lenscalc convert - --reverse
lenscalc convert double-gauss -o lens.abc
lenscalc convert double-gauss --scale 2 -f 50mm
lenscalc convert double-gauss --position tele
echo "status $?"
lenscalc convert canon-nfd-70-210 --position mid > mid.lens
lenscalc convert canon-nfd-70-210 --position 135mm | cmp - mid.lens && echo "the nearest, named"
lenscalc convert canon-nfd-70-210 --position 250mm
lenscalc convert no-such-lens
lenscalc convert
printf 'CC a catalogue\n' > own.agf && lenscalc convert own.agf
rm own.agf
ls
