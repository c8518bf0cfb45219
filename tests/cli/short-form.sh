# Values that show by their notation what they are stand without their options.
show() {
    echo "$*"
    lenscalc "$@" 2>&1
}
show dof 50mm f/2.8 3m --csv --columns focal,fnumber,distance
show dof f/2.8 50 mm 5 ft 6 in --csv --columns focal,fnumber,distance
show dof 24mm,50mm f/4..f/5.6/third inf --csv --columns focal,fnumber,distance
show dof 26mm-eq f2 2m --sensor aps-c --csv --columns focal,distance
show dof 50mm -N 2.8 3m --csv --columns focal,fnumber,distance
# where the lens is known one length is the distance
show dof -f 50mm f/2.8 3m --csv --columns focal,fnumber,distance
show dof --lens double-gauss f/4 3m --csv --columns lens_focal,fnumber,distance
show fov 24mm --csv --columns focal,distance
show fov 24mm 3m --csv --columns focal,distance
show exposure f/8 1/125 iso400 --csv --columns fnumber,time,iso
show flash f/4 5m ISO200 --csv --columns fnumber,distance,iso
# what is too much, doubled or bare is refused
show dof 50mm f/2.8 3m 5m
show dof 50mm f/2.8 f/4 3m
show dof -f 50mm f/2.8 3m 2m
show dof 50mm f/2.8 3m -s 2m
show dof 50 2.8 3
show fov 24mm f/2.8
show spot double-gauss 3m f/4
# of a command with operands of its own a focal length alone
show conjugate 10cm --object 30cm --value image_distance_mm
show conjugate 10 cm -15cm --object 30cm
show convert double-gauss 50mm -o scaled.lens
lenscalc lens scaled.lens -w d --value efl_mm --digits 6
show visual 8in f/6
show survey 'Mavic 3' 35mm --altitude 100m
