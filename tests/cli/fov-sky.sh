# a camera on a telescope: the angle of its pixels, and the images of what is in the sky
lenscalc fov -f 1200mm --sensor "ZWO ASI2600MC Pro" --subject moon --explain
lenscalc fov -f 500,1000 --pitch 3.76um --subject jupiter,andromeda
lenscalc fov -f 1000 --subject-angle 40arcsec --sensor "ZWO ASI120MC" --csv --digits 6
lenscalc fov -f 1000 --subject jupiter --subject-angle 40arcsec --json \
    --columns subject,subject_angle_arcmin,subject_image_mm,subject_pixels
lenscalc fov --lens fisheye-16 --subject moon --pitch 4um --columns pixel_scale,subject_image
lenscalc fov -f 8mm --projection equisolid --sensor mft --subject-angle 180deg --csv --columns subject_image
lenscalc fov --pixel-scale 0.5,1,2 --sensor "ZWO ASI2600MC Pro"
lenscalc fov --pixel-scale 1arcsec
lenscalc fov --pixel-scale 1arcsec --pitch 3um -f 50
for wrong in "--subject mon" "--subject-angle 0" "--subject-angle 181deg" "--pitch 4arcsec"; do
    lenscalc fov -f 8mm --columns subject_image $wrong
    echo "status $?"
done
