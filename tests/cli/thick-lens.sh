# a thick lens among the surfaces: every command takes it for what it is
cat > two.lens <<'END'
lens        a thick lens and a plate
wavelength  d
object      inf
field       angle 0 10
aperture    stop
#           radius thickness medium  diameter
stop        -      10        air     20
thick       50     40        air     -        hiatus=-4
surface     -      5         N-BK7   -
surface     -      5         air     -
END
lenscalc lens two.lens --columns efl,bfl,front_principal,rear_principal --digits 9
lenscalc surfaces two.lens --columns surface,kind,thickness_mm,power_per_m
lenscalc matrix two.lens
lenscalc dof --lens two.lens -N 4 -s 3m --columns focal_mm,near_m,far_m
lenscalc draw two.lens -o two.svg && grep -c 'thick lens' two.svg
lenscalc convert two.lens --scale 2
lenscalc convert two.lens --unit cm
lenscalc convert two.lens --reverse -o back.lens && lenscalc lens back.lens --columns efl,front_principal,rear_principal --digits 9
lenscalc convert two.lens --to json
lenscalc convert two.lens --to seq --lossy 2>&1
echo "status $?"
lenscalc convert two.lens --to zmx 2>&1
echo "status $?"
lenscalc convert two.lens --to zmx --lossy 2>&1 | tr -d '\r'
echo "status $?"
sed 's/hiatus=-4/hiatus=-4 distortion=0.1,0,0/' two.lens > bent.lens
lenscalc convert bent.lens --reverse 2>&1
echo "status $?"
