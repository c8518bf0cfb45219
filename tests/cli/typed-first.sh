# questions as people type them before they look at help, and what is said where two things may be meant
. "$TESTS/try.inc"
csv() {
    try "$@" --csv --digits 5
}
# lengths of telescopes: of two the longer, of one by its size and what else is given
csv visual 2000mm --eyepiece 25mm --columns telescope,power
csv visual 8in f/6 --columns telescope,diameter
csv visual 200mm 1000mm --columns telescope,diameter,fnumber
csv visual 1000mm --aperture 200mm --exit-pupil 7mm --columns eyepiece
csv visual 650mm,2000mm --eyepiece 25mm --columns power
csv visual 11in --columns diameter,dawes
csv visual 250mm --eyepiece 10mm --columns telescope
csv visual 249mm f/5 --columns diameter
csv visual 601mm f/10 --columns telescope,diameter
try visual 250mm f/5
try visual 249mm --eyepiece 10mm
try visual 1000mm 49mm
try visual 1000mm --telescope 900mm
csv visual --telescope 20mm --eyepiece 25mm --columns power
# a pinhole is no focal length
csv pinhole 0.3mm --columns focal,diameter
csv pinhole 150mm 0.5mm --columns focal,diameter
csv pinhole 203.2mm --diameter 0.5mm --metered 1/30 f/22 --columns fnumber,time
try pinhole 0.3mm -s 1mm
try pinhole 50mm 0.3mm --diameter 0.2mm
# decimal commas, and lists of filters that are not alike
try visual 10x50 6,5deg
try microscope 40x/0,65
csv exposure --metered 1/125 --filter ND1000,2stops --columns time
csv exposure --metered 1/125 --filter ND8,ND64 --columns time
# a filter alone makes a time the metered one
csv exposure 1/60 --filter 10stops --columns metered,time_to_set
csv exposure 1/60 --filter 10stops --film "HP5 Plus" --columns time,time_to_set
csv exposure f/8 1/60 --filter 10stops --columns metered,ev100
# thin lenses, mirrors, planes
csv conjugate -f 50cm -s 30cm --columns image_distance,magnification
csv conjugate --lenses 25cm,16.5cm,25cm --object 30cm --columns image_distance,magnification
csv conjugate -f 25cm --then "gap 16.5cm, f 25cm" --object 30cm --columns image_distance,magnification
csv conjugate --lenses 10cm,0,-20cm --object 50cm --steps --columns step,image_distance
for wrong in 25cm,5cm 25cm,-1cm,25cm 0,5cm,25cm 25,5kg,3 1,; do
    try conjugate --lenses $wrong --object 30cm
done
try conjugate --lenses 25cm,5cm,25cm -f 3cm --object 30cm
try conjugate --mirror 12.2cm --object 19.7cm
csv refract --n1 1.33 --n2 1 --object 80cm --columns object,image
csv refract --n1 1.33 --n2 1 -R inf --object 80cm --columns object,image
csv refract --n1 1.33 --n2 1 --object -80cm --columns object,image
csv lensmaker --r1 20cm --r2 30cm --index 1.6 --medium 1.33 --columns focal,index_before,index_after
try lensmaker --r1 20cm --r2 30cm --index 1.6 --medium 1.33 --before 1
# bellows and closest focus
csv focus 210mm --bellows 16in --columns exposure_factor
csv focus 50mm --mfd 0.45m --tube 25mm --columns magnification
try focus 135mm --extension 6in
try exposure f/8 --bellows 16in
# by pixels, upright, by angles
csv fov -f 638px --sensor 1280x720px --columns horizontal,focal,fx
csv fov --fx 638 --pixels 1280x720 -s 2m --columns field_width,density
csv fov --fx 2857 --sensor 1/2.5in --pixels 4032x3024 --columns focal
csv fov --fx 1000 --sensor "Sony A6000" -s 1m --columns focal,fx,density
try fov -f 638px
csv fov 35mm --height 1.9m --portrait --columns distance,vertical
csv fov 24mm --portrait --pixels 6000x4000 --pitch 4um --columns sensor_width,sensor_height
csv fov --size 60m --angle 0.5deg --columns subject_distance
csv fov --size 60m --subject moon --columns subject_distance
csv fov 600mm --size 60m -s 6000m --columns subject_angle,subject_image
try fov 600mm --size 60m
try fov --size 60m --subject moon -s 10m
try fov --angle 46deg
csv fov --sensor "DJI Mini 2" -s 100m --columns gsd
try fov -f 16mm --field 100x75mm --field-diagonal 1m
csv motion --speed 0.5m/s --fov 200mm --pixels 2000 --columns time,blur_pixels
csv motion --speed 0.5m/s --fov 200mm --pixels 2000 --blur 2px --columns time
try motion 50mm -s 10m --speed 5km/h --pixels 8 --sensor "Nikon D3"
# without a focal length, an f-number
csv dof -m 1 -N 11 -c 0.015mm --columns dof,near
csv dof -m 5 -N 4 -c 0.015mm --pupil 2 --columns dof
try dof -m 1
csv tilt 150mm --height 1.2m --columns tilt,angle,near_angle,distance
try tilt 150mm --height 1.2m --wedge w.svg
csv diffraction --aperture 11in --columns rayleigh,dawes,sparrow
csv diffraction --diameter 280mm -f 2800mm --columns fnumber,rayleigh
try diffraction --diameter 280mm -N 10
csv exposure --metered 30s --film HP5 --columns time_to_set
# pixels and angles alone, powers alone, a wanted resolution, misspelt cameras
csv fov --horizontal 90deg --pixels 800x600 --columns fx,vertical,focal
try fov -f 50mm --pixels 800x600
csv microscope 10x,40x,60x --pixel 6.5um --columns objective,pixel,rayleigh
try microscope 40x --pixel 6.5um
csv microscope --resolution 0.4um --columns na,rayleigh
try microscope --resolution 0.1um
try microscope 40x
try conjugate -f 0.5m -s 1m --then "gap 2m, mirror plane"
try fov 50mm --sensor "Cannon 5D"
try lensmaker -f -20cm --index 1.55 --biconcave
try lensmaker -f 20cm --index 1.5 --in water
try refract --n1 1.5 --n2 1 --critical
try fov 800mm --pixel 3.76um --binning 2
csv panorama 50mm --overlap 30% --angle 180deg --columns arc,columns
# messages use the name that was typed; a name that may be read in two ways is said to have been
try conjugate -f 8cm --distance 75cm --columns image_distance
try conjugate -f 8cm --distance 75foo
try conjugate -f 8cm --distance 75cm --image 9cm
try motion -f 50mm -s 10m --velocity 1..2..3
try fov 50mm --sensor 1280x720px
try diffraction --aperture 8in..11in:1in --columns diameter --csv
try focus 200mm --reversed 50mm
try dof -m 0 -N 11 -c 0.015mm
# pixels over a field, an angle over a field, a field on a sensor: no lens has a part in these
csv fov --width 30ft --pixels 2048 --columns ppf
csv fov --pixels 2592 --ppf 45,60px/ft --columns density,field_width
csv fov --pixels 2592x1944 --task identify --columns field_width,field_height
csv fov --width 3m --pixels 2592x1944 --portrait --columns field_height,object_pixel
csv fov --horizontal 1.7deg --width 48ft --columns distance,solved_for
csv fov --vertical 20deg --height 2m --sensor "DJI Mini 2" --columns distance,field_height
try fov --vertical 20deg --width 2m
csv fov --sensor aps-c --width 5mm --columns magnification,focal
csv fov --horizontal 90deg --pixels 800x600 --columns ppd
csv fov 720mm --pixel 4.7um --columns scale
try fov 50mm --ppf
try lensmaker -f 20cm --index 1.5 --planoconvex=3
try motion 200mm --handheld
# a diverging eyepiece, cameras behind one, heights of images, screens of mirrors
csv visual 30cm --eyepiece -5cm --columns power,separation,exit_pupil_place,image
csv visual 20mm --telescope 250mm --eyepiece 25mm --columns exit_pupil_place
csv visual 1000mm --eyepiece 10mm --projection 100mm --columns projection_factor,photo_focal
csv visual 1000mm f/8 --eyepiece 25mm --afocal 50mm --columns photo_focal,photo_fnumber
try visual 1000mm --eyepiece -10mm --projection 100mm
try visual 1000mm --eyepiece 10mm --projection 9mm
try visual 1000mm --eyepiece 0
csv conjugate --mirror convex -f 32cm --image -19cm --image-height 7cm --columns object_height,image_height
csv conjugate -f 10cm --object 30cm --image-height 7cm --columns object_height,image_height
csv conjugate --mirror concave --object 4.2m --magnification -5.2 --from sensor --columns object_distance,radius
try conjugate --mirror concave -f 1m --object 4.2m --from sensor
# a metered and a wanted time, a flight without a camera, lenses that shorten, names of flashes
try exposure --metered 1/125 -t 30s
csv survey --gsd 3cm -t 1/500 --columns speed,focal,altitude
csv survey --gsd 3cm -t 1/500 -v 10m/s --columns motion
try survey --gsd 3cm
try focus 100mm --mfd 31cm --tube 68mm
csv focus --magnification 1 --mfd 31cm --tube 68mm --columns magnification
try flash "SB-800" f/8 --iso 200 --power 1/16
# the frames of a print
csv panorama 50mm --sensor "Canon 5D Mark II" --print 3x2m --dpi 300 --columns arc,span,shots,width_px
csv panorama 50mm --pixels 5616 --print 4x1m --columns shots
try panorama 50mm --print 3x2m
try panorama 24mm --pixels 5616 --print 9x1m
# marked without an aperture, tubes added up, a width as --fov, a flag that is a column, cameras as words
csv microscope 100x --na 1.0 -w 500nm --columns rayleigh,abbe
try microscope 100x/1.25 --na 1.0
try focus 50mm --tube 12mm+20mm+36mm
csv fov --sensor 2/3 --fov 100mm -s 300mm --columns focal
try fov --sensor 2/3 --fov 60deg -s 300mm
try dof 55mm f/22 --sensor aps-c --hyperfocal
try equivalent "iPhone 15 Pro"
