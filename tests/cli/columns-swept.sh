# an option that varies and that no column repeats gets one: rows can be told apart
spot() {
    lenscalc spot double-gauss --field 0 --digits 4 "$@"
}
spot -N 4,8 --columns rms
spot -N 4,8 --columns N,rms --csv
spot -N 4,8 --csv | cut -d, -f1-3,6
spot -N 4 --csv | cut -d, -f1-3,5
spot -N 4 --columns fnumber,rms --csv
spot --columns fnumber,rms --csv
spot --object 1m,2m --focus best --columns object_m,object_mm,rms,image --csv
spot --object 1m,inf --jsonl | cut -d, -f1-3
spot --rays 100,400 --csv | cut -d, -f1-3
spot --aim stop,entrance --threads 2 --csv | cut -d, -f1-3
lenscalc lens double-gauss -w d --section x,y --csv --digits 4 | cut -d, -f1-5
lenscalc lens double-gauss -w d -N 4,8 --columns efl --digits 4
lenscalc trace double-gauss -w d --point 0:0:-20,0:1:-20 --direction 0:0:1 --columns y_out --digits 3
lenscalc conjugate double-gauss --object 1m,2m --columns magnification --digits 4
lenscalc fov -s 2 --field-width 1m,2m --columns focal,field_width --digits 4
# of a batch too, whose columns are answered and not handed through
printf 'N,id\n4,a\n8,b\n' | spot --batch - --csv | cut -d, -f1-4,7
printf 'N,id\n4,a\n8,b\n' | spot --batch - --csv --columns fnumber,rms
printf 'N,id\n4,a\n8,b\n' | lenscalc trace double-gauss --point 0:1:-20 --direction 0:0:1 -w d \
    --batch - --csv --digits 3 | cut -d, -f1-3,12-15
printf 'to,id\n1,a\n2,b\n' | spot --batch - --csv | cut -d, -f1-3
# what comes out goes in again: the same numbers, whatever columns were added
again() {
    column=$1
    shift
    lenscalc "$@" --csv > swept.csv && lenscalc "$1" $lens --batch swept.csv --csv > again.csv
    python3 - "$column" << 'END'
import csv, sys
first, second = ([row[sys.argv[1]] for row in csv.DictReader(open(name))]
                 for name in ("swept.csv", "again.csv"))
print(sys.argv[1], "the same" if first == second and "" not in first else (first, second))
END
}
lens=
again equal_fnumber equivalent -f 50 -N 2 -s 2,3 --to mft
lens=double-gauss
again y_out_mm trace double-gauss --point 0:1:-10,0:2:-10
again y_out_mm trace double-gauss --point 0:1:-10 --direction 0:0:1,0:0.1:1
again y_out_mm trace double-gauss --field 0 --pupil-point 0:0.1,0:0.5
again rms_um spot double-gauss -w d --field 0 --rays 40,60
# names that columns of the command answer to stay theirs
lenscalc illumination double-gauss --columns error --csv | head -n 1
lenscalc glass N-BK7 --columns PgF --csv
