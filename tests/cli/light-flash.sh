# guide numbers in metres and feet, several flashes, bounce, other light, ratios
one() {
    columns=$1
    shift
    echo "[$*]" $(lenscalc flash "$@" --csv --digits 6 --columns "$columns" | tail -n +2)
}
lenscalc flash -g 36m -s 4.5m
one fnumber,nominal_fnumber -g 118ft -s 15ft
one distance -g 36 -N 8 --iso 400
one guide_number -N 8 -s 4.5
one power -g 36 -N 8 -s 1
one iso -g 36 -N 16 -s 4.5 --power 1
one flashes -g 36 -N 16 -s 4.5 --power 1 --iso 100
one fnumber,guide_number -g 30 --second 40 -s 5
one path,power -g 43 -N 4 --ceiling 1.5m -s 3m --loss 1.5stops
one background_below_stops -g 36 -s 4.5 --background 9m
one flash,ambient,total,flash_to_ambient,balance_ratio -g 36 -N 8 -s 4.5 --power 1 --iso 100 \
    --flashes 1 --ev 12 -t 1/125
one fnumber,loss -g 36 -s 4.5 --filter ND0.9 --loss 1stops
one key_to_fill,lighting_ratio --key-to-fill 2
one key_to_fill,lighting_ratio --ratio 3:1
lenscalc flash -g 36 -N 2.8..8 --iso 100,400 --table N,iso:distance --units imperial
