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
# the focal length in pixels, f'/(p q): 4/0.0014 = 2857.14, and 50/(0.004 2) = 6250
lenscalc fov 4mm --pixel 1.4um --columns fx --explain
lenscalc fov -f 50mm --pitch 4um --squeeze 2 --csv --columns fx --digits 6
lenscalc fov -f 50mm -m 1 --pitch 4um --csv --columns fx --digits 6
lenscalc fov -f 4mm --columns fx
