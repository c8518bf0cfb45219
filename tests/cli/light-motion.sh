# moving subjects, turning cameras, panning, rolling shutters
one() {
    columns=$1
    shift
    echo "[$*]" $(lenscalc motion "$@" --csv --digits 6 --columns "$columns" | tail -n +2)
}
lenscalc motion -f 50mm -s 10m -v 5km/h
one blur,blur_pixels,blur_coc,image_speed -f 100 -s 20m -v 30km/h -t 1/250 --sensor "Nikon D1"
one time -f 50 -s 10m -v 20mph --blur 2px --pitch 5um
one speed -f 50 -s 10m -t 1/500 --blur 0.01mm
one magnification,distance_m -f 50 -t 1/500 -v 2m/s
one blur -f 50 -s 10m -v 10m/s -t 1/125 --angle 30deg --height 10mm
one time -f 50 -s 10m -v 10m/s --angle 0deg
one shake,handheld,blur -f 200 -s 30m -v 1m/s -t 1/60 --rotation 1deg/s
one time,shake -f 85 --rotation 2deg/s
one handheld -f 85 --rotation 2deg/s --stabiliser 3 --sensor aps-c
one pan_rate,subject_blur,background_blur -f 200 -s 30m -v 60km/h -t 1/60 --track 0.95
one skew,skew_shift -f 50 -s 10m -v 10m/s -t 1/250 --readout 15ms

# a lens and nothing that moves: the hand-held rule alone, 1/(f x crop)
lenscalc motion 200mm --sensor 24x16mm --csv --columns focal_mm,handheld_s,time_s,coc_mm
lenscalc motion 200mm --stabiliser 3
# a pixel on the subject: do3think's example, 2000 mm/s and 0.1 mm, is 20 kHz
lenscalc motion --gsd 2cm -t 1/500 --blur 0.01mm
one line_rate,time,blur_pixels,magnification -v 2000mm/s --gsd 0.1mm
one speed --gsd 3cm -t 1/500
one time,blur --gsd 0.1mm -v 1m/s --pitch 5um --blur 2px
