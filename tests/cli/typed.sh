# tasks as people type them: answered, or refused with a message that gives the right form
. "$TESTS/try.inc"
dof() {
    try dof -c 0.03 --csv --digits 6 "$@"
}
# f-numbers
dof -f 50 -s 3 -N ƒ/2.8 --columns near
dof -f 50 -s 3 -N 1:2.8 --columns near
dof -f 50 -s 3 -N F2.8 --columns near
dof -f 50 -s 3 -N f 2.8 --columns near
dof -f 50 -s 3 -N f/2.8..f/5.6 --columns fnumber,near
dof -f 50 -s 3 -N 1:2.8..1:5.6 --columns fnumber,near
dof -f 50 -s 3 -N 2.8, 4 --columns fnumber,near
dof -f 50 -s 3 -N f/2.8-f/8
dof -f 50 -s 3 -N 'f/2.8 to f/8'
dof -f 24-70mm -s 3 -N 4
# lengths and distances
dof -f 50 mm -N 4 -s 10 ft --columns focal,distance
dof -f 50mm -N 4 -s "5' 6 1/2\"" --columns distance
dof -f 50mm -N 4 -s 5 feet 6 inches --columns distance
dof -f 50mm -N 4 -s 1,2,3 ft --columns distance_ft
dof -f 50mm -N 4 -s ∞ --columns near
dof -f 50mm -N 4 -s infinity --columns near
dof 50mm -N 4 -s 3
dof -f 50 -N 4 3m -s
# times, exposure values, film speeds
try exposure --ev 12EV -t '30"' --columns time,fnumber --csv --digits 6
try exposure --ev 12 -t 2min30s --columns time --csv
try exposure --ev 12 -t 2 min 30 s --columns time --csv
try exposure --ev 12 -t 2:30 --columns time --csv
try exposure --ev 12 -t 1:02:30 --columns time --csv
try exposure --ev 12 -t 1/125 s --columns time --csv
try exposure --ev 12 -t 2min75s
try exposure --ev 12 -N 8 --iso 27DIN --columns iso --csv
try exposure --ev 12 -N 8 --iso 400/27° --columns iso --csv
try exposure --ev 12 -N 8 --iso 400/21°
try exposure --ev 12 -N 8 --filter 1 2/3 stops --columns time --csv --digits 6
try exposure --ev 12 -N 8 --film Tri-X 400
# filters, films, scenes as their boxes call them
loss() {
    try exposure --ev 10 -N 8 --columns time --csv --digits 6 --filter "$@"
}
loss 85B
loss CPL
loss yellow
loss 'Big Stopper'
loss 'Big Stopper+CPL'
loss K2
loss 'No. 25'
loss '#8'
loss ND1000
loss 10-stop
loss 8
loss purple
film() {
    try exposure --ev 1 -N 16 --columns time --csv --digits 6 --film "$@"
}
film hp5+
film 'Tri-X 400'
film tri-x --iso 400
film 'HP5+ 400'
film 400TX
film 'Pan F+'
film Velvia
film Kodachrome
scene() {
    try exposure -N 16 --columns time --csv --digits 6 --scene "$@"
}
scene sunny
scene 'sunny 16'
scene overcast
scene indoors
scene moonlight
scene dark
# formats and sensors
fov() {
    try fov -f 25 --columns horizontal,vertical --digits 6 --sensor "$@"
}
fov 36×24mm
fov 36x24
fov 36x24 mm
fov '1"'
fov '1/1.28"'
fov '1/1.3"'
fov '1/3.1 inch'
fov '9"'
fov 'super35 2.39:1'
fov 'super35 1.85'
fov '36x24mm 16:9'
fov 2.39:1
fov phone
fov 'medium format'
fov medium format
# a position of a zoom lens by its focal length: the nearest, named
position() {
    try lens canon-nfd-70-210 -w d --columns position,efl --csv --digits 4 --position "$@"
}
position 135mm
position 100mm
position '70 mm'
position 7cm,200mm
position 135
position 400mm
try dof --lens canon-nfd-70-210 --position 135mm -s 3 -N 4 --columns near
# the same words in sister commands
try hyperfocal -f 24mm --near 1m --columns fnumber,hyperfocal,near --csv --digits 6
try hyperfocal -N 8 --near 1m --columns focal,hyperfocal,near --csv --digits 6
try hyperfocal -f 24mm --near 1m --hyperfocal 2m
try hyperfocal -f 24mm --near 1cm
flash() {
    try flash --zoom 35mm:36m,105mm:58m -s 6m --columns guide_number,fnumber "$@"
}
flash --at 70mm
flash --at 105mm
flash --at 24mm
flash
try flash --zoom 35mm,105mm --at 70mm -s 6m
try fov -f 100mm -m 1:2 --columns distance,horizontal,field_width --csv --digits 6
try fov -f 100mm -s 45cm --from sensor --columns distance,horizontal,field_width --csv --digits 6
try fov -m 1:2 --horizontal 30
try fov -f 50 -s 10cm --from sensor
