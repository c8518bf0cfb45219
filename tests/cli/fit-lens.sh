# the thick lens that equals a real one
lenscalc fit double-gauss
lenscalc fit double-gauss --show parameters
lenscalc fit double-gauss --show correlations
lenscalc fit double-gauss --show matrix
lenscalc fit double-gauss --chromatic --columns wavelength_nm,efl_mm,front_principal_mm,rms_um
lenscalc fit double-gauss -N 2..8 --columns fnumber,efl_mm,rms_um,rms_paraxial_um
lenscalc fit double-gauss --object 1000,inf --field 0,50 2>&1
lenscalc fit double-gauss --object 1000,2000 --field 0,50:2 --columns object_mm,efl_mm,rms_um,lost
# the angle of a near object is that seen from the first vertex: -1000 tan 3 deg
lenscalc fit double-gauss --object 1000 --field 0,3deg --columns efl_mm,rms_um
lenscalc fit double-gauss --object 1000 --field 0,-52.40777928 --columns efl_mm,rms_um
lenscalc fit double-gauss --distortion 1 --columns d1,rms_um --digits 3
lenscalc fit double-gauss -N 22,1000,100000 -w d --columns fnumber,efl_mm,rear_principal_mm,rms_um
lenscalc fit double-gauss -N 22,1000 -w d --distortion 0 --columns fnumber,efl_mm,rms_um
lenscalc fit double-gauss -N 1000 -w d --field 0,0.5,1 --columns efl_mm,front_principal_mm,rear_principal_mm,paraxial_efl_mm
lenscalc fit double-gauss --pattern square --rays 200 -w d --columns efl_mm,efl_sampling_mm,rms_um,rms_sampling_um,rays,lost
lenscalc fit nikkor-z-14-24 --position all
lenscalc fit fisheye-16
lenscalc fit fisheye-16 --no-clip --columns efl_mm,rms_um,rms_percent,rays,lost
lenscalc fit double-gauss --show models
lenscalc fit nikkor-z-14-24 --position wide,tele --show models --csv --digits 4
lenscalc fit double-gauss --match rays --columns efl_mm,rms_um,rms_pupil_um
lenscalc fit double-gauss --field 0,7 --pattern sobol --rays 200 --columns efl_mm,rms_um --digits 4
lenscalc fit fisheye-16 --field 0,20,40,60,70 --columns efl_mm,rms_um,rms_paraxial_um,largest_um,lost
lenscalc fit double-gauss -w d --show residuals --rays 2 --columns field_deg,stop_y,dy_um,distance_um
lenscalc fit double-gauss -w d --field 0,5,10 --distortion 0 -o equal.lens --columns efl_mm,rms_um
sed 's/\(\.[0-9]\{5\}\)[0-9]*/\1/g' equal.lens
# a thick lens is found again
lenscalc fit equal.lens --columns efl_mm,front_principal_mm,rear_principal_mm --digits 9
lenscalc surfaces equal.lens --columns surface,kind,thickness_mm,power_per_m
lenscalc fit double-gauss --json --digits 5 --columns efl,front_principal,rear_principal,efl_stderr,rms,rms_paraxial
lenscalc fit double-gauss --columns efl --explain
# the fitted lens in other commands
lenscalc dof --lens equal.lens -N 2.8 -s 3m --columns focal_mm,near_m,far_m
lenscalc draw equal.lens -o equal.svg && grep -c 'thick lens' equal.svg
# where in field and pupil it fails
lenscalc fit double-gauss -w d --rays 10 --map map.svg --columns efl_mm
grep '<text' map.svg | sed 's/<[^>]*>//g'
lenscalc fit double-gauss -w d --rays 10 --map map.svg --force --columns rms_um
