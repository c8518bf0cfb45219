# what is doubtful about a lens is told beside a cross-table, and columns that were chosen, too
cat >model.zmx <<'END'
VERS 140124 258 36214
MODE SEQ
NAME a lens with a model glass
UNIT MM X W X CM MR CPMM
ENPD 10
GCAT SCHOTT
WAVM 1 0.5875618 1
PWAV 1
FTYP 0 0 1 1 0 0 0
XFLN 0
YFLN 0
SURF 0
  TYPE STANDARD
  CURV 0 0 0 0 0 ""
  DISZ INFINITY
SURF 1
  STOP
  TYPE STANDARD
  CURV 0.02 0 0 0 0 ""
  DISZ 5
  GLAS N-BK7 1 0 1.6 50 0 0 0 0 0 0
SURF 2
  TYPE STANDARD
  CURV -0.02 0 0 0 0 ""
  DISZ 40
SURF 3
  TYPE STANDARD
  CURV 0 0 0 0 0 ""
  DISZ 0
TOL TOFF 0 0 0 0 0 0 0
END
lenscalc dof --lens model.zmx -N 4,5 -s 2,3 --table s,N:near --digits 4
lenscalc dof --lens model.zmx -N 4,5 -s 2,3 --table s,N:near --digits 4 --csv
lenscalc lens model.zmx --columns efl --csv
lenscalc lens model.zmx --columns efl --json
lenscalc dof --lens model.zmx -N 4,5 -s 2,3 --columns near --tsv --digits 4
lenscalc dof --lens model.zmx -N 4 -s 2 --columns near,warning --tsv --digits 4
rm model.zmx
