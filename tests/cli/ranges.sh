# lists and ranges of every kind; ends included, values a + i*step
sweep() {
    echo "[$1]" $(lenscalc dof -f 50mm -N 4 -s "$1" --csv --columns distance_m | tail -n +2)
}
sweep 1,2,5
sweep 1..4
sweep 4..1
sweep 1..2:0.1
sweep 1..0.5:-0.1
sweep 10..2:-4
sweep 1..1000*10
sweep 1..2#5
sweep 2..1#3
sweep 100cm..2m:50cm
sweep 5ft..8ft:1ft
sweep 50..200cm:50cm
sweep 1m..2m,10ft,inf
sweep 1..1.0000000001
fnumbers() {
    echo "[$*]" $(lenscalc dof -f 50mm -s 3 --csv --columns fnumber -N "$@" | tail -n +2)
}
fnumbers 1.4..22
fnumbers 1.4..22/full
fnumbers 1.4..22/half
fnumbers 1.4..22/third
fnumbers f/2.8..f/8
fnumbers 22..2.8/third
fnumbers 3.5..6.3
fnumbers 1..6:2.5
# lengths of a circle of confusion: the same as listed, in its own unit in columns across
lenscalc hyperfocal -f 50 -N 8 -c 10um..30um:10um --csv > range
lenscalc hyperfocal -f 50 -N 8 -c 0.01,0.02,0.03 --csv | cmp - range && echo same
lenscalc hyperfocal -f 50 -N 8,11 -c 10um..30um#3 --table fnumber,coc --csv
lenscalc dof -f 50 -N 2.8 -s 3m --coc 0.02..0.04:0.01 --plot x.svg
