# a lens by name, from a file, from standard input, and what is refused
lenscalc lens double-gauss
lenscalc lens double-gauss -w d -N 2 --field 14deg
lenscalc lens "Double Gauss" -w d --columns efl_mm,bfl_mm,ffl_mm --csv
lenscalc lens canon-nfd-70-210 --position all -w d --csv --columns position,efl_mm,fnumber
lenscalc lens asahi-takumar18-bad -w d --csv --columns efl_mm,warning
lenscalc lens hubble-rc -w d --tsv --columns efl_mm,bfl_mm,track_mm
lenscalc lens schneider-anamorphic-31 -w d --section x --csv --columns efl_mm
printf 'surface 50 0 1.5 -\nsurface -50 0 air -\n' | lenscalc lens -
printf 'surface 75 0 1.5 -\nsurface - 100 air -\nsurface -25 0 1.5 -\nsurface - 0 air -\n' |
    lenscalc lens - --json
printf 'surface 50 0 SCHOTT:N-NONE -\n' | lenscalc lens -
printf 'lens x\nsurface 50 0 1.5 -\nsurfce -50 0 air -\n' > bad.lens
lenscalc lens bad.lens
lenscalc lens ./none.lens
lenscalc lens double-gaus
lenscalc lens
lenscalc lens double-gauss -w 587.56lm
lenscalc lens double-gauss --position tele
lenscalc lens canon-nfd-70-210 --position tela
lenscalc surfaces double-gauss
lenscalc surfaces questar-35 --csv --columns surface,kind,radius_mm,index,power_diopter
lenscalc matrix double-gauss -w d
lenscalc matrix double-gauss --perspective -w d --json
lenscalc list lenses --kind zoom --csv --columns lens,positions,efl_mm
mkdir -p db/lenses
cp bad.lens db/lenses/own.lens
lenscalc lens own --lensdb db
