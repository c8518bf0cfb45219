# more tasks as people type them, of attachments, prints, drones, time-lapses and lamps
. "$TESTS/try.inc"
dof() {
    try dof --csv --digits 5 "$@"
}
# on the lens
dof -f 100mm -N 4 --close-up +2 -s 40cm --columns combined_focal,near,far
dof -f 100mm -N 4 --close-up 2D -s 40cm --columns near
dof -f 75mm -N 4 --tube 12mm --columns distance,near
dof -f 100mm -N 4 --converter 1.4 -s 4m --columns combined_focal,combined_fnumber,near
dof -f 75mm -N 2 --t-stop T2.1 -s 3m --columns near,working_t_stop
dof -f 75mm -N T2 -s 3m --squeeze 2x --columns near,horizontal_focal
dof -f 100mm -N 4 --extension 12 -s 40cm
dof -f 100mm -N 4 --teleconverter 2x -s 40m
dof -f 100mm -N 4 --diopter 2 -s 40cm
dof -f 100mm -N 4 --anamorphic 2 -s 40cm
dof -f 100mm --t-stop 2.1 -s 3m
dof -f 50mm -N 4 --tube 25mm -s 3m
try hyperfocal -f 24mm -N 8 --squeeze 1.33x --columns hyperfocal,horizontal_focal --csv --digits 5
# prints
dof -f 50 -N 8 -s 3 --print 8x10in@12in --columns coc,coc_criterion
dof -f 50 -N 8 -s 3 --print 'A2 @ 1 m' --columns coc
dof -f 50 -N 8 -s 3 --print A2@1m@20/20 --columns coc
dof -f 50 -N 8 -s 3 --print 8x10
dof -f 50 -N 8 -s 3 --paper A3
# from the air
fov() {
    try fov --csv --digits 5 "$@"
}
fov -f 8.8mm --sensor '1"' --altitude 100m --pitch 2.4um --columns gsd,ground_width
fov -f 24mm --sensor 'DJI Mavic 3' --gsd 2cm --columns altitude
fov -f 24mm --gsd 2cm
fov -f 24mm --agl 100m
# panoramas
try panorama -f 35 --portrait --rows 3 --columns rows,shots,span --csv --digits 5
try panorama -f 35 --rows 2 --span 120
# stars
try stars -f 20mm --columns rule_of_thumb,npf
try stars -f 20mm -N 1.8 --sensor 'Nikon D850' -t 15s --columns npf,star_trail,trail_pixels --csv \
    --digits 5
# time-lapses
timelapse() {
    try timelapse --csv --digits 5 "$@"
}
timelapse --event '2 hours' --clip 20s --columns interval
timelapse --event 2h30min --interval 5s --frame-rate 25 --columns shots,clip
timelapse --shots 300 --interval 2s --columns event,clip
timelapse -t 25s --event 3h --columns shots,interval
timelapse --frame-size 30MB --card 128GB --columns shots
timelapse --duration 2h --interval 5s
timelapse --event 2h --interval 5s --fps 25
timelapse --event 2h
timelapse 2h
timelapse --clip 20s --interval 5s -t 10s
# lamps
exposure() {
    try exposure --csv --digits 5 "$@"
}
exposure --kelvin 3200K --filter 80a --columns filtered
exposure --kelvin 5500 --balance 3200 --columns mired_wanted,conversion_filter
exposure --wb 5500
exposure --shutter-angle 180° --frame-rate 23.976 --mains 50Hz --columns flicker,flicker_free_angles
exposure -t 1/50 --mains 60 --columns flicker,flicker_free_time
exposure -t 1/10 --mains 60 --frame-rate 25
# brackets and flashes
try bracket --shots 5
try bracket --from 1s
try bracket --to 1/500 --step 2
try flash --gn 40 -s 5m
