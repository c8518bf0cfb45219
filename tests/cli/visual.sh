# telescopes and binoculars before an eye
lenscalc visual --telescope 1200mm --diameter 200mm --eyepiece 25mm --barlow 2x
lenscalc visual --telescope 1200 -N 6 --eyepiece 24 --apparent-field 68deg --field-stop 27mm --explain
lenscalc visual 10x42 --field 6.5deg
lenscalc visual 8x42 330 ft at 1000 yd --units imperial --eye-pupil 3mm
lenscalc visual 8x42,10x42,7x50 --csv --columns binoculars,exit_pupil_mm,twilight_factor,relative_brightness
lenscalc visual Nikon 8x42 7.0deg --value apparent_field --digits 4
lenscalc visual 8x42 8.8 --json --columns true_field_deg,apparent_field_deg
lenscalc visual 7x50 --apparent-field 50deg --columns true_field,true_field_ratio
lenscalc visual --telescope 1200 --diameter 200 --eyepiece 32,25,10,5 --apparent-field 52deg
lenscalc visual --telescope 2032 -N 10 --obstruction 34% --exit-pupil 2mm --csv --digits 5
lenscalc visual --diameter 203 --secondary 70mm --columns light_gain,limiting_magnitude
lenscalc visual --telescope 1000 --diameter 100 --lens erfle-eyepiece
lenscalc visual --telescope 1000 --diameter 100 --eyepiece 25mm,erfle-eyepiece,5..10:5
printf 'eyepiece\n25mm\nerfle-eyepiece\nnone.lens\n' | lenscalc visual -f 1000 --diameter 100 --batch - --csv --columns power,eye_relief_mm --digits 6
lenscalc visual --telescope 1000 --diameter 100 --lens erfle-eyepiece --barlow 2 --columns power,eye_relief
lenscalc visual --diameter 150 --back-focus 55mm --filter-thickness 2mm,3mm --columns filter_thickness,back_focus_filtered
lenscalc visual -f 2032 --diameter 8in --eyepiece 25 --reducer 0.63x --columns power,true_field,combined_focal
lenscalc telescope -f 1200
# what is printed is read
lenscalc visual -f 1200 --diameter 200 --eyepiece 25,10 --apparent-field 52 --csv --digits 6 > rows.csv
lenscalc visual --batch rows.csv --csv --digits 4 --columns telescope_mm,eyepiece_mm,power,true_field_deg,limiting_magnitude
for field in "--field 5deg" "--field-width 120m" "--field 6.3deg"; do
    lenscalc visual "8x42 330ft/1000yd" $field --columns true_field
done
for wrong in "" "10" "10x42 --at 500m" "400mm f/5" "1000mm 25mm" "200mm --eyepiece 10mm" "10x50 6,5deg" "10x42 6.5kg" "8x42 330ft" "8x42 330ft/3s" "8x42 --field 330ft" \
    "--telescope 1200 --diameter 200 --eyepiece own.lens" "--telescope 1200 --diameter 200 -N 5" \
    "--telescope 1200 --diameter 200 --eyepiece 25 --power 20" "10x42 --telescope 900" \
    "7x50 --obstruction 80% --diameter 50" "--diameter 200 --obstruction 99% --power 10" \
    "--telescope 1200 --diameter 200 --eyepiece 25 --barlow 0" "--diameter 0" "10x42 --field 180"; do
    lenscalc visual $wrong --columns power
    echo "status $?"
done
