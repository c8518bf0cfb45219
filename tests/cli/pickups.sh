# numbers that follow others, marks of every kind, goals: read, changed, written
cat > whole.lens <<'END'
lens every kind
position wide tele
let d4 2.5~ 15~[10,20]
pickup R3 = -R1
pickup t3 = 0.5 t4 + 2
pickup glass5 = glass1
goal efl = 50
goal spot@14deg
surface 50 3 1.6/50 20 k=-1 A4=1e-6 R~[20,90] k~ A4~[-1e-5,1e-5] glass~ dx~ dy~[-0.1,0.1]
surface -80 1 air 20 c~[-0.1,inf] ax~[-1,1] ay~
surface -50 3.25 1.7/30 20
surface 90 d4 air 20 R~[50,-60]
surface 40 2 1.6/50 20
surface - 3 air 20 t~
thick 70 3 air - focal~[50,90]
surface - - air -
END
lenscalc convert whole.lens -o own.lens; cat own.lens
lenscalc convert own.lens | diff own.lens - && echo same
lenscalc convert own.lens -o own.json && lenscalc convert own.json | diff own.lens -
grep -o '"pickups":.*"goals":[^]]*]' own.json
grep -o '"vary":[^]]*]' own.json
lenscalc convert own.lens --scale 2 | grep 'let\|pickup\|goal\|~'
lenscalc convert own.lens --unit cm | grep 'let\|pickup\|goal\|~'
lenscalc convert own.lens --reverse | grep 'let\|pickup\|goal\|~'
lenscalc convert own.lens --position tele | grep 'let\|pickup\|goal\|~'
# a number that is not what the pick-up gives
sed 's/-50 .*3.25/-51.3 3.25/' own.lens > typed.lens
lenscalc lens typed.lens --position tele --csv --columns efl_mm,warning
lenscalc convert typed.lens | diff own.lens -
# another program's file
grep -v 'thin\|surface     40' own.lens | sed '/glass5/d' > plain.lens
for to in zmx seq len dat; do lenscalc convert plain.lens --to $to > /dev/null; done
lenscalc convert plain.lens --to zmx --lossy | tr -d '\r' | grep 'CURV\|NOTE'
# of other programs: what the lens has to the last bit is kept
cat > pik.seq <<'END'
RDM
LEN NEW
DIM M
EPD 10
WL 587.6
SO 0 1e20
S 50 3 600600
S -50 2
STO
S 80 2 600600
S -50 2
S 0 40
SI 0 0
PIK RDY S5 Z1 RDY S1 Z1 -1.0 0.0
PIK THI S4 Z1 THI S1 Z1 0.5 1.0
PIK CUY S2 Z1 CUY S1 Z1 -0.8
PIK GLA S4 Z1 GLA S1 Z1
GO
END
lenscalc convert pik.seq -o pik.lens; grep 'pickup\|surface' pik.lens
lenscalc convert pik.lens | diff pik.lens -
cat > pzup.zmx <<'END'
MODE SEQ
UNIT MM
ENPD 10
SURF 0
  TYPE STANDARD
  DISZ INFINITY
SURF 1
  STOP
  TYPE STANDARD
  CURV 0.02 0
  DISZ 3
  GLAS ___BLANK 1 0 1.6 60 0
SURF 2
  TYPE STANDARD
  CURV -0.02 4 1 -1 0 0
  DISZ 4
  PZUP 1 1 1 0
SURF 3
  TYPE STANDARD
  CURV 0 0
  DISZ 0
MNUM 1 1
END
lenscalc convert pzup.zmx | grep 'pickup\|surface'
# what cannot be
say() { printf 'position a b\nlet d2 2 5\nsurface 50 3 1.5/60 20 R~\nsurface -50 d2 air 20
surface 60 5 N-BK7 20\nsurface -60 3 air 20\n%s\n' "$1" > bad.lens; lenscalc lens bad.lens > out; }
say 'pickup R9 = R1'
say 'pickup R2 = -c2'
say 'pickup R1 = R3'
say 'pickup t2 = t1'
say "pickup R2 = R4
pickup R4 = R3
pickup R3 = R2"
say "pickup R2 = R4
pickup c2 = c4"
say 'pickup R2 = R1 + R3'
say 'pickup r2 = R1'
say 'pickup n4 = n3'
say 'goal'
printf 'position a b\nlet d1 2~ 3\nsurface 50 d1 1.5 -\nsurface -50 d1 air -\nsurface - 3 air -\n' > words.lens
lenscalc convert words.lens --to json
lenscalc convert words.lens --position a | grep 'pickup\|~'
