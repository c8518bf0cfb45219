# the time to set behind a filter, from one metered without it: t x 2^stops, then as the film needs
try() {
    lenscalc exposure "$@" || echo "status $?"
}
try --metered 1/125 --filter ND1000                       # 8 s
try --metered 1/125 --filter 10stops --columns time_to_set,nominal_time,timer --csv
try --metered 1/4 --filter 10stops --film "HP5 Plus"      # 256^1.31 = 1428.2 s
try --metered 1/4 --filter 10stops --film "HP5 Plus" --columns time,corrected_time,time_to_set,timer --csv --digits 5
try --metered 1/4,1/60,1 --filter 10stops,6stops --table metered,filter:time_to_set
try --metered 1/250 --filter ND8+CPL -N 8 --iso 100 --columns ev100,time,time_to_set --csv --digits 6
try --metered 1/60 --compensation 1 --filter 3stops --columns time_to_set --csv --digits 6
# refused
try --metered 1/125 --ev 8 --filter ND8
try --metered 1/125 -t 1/60 --filter ND8
try --metered 1/125 --equivalent
try --metered 1/125 --filter 100stops --film "Velvia 50"
# the nearest speed where the speed is solved for: ISO 195.3, 0.034 stops below 200
try -N 8 -t 1/125 --ev 12 --columns iso,nominal_iso,residual --csv --digits 6
# a time of 15 s is never written 15
try --ev 2 -N 4..16/full -t 15 --columns fnumber,time,iso
try --ev 9 -t 1/4,15,2min30s,2h --iso 100,200 --table t,iso:fnumber
lenscalc flash -g 36 -s 3 -N 8 --power 1/16 --columns power,distance
lenscalc flash -g 36 -s 3 -N 8 --iso 100 --columns power
