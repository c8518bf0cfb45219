# more tasks as people type them: the questions of the sister commands, of cameras, columns and times
. "$TESTS/try.inc"
dof() {
    try dof --csv --digits 5 "$@"
}
# depth of field as it is asked for
dof -f 50mm -N 2 -s 2m --t-stop T2.2 --columns fnumber,t_stop
dof -f 50mm -N 2.8 -s 2m --squeeze 2 --sensor scope --columns near,far
dof -f 50mm -N 8 --tube 25 mm --columns magnification,working_fnumber
dof -f 200mm -N 4 -s 10 m --converter 1.4x --columns combined_focal,combined_fnumber
dof -f 100mm -N 8 --close-up 3 --columns distance
dof -f 50 -N 8 -s 3 --print A2 --columns coc
dof -f 50 -N 8 -s 3 --print 16x24in --columns coc
dof -f 50 -N 8 -s 3 --sensor 'EOS R5' --coc 2px --columns near
dof -f 35 -N 8 -s 2 --columns N,near-limit,H
dof -f 35 -N 8 -s 2 --columns hyperfocal_distance,depth_of_field_ft
dof -f 35 -N 8 -s 2 --columns limit
dof -f 35 --f-stop 8 -s 2
# where things are measured, and wanted limits
try fov -f 100mm -m 1:2 --from sensor --columns distance_sensor --csv --digits 5
try hyperfocal -f 35mm --near 1.5 m --columns N --csv --digits 5
# cameras by their names
try fov -f 24 --sensor ILCE-7M4 --columns horizontal --csv --digits 5
try fov -f 24 --sensor 'ALEXA 35 4.6K 3:2' --columns horizontal --csv --digits 5
try fov -f 24 --sensor 'ALEXA 35 4.6K 4:3' --columns horizontal --csv --digits 5
try fov -f 6.9 --sensor 'iPhone 15 Pro' --columns diagonal --csv --digits 3
try fov -f 6.9 --sensor 'iPhone 12' --columns diagonal
try fov -f 24 --sensor 'EOS R55' --columns horizontal
try list cameras mirrorless nikon z8 --columns camera,width,pitch --csv
# times and filters
try exposure --metered 1/125 --filter ND1000 --columns time_to_set,timer
try exposure --metered 1/125 s --filter 10 stops --columns time_to_set
try exposure --metered 1/30 --filter 'Big Stopper' --film 'Tri-X' --columns time_to_set,timer --csv --digits 4
try exposure --metered 1/125 --nd 1000
try exposure --shutter 1/60 --ev 12
try exposure --light sunny-16 -N 8
try motion -f 50 -s 10m --subject-speed 5km/h
try exposure --ev 3 -N 8..16/full --columns fnumber,time,nominal_time
try exposure -N 8 -t 1/125 --ev 12.5 --columns iso,nominal_iso
try bracket -t 1/60 --shots 3 --columns shot,time
try bracket --shots 5
try flash -g 36 -s 4 -N 5.6 --columns power
# other trades
try panorama -f 24 --portrait --rows 3 --columns shots,rows
try timelapse --event 2h --clip 20s --columns shots,interval
try fov -f 8.8mm --sensor FC6310 --altitude 60m --columns gsd --csv --digits 4
try stars -f 20mm -N 2.8 --sensor 'NIKON D850' --columns rule_of_thumb,npf
# lists and help
try list columns flash guide --columns column,label
try lensmaker --columns '?' --columns column
lenscalc matrix --columns '?' --tsv | head -3
try dof --fnumber 8
try list cameras xyzzy
