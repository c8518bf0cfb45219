# files of other programs that lose something, in every command that reads a lens
lens() {
    printf 'MODE SEQ\nUNIT MM\nENPD 10\nFTYP 0 0 2 1 0 0 0\nYFLN 0 5\nVDXN 0 0.1\n'
    printf 'WAVM 1 0.5876 1\nPWAV 1\nSURF 0\n  DISZ INFINITY\n'
    printf 'SURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n  GLAS N-BK7 0 0\n  USAP slit.uda\n'
    printf 'SURF 2\n  DISZ 90\nSURF 3\n  DISZ 0\nMNUM 1 1\n'
}
lens > odd.zmx
lenscalc lens odd.zmx --columns efl
lenscalc lens odd.zmx --lossy --columns efl
lens | sed '/USAP/d' | lenscalc lens - --columns efl
lens | lenscalc lens - --lossy --columns efl
lenscalc surfaces odd.zmx --lossy --columns surface,radius,medium
lenscalc matrix odd.zmx --lossy --csv | head -1
lenscalc conjugate odd.zmx --lossy --object 1m --columns image_distance
lenscalc draw odd.zmx --lossy -o odd.svg
lenscalc dof --lens odd.zmx --lossy -N 8,16 -s 3m --columns near
printf 'l,s\nodd.zmx,2\nodd.zmx,3\n' | lenscalc dof -N 16 --batch - --lossy --csv --columns near
lenscalc dof -f 50mm -N 8 -s 3m --lossy --columns near
