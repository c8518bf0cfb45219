# polygons and circles of .uda files beside a .zmx file
lens() {
    printf '%s\n' 'MODE SEQ' 'UNIT MM' 'ENPD 10' 'WAVM 1 0.55 1' 'SURF 0' '  DISZ INFINITY' 'SURF 1' \
        '  STOP' '  CURV 0.02' '  DISZ 4' '  GLAS ___BLANK 1 0 1.5 0' '  DIAM 8 0' "$@" \
        'SURF 2' '  DISZ 90' 'SURF 3' '  DISZ 0' 'MNUM 1 1' > lens.zmx
    lenscalc convert lens.zmx | sed -n '/^surface *50/,$p'
}
printf '%s\n' '! a slit' 'LIN -5 -2' 'LIN 5 -2 3' 'LIN 5, 2' 'LIN -5 2' 'BRK' > slit.uda
printf '%s\n' '3.0, 0.0' '0, 3' '-3, 0' '0, -3' '0, 0' > OLD.UDA
printf '%s\n' 'CIR 0 0 2 32' 'BRK' 'CIR 3 1 0.5' > two.uda
printf '%s\n' 'REC 0 0 1 2 0' > other.uda
lens '  UDAD 0 "slit.uda" 1'
lens '  USAP 0 0 0' '  UDAD 0 0 "C:\apertures\SLIT.UDA"' '  OBDC 1 2'
lens '  USAP "old.uda"'
lens '  USOB 0 0 0 "two.uda"' '  OBDC 1 0'
rows() { echo "$1" | tr ';' '\n' | sed 's/^/  UDAD /'; }
square='1 1 1 0;2 3 1 0;3 3 3 0;4 1 3 0;5 0 0 0'
lens '  USOB 0 0 0' '  UDAD 0 gone.uda 1.0' "$(rows "$square")"
lens '  USAP 0 0 0' '  UDAD 0 gone.uda 1.0' "$(rows "$square;6 -3 0 0;7 -1 0 0;8 -2 2 0;9 0 0 0")"
echo '-- losses'
lens '  USAP 0 0 0' "$(rows "$square;6 2 2 0;7 4 2 0;8 3 5 0")"
lens '  USAP 0 0 0 "two.uda"'
lens '  USAP 0 0 0 "none.uda"'
lens '  USAP 0 0 0 "other.uda"'
lens '  USAP 0 2.5 0 "slit.uda"'
lens '  USAP 0 0 0'
cat lens.zmx | lenscalc convert -
lenscalc convert --check lens.zmx --columns status,reasons --csv
