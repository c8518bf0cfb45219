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
