# configurations of a .zmx file: each is the lens that a file of its own would be
cat > head.zmx <<'END'
MODE SEQ
NAME two glasses
UNIT MM X W X CM MR CPMM
ENPD 10
GCAT SCHOTT
FTYP 0 0 1 1 0 0 0
YFLN 0
PWAV 1
END
# CURVATURE GLASS CONIC A4 THICKNESS WAVELENGTH STOP SEMI-DIAMETER
file() {
    cat head.zmx
    printf 'WAVM 1 %s 1\nSURF 0\n  DISZ INFINITY\nSURF 1\n' "$6"
    [ "$7" = 1 ] && echo '  STOP'
    printf '  CURV %s 0 0 0 0 ""\n  DISZ 6\n  GLAS %s 0 0 1.5 40\n  DIAM 8 1 0 0 1 ""\n' "$1" "$2"
    printf 'SURF 2\n'
    [ "$7" = 2 ] && echo '  STOP'
    printf '  TYPE EVENASPH\n  CURV -0.01 0 0 0 0 ""\n  CONI %s\n  PARM 2 %s\n  DISZ %s\n' "$3" "$4" "$5"
    printf '  DIAM %s 1 0 0 1 ""\nSURF 3\n  CURV 0\n  DISZ 0\n' "$8"
}
file 0.025 N-BK7 -1 2e-5 80 0.5875618 1 7 > 1.zmx
file 0.02 N-SF5 -2 1e-5 90 0.6563 2 7.5 > 2.zmx
file 0 N-BK7 -1.5 5e-6 95 0.4861 1 6 > 3.zmx
operand() { # KEYWORD NUMBER VALUE...
    keyword=$1 number=$2 p=0
    shift 2
    for value; do
        p=$((p + 1))
        printf '%s %s %s %s 0 0 0 1 1 1 0 0 "" 0\n' "$keyword" "$number" "$p" "$value"
    done
}
# the surfaces are those of the configuration that was shown last
tail_of() {
    echo "MNUM 3 $1"
    operand THIC 2 80 90 95
    operand GLSS 1 N-BK7 N-SF5 N-BK7
    operand CRVT 1 0.025 0.02 0
    operand CONN 2 -1 -2 -1.5
    operand PAR2 2 2e-5 1e-5 5e-6
    operand SDIA 2 7 7.5 6
    operand WAVE 1 0.5875618 0.6563 0.4861
    operand STPS 0 1 2 1
    echo 'CSUM 1'
}
for shown in 1 2 3; do
    { cat $shown.zmx; tail_of $shown; } > all$shown.zmx
    for p in 1 2 3; do
        lenscalc convert all$shown.zmx --position $p -o got.lens &&
            lenscalc convert $p.zmx -o want.lens && cmp got.lens want.lens && echo same
    done
done
# and back
lenscalc convert all2.zmx -o all.lens && grep '^set\|^let' all.lens
lenscalc convert all.lens -o again.zmx && lenscalc convert again.zmx -o again.lens &&
    cmp all.lens again.lens && echo same
# fields
{ cat 1.zmx; echo 'MNUM 2 1'; operand YFIE 1 0 5; operand STPS 0 1 1; } > a.zmx
lenscalc convert a.zmx | grep '^set\|^field'
# of a wavelength that is not there
{ cat 1.zmx; echo 'MNUM 2 1'; operand WAVE 4 0.5 0.6; } > a.zmx && lenscalc convert a.zmx | grep '^wave'
# what no position can hold
{ cat 1.zmx; echo 'MNUM 2 1'; operand FLTP 0 0 1; } > a.zmx && lenscalc lens a.zmx
{ cat 1.zmx; echo 'MNUM 2 1'; operand STPS 0 1 7; } > a.zmx && lenscalc lens a.zmx
{ cat 1.zmx; echo 'MNUM 2 1'; operand GLSS 1 N-BK7 NOSUCH; } > a.zmx && lenscalc lens a.zmx
{ cat 1.zmx; echo 'MNUM 2 1'; echo 'CRVT 1 2'; } > a.zmx && lenscalc lens a.zmx
