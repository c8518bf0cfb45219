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
