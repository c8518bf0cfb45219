# distortion: fields, projections, near objects, models and their files, drawings, refusals
lenscalc distortion double-gauss
lenscalc distortion double-gauss --field 0..14#3 -w d,F --csv --digits 9 --columns field,wavelength,ideal_height,image_height,distortion
lenscalc distortion double-gauss --field 10 --field-x -10 --csv --digits 9 --columns image_height,image_x,image_y,angle,distortion
lenscalc distortion double-gauss --height 20 --real --defocus 0.5 --csv --digits 9 --columns field,angle,image_height,distortion,image
lenscalc distortion double-gauss --object 1500 --height 20 --csv --digits 9 --columns object_height,image_height,distortion,magnification
lenscalc distortion fisheye-16 --field 60 --projection equidistant,equisolid,stereographic,orthographic --csv --digits 7 --columns projection,distortion
lenscalc distortion fisheye-16 --field 60 --projection equidistant --calibrated
lenscalc distortion double-gauss --field 14 --explain
lenscalc distortion wide-35 --fit ptlens
lenscalc distortion wide-35 --fit brown,poly5 --csv --digits 5
lenscalc distortion double-gauss --fit opencv --calibrated --sensor 36x24mm --pitch 5um --json --digits 5 | tail -2
lenscalc distortion phone-80deg --fit opencv --csv --digits 4 --columns direction,k1,k2,k3,radius,warning
lenscalc distortion canon-nfd-70-210 --fit ptlens --position all -o zoom.xml --csv --digits 4 --columns position,direction,a,b,c,focal
sed 's/"\(-*0*\.0*[0-9]\{4\}\)[0-9e-]*"/"\1"/g' zoom.xml
lenscalc distortion fisheye-16 --fit fisheye -o camera.yml --csv --digits 4 --columns k1,k2,k3,k4,rms_pixels
grep -v data: camera.yml | grep -v '^ *[-0-9]'
lenscalc distortion fisheye-16 --fit fisheye -o camera.yml
lenscalc distortion double-gauss --grid grid.svg --plot plot.svg --csv --columns field
for drawing in grid.svg plot.svg; do
    python3 - $drawing <<'END'
import sys, xml.etree.ElementTree as tree
root = tree.parse(sys.argv[1]).getroot()
print(sys.argv[1], *(e.text for e in root.iter() if e.tag.endswith("text")), sep="\n    ")
END
done
# what cannot be
lenscalc distortion double-gauss --field 0,10,80 --csv --digits 5 --columns field,distortion
lenscalc distortion double-gauss --field 80
lenscalc distortion fisheye-16 --field 95
lenscalc distortion fisheye-16 --field 95 --projection rectilinear
lenscalc distortion fisheye-16 --field 95 --projection orthographic
lenscalc distortion double-gauss --object 1500 --projection equidistant --height 5
printf 'lens telescope\nobject inf\nfield angle 1\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n' |
    lenscalc distortion -
printf 'lens no stop\nobject inf\nfield angle 1\nsurface 50 5 1.5 -\nsurface - 0 air -\n' |
    lenscalc distortion -
lenscalc convert edmund-49-847 | sed "/^field/d" | lenscalc distortion - --calibrated
lenscalc distortion edmund-49-847 --grid grid.svg --field 0
lenscalc distortion double-gauss --fit opencv --field 3
lenscalc distortion double-gauss --fit opencv --projection equidistant
lenscalc distortion double-gauss --sensor 36x24mm
lenscalc distortion double-gauss --pitch 4um
lenscalc distortion double-gauss -o x.xml
lenscalc distortion double-gauss --fit brown -o x.xml
lenscalc distortion double-gauss --fit poly3 -o x.yml
lenscalc distortion double-gauss --fit opencv -o x.xml
lenscalc distortion double-gauss --fit opencv -o x.lens
lenscalc distortion canon-nfd-70-210 --fit opencv --position all -o x.yaml
lenscalc distortion canon-nfd-70-210 --position all --grid x.svg
lenscalc distortion fisheye-270 --fit poly3
lenscalc distortion phone-80deg --fit ptlens
lenscalc distortion laikin108-wide100 --fit poly5 --csv --digits 4 --columns k1,k2,radius,warning
lenscalc distortion schneider-anamorphic-31 --fit opencv
lenscalc distortion double-gauss --fit opencv --pitch 30mm
lenscalc distortion double-gauss --projection flat
ls
lenscalc distortion canon-retrofocus-14 --sensor 30x20mm --fit opencv-rational --csv --digits 2 --columns direction,max_pixels
# TV distortion of a picture
lenscalc distortion double-gauss --aspect 3:2 --columns field,distortion,tv_smia,tv
lenscalc distortion fisheye-16 --field 40,60deg --aspect 1,1.5 --projection equidistant --json --digits 4 --columns field,aspect,tv_smia,tv
lenscalc distortion double-gauss --aspect 0
lenscalc distortion double-gauss --aspect 3:2 --fit brown
# a fisheye is compared with its own projection, a wide rectilinear lens with that
for lens in fisheye-16 minolta-fisheye-1 canon-retrofocus-14 double-gauss; do
    lenscalc distortion $lens --csv --digits 3 --columns field,distortion,projection 2>/dev/null | tail -1
done
lenscalc distortion fisheye-16 --projection rectilinear --csv --digits 3 --columns field,distortion,projection | tail -1
lenscalc distortion fisheye-16 --field 52.29deg --aspect 3:2 --projection rectilinear --csv --digits 4 --columns tv_smia
lenscalc distortion fisheye-16 --aspect 3:2
