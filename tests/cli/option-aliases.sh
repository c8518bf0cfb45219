# options by the names that other programs and the trade have for them, and names that are hints alone
. "$TESTS/try.inc"
same() {
    command=$1 ours=$2 theirs=$3
    shift 3
    first=$(lenscalc $command "$@" $ours --csv) && second=$(lenscalc $command "$@" $theirs --csv) &&
        [ "$first" = "$second" ] && echo "$command: $theirs is $ours"
}
same flash '--guide-number 58' '--gn 58' -s 10m --iso 400
same timelapse '--frame-rate 30' '--fps 30' --event 3h --clip 30s
same timelapse '--frame-size 25MB' '--file-size 25MB' --event 1h --interval 5s
same equivalent '--converter 2' '--teleconverter 2' -f 300mm -N 4
same focus '--close-up 4' '--closeup 4' -f 100mm
same focus '--tube 25mm' '--extension-tube 25mm' -f 50mm
same exposure '--time 1/60' '--shutter 1/60' --ev 12
same exposure '--iso 400' '--asa 400' --ev 12 -N 8
same dof '--aperture 8' '--f-stop 8' -f 35 -s 2
same dof '--sensor mft' '--camera mft' -f 35 -s 2 -N 4
same diffraction '--pitch 3.8um' '--pixel 3.8um' -N 5.6
same fov '--field-width 64mm' '--width 64mm' --sensor 1/3 -s 305mm
same survey '--overlap 80%' '--frontlap 80%' --gsd 2cm --sensor 'Phantom 4 Pro'
same refract '--before 1.33 --after 1' '--n1 1.33 --n2 1' -R inf --object -80cm
# what may mean something else
try exposure --metered 1/125 --nd 1000
try timelapse --interval 5s --duration 1h
try focus -f 210 --bellows 16in
try equivalent -f 25 --sensor mft --on 35mm
try tilt -f 150 --height 1.2m
# given twice, once by each name
try flash --gn 58 --guide-number 36 -s 4m
same visual '--telescope 2000mm' '--focal 2000mm' --eyepiece 25mm
# magnification and field need no diameter
try visual --telescope 2000mm --eyepiece 25mm
