# long: scenes: focus, exposure, motion, what is said of them, and what is refused
cat > lamps.scene <<'END'
scene Lamps
camera at=0,0,3 look=0,0,0 focus=3
material lamp black emission=1 luminance=1000
material red black emission=1,0.1,0.1 luminance=500
card size=2,2 at=0,0,0 material=red
sphere radius=0.5 at=0,0,1 material=lamp
END
sed 's/at=0,0,1/& move=1,0,0/' lamps.scene > moving.scene
small="--lens double-gauss-50 --size 48x32 --samples 8"
lenscalc render lamps.scene $small -o lamps.png
# the entrance pupil stands at 3 m, 19.97 mm behind the first vertex: 3 m - 1.5 m before it
lenscalc render lamps.scene $small --autofocus 0.5:0.5 -o lamps.pfm
lenscalc render lamps.scene $small --autofocus 0.5:0.5 --gap last -o gap.pfm 2>&1 | grep focused
lenscalc render lamps.scene $small --autofocus 0.05:0.05 -o far.pfm 2>&1 | grep focused
lenscalc render lamps.scene $small -s inf -t 1/30 --filter ND8 -o inf.pfm
lenscalc render lamps.scene --lens double-gauss-50 --size 48x32 --error 2% --samples 256 -t 1/100 -o error.pfm
lenscalc render lamps.scene $small --explain -t 1/100 -o why.pfm 2>&1 | sed 's/[0-9.]* % of/N % of/'
lenscalc render lamps.scene $small --no-skip time,secondary --explain -t 1/100 -o why.pfm 2>&1 | grep -e time: -e secondary:
lenscalc render moving.scene $small -t 1/100,1/10 -o moving.pfm --explain 2>&1 | grep -e lx -e time: -e exposures:
# the same bits by threads, in parts, of a crop, and where nothing moves also of times
lenscalc render moving.scene $small -t 1/4 -o whole.pfm
lenscalc render moving.scene $small -t 1/4 --threads 2 -o threads.pfm
for i in 1 2 3; do lenscalc render moving.scene $small -t 1/4 --part $i/3 -o $i.part; done
lenscalc merge 1.part 2.part 3.part -o merged.pfm
cmp whole.pfm threads.pfm && cmp whole.pfm merged.pfm && echo same
# a crop: rows are 48 RGB floats of 4 bytes, from below, 32 of them behind a head of 14 bytes
lenscalc render moving.scene $small -t 1/4 --crop 13:5:20x9 -o crop.pfm
for row in 18 19 20 21 22 23 24 25 26; do tail -c +$((15 + row * 576 + 13 * 12)) whole.pfm | head -c 240; done > cut
tail -c 2160 crop.pfm | cmp - cut && head -n 2 crop.pfm && echo same
lenscalc render lamps.scene $small -t 1/4 -o still.pfm
lenscalc render lamps.scene $small -t 1/4 --no-skip time,secondary -o kept.pfm
cmp still.pfm kept.pfm && echo same
sed 's/luminance=500/luminance=501/' lamps.scene > other.scene
lenscalc render lamps.scene $small --part 1/2 -o other.part
cp other.scene lamps.scene
lenscalc render lamps.scene $small --part 1/2 --resume -o other.part
# in time: at least 16 rays, and of a card the same bits as so many
lenscalc render lamps.scene --lens double-gauss-50 --size 48x32 --seconds 0 -o timed.pfm
lenscalc render chart:star --lens double-gauss-50 -s 1m --size 48x32 -t 1/100 --no-skip blur,uniform --seconds 0 -o timed.pfm
lenscalc render chart:star --lens double-gauss-50 -s 1m --size 48x32 -t 1/100 --no-skip blur,uniform --samples 16 -o counted.pfm
cmp timed.pfm counted.pfm && echo same
lenscalc render moving.scene --lens double-gauss-50 --size 48x32 --seconds 60 --samples 32 -t 1/10,1/20 -o timed.pfm 2>&1 | grep given
lenscalc render lamps.scene $small --spectral --explain -t 1/100 -o why.pfm 2>&1 | grep colour
lenscalc render lamps.scene $small --spectral --bands 16 --model thin --explain -t 1/100 -o why.pfm 2>&1 | grep colour
# refused
lenscalc render lamps.scene --lens double-gauss-50 --seconds 1 --part 1/2 -o lost.part
lenscalc render lamps.scene --lens double-gauss-50 --seconds 1 --samples 8 -o lost.pfm
lenscalc render moving.scene $small -o lost.pfm
lenscalc render moving.scene $small -t 1,2 -o lost.part
lenscalc render lamps.scene $small --luminance 5 -o lost.pfm
lenscalc render lamps.scene $small --ev 5 -o lost.pfm
lenscalc render lamps.scene $small --scene sunny-16 -o lost.pfm
lenscalc render lamps.scene $small --field-width 1m -o lost.pfm
lenscalc render lamps.scene $small --depth-map lamps.pfm -o lost.pfm
lenscalc render lamps.scene $small --spectral -w d -o lost.pfm
lenscalc render lamps.scene $small --spectral --band 20 -o lost.pfm
lenscalc render lamps.scene $small --bands 16 -o lost.pfm
lenscalc render lamps.scene $small --spectral --filter wratten-25 -o lost.pfm
lenscalc render lamps.scene $small --bounces -1 -o lost.pfm
lenscalc render lamps.scene $small -s 40mm -o lost.pfm
lenscalc render lamps.scene $small -s 30mm --gap last -o lost.pfm
lenscalc render lamps.scene $small -s 1m --autofocus 0.5:0.5 -o lost.pfm
lenscalc render lamps.scene $small --autofocus 2:2 -o lost.pfm
lenscalc render lost.scene $small -o lost.pfm
lenscalc render chart:edge $small -s 1m --bounces 1 -o lost.pfm
lenscalc render chart:edge $small -s 1m --spectral -o lost.pfm
lenscalc render chart:edge $small -s inf -o lost.pfm
lenscalc render --lens double-gauss-50 --bounces 1 --rays lost.csv
sed 's/ focus=3//' lamps.scene > unfocused.scene
lenscalc render unfocused.scene $small -o lost.pfm
lenscalc render unfocused.scene $small --focus paraxial -o unfocused.pfm 2>&1 | grep -c lx
printf 'camera at=0,0,3 look=0,0,0\nmaterial a lambert colour=0.5\nsphere radius=1 at=0,0,0 material=a\n' > dark.scene
lenscalc render dark.scene $small -s 1m -o lost.pfm
printf 'camera at=0,0,3 look=0,0,0\nmaterial a black emission=1 luminance=1\nsphere radius=1 at=0,0,9 material=a\n' > behind.scene
lenscalc render behind.scene $small -s 1m -o lost.pfm
lenscalc render behind.scene $small -s 1m -t 1 -o behind.png
printf 'camera at=0,0,3 look=0,0,0\nmaterial a black emission=1 luminance=1\nsphere radius=1mm at=0,0,3 material=a\n' > within.scene
lenscalc render within.scene $small -s 1m -o lost.pfm
# beside the axis, and a room all around, which is none
sed 's/=1mm at=0,0,3/=0.7mm at=4mm,3mm,3.001/' within.scene > beside.scene
lenscalc render beside.scene $small -s 1m -o lost.pfm
sed 's/=1mm at=0,0,3/=1m at=0,0,3/' within.scene > room.scene
lenscalc render room.scene $small -s 1m -t 1 -o room.pfm
# 19.95 mm before the camera's place stands the first vertex: 11 mm from the axis, beyond the pupil of
# f/16, there is glass from 2.13 mm (29.48 - sqrt(29.48^2 - 11^2)) to 4.48 mm behind it, before that
# air, and from 12.6 mm on nothing
for at in 11mm,0,2.98325 11mm,0,2.98105 13mm,0,2.98325 0,-11mm,2.98325; do
    sed "s/=1mm at=0,0,3/=0.3mm at=$at/" within.scene > glass.scene
    lenscalc render glass.scene --lens double-gauss-50 --size 6x4 -N 16 -s inf -t 1 -o glass.pfm 2>&1 | grep -e stands -e average
done
# what comes through it between two looks: at 2 m/s from 2 m before the first vertex, 19.95 mm before 3 m,
# after 1 s; the camera against it; a blade that turns through it 1 s before and after; past it, and not
through() {
    { printf 'camera at=0,0,3 look=0,0,0 %s\nmaterial a black emission=1 luminance=1\n' "$2"; echo "$1"; } > through.scene
    lenscalc render through.scene $small -s 3m -t 3 -o through.pfm 2>&1 | grep -v move
}
through 'card size=1,1 at=0,0,0.98 material=a move=0,0,2'
through 'card size=1,1 at=0,0,0.98 material=a' 'move=0,0,-2'
through 'box size=4,0.2,0.001 at=1.9,0,3.01 turn=0,90,0 material=a spin=90deg/s'
through 'sphere radius=0.5 at=0.54,0,0 material=a move=0,0,3'
through 'sphere radius=0.5 at=0.5,0,0 material=a move=0,0,3'
printf 'camera at=0,0,3 look=0,0,0\nmaterial a lambert texture=lost.png\nlight sky uniform luminance=1\nsphere radius=1 material=a\n' > texture.scene
lenscalc render texture.scene $small -s 1m -o lost.pfm
lenscalc render lamps.scene $small -t 1us -o faint.png 2>&1 | grep warning
lenscalc render lamps.scene $small -t 1us --noise --pitch 1um -o faint.png 2>&1 | grep electron
lenscalc render lamps.scene $small -t 100s -o bright.png 2>&1 | grep saturated
# what focus= says counts for all that is focused; a fixed plane stands for itself
lenscalc render lamps.scene $small --focus paraxial -t 1/1000 -o focused.png
grep -ao 'Object.[0-9.]* mm' focused.png | tr '\0' ' '
lenscalc render lamps.scene $small --gap last --focus-at sharpest -t 1/1000 -o focused.png
lenscalc render lamps.scene $small --from front -t 1/1000 -o focused.png
grep -ao 'Object.[0-9.]* mm' focused.png | tr '\0' ' '
lenscalc render lamps.scene $small --focus 40 -t 1/1000 -o fixed.png
grep -ac Object fixed.png
lenscalc render lamps.scene $small -s 3m --focus 40 -o lost.png
lenscalc render lamps.scene $small --autofocus 0.5:0.5 --from front -o lost.png
lenscalc render unfocused.scene $small --focus paraxial --from front -o lost.png
lenscalc render unfocused.scene $small --gap last -o lost.png
# by a gap of 5.705 mm, the least distance by closing it
lenscalc render lamps.scene $small -s 20mm --gap 5 -o lost.png
lenscalc render lamps.scene $small -s 8cm --from sensor -o lost.png
# names in capitals; scenes come from files
cp lamps.scene LAMPS.SCENE
lenscalc render LAMPS.SCENE $small -t 1/1000 -o capitals.png
lenscalc render - $small -o lost.png < lamps.scene
# nothing shines that is seen
printf 'camera at=0,0,3 look=0,0,0 focus=3\nmaterial a lambert colour=0.5\nlight sun illuminance=1 towards=0,0,1\nsphere radius=1 material=a\n' > lit.scene
lenscalc render lit.scene $small --bounces 0 -o lost.png
# light that files hold does not saturate them; what a sensor does is said once
lenscalc render lamps.scene $small -t 100 --radiance -o light.pfm
sed 's/size=2,2/size=9,9/' lamps.scene > wide.scene
lenscalc render wide.scene $small -t 100 --pitch 5um -o sensed.png
lenscalc render lamps.scene $small -t 1/100 --shutter leaf --opening-time 1ms -o leaf.png 2>&1 | grep lx
# interrupted, once: what moves is somewhere else in the next picture, which is not made
timeout --foreground -s INT 1 lenscalc render moving.scene --lens double-gauss-50 --size 480x320 --samples 4096 -t 1/100,1/10 -o stopped.png 2>&1 | grep interrupted
ls stopped*png
lenscalc render lamps.scene $small --seconds 1 -o lost.part
lenscalc render lamps.scene $small --seed 1 --part 1/2 -o seed.part
lenscalc render lamps.scene $small --part 2/2 -o other.part
lenscalc merge seed.part other.part -o lost.png
# no wider than the lens is
lenscalc render lamps.scene $small -N 0.5 -t 1/1000 -o wide.png
grep -ao 'Aperture.f/[0-9.]*' wide.png | tr '\0' ' '
lenscalc render lamps.scene $small -N 2 -t 1/1000 -o wide.png
# a lamp of 50.36/50000 x 3.6 x 2.4 m on the film: 1.5 % of its pixels, pi L/(4 N^2) = 12.3 lx
# where white takes 0.78/sqrt(2) lx s; and one on less than 1 %, of which nothing is said
for size in 3.6,2.4 1.6,1; do
    printf 'camera at=0,0,0 look=0,0,-1 focus=inf\nmaterial lamp black emission=1 luminance=1000\ncard size=%s at=0.9,0.6,-50 material=lamp\n' $size > lamp.scene
    for file in lamp.png lamp.pfm; do
        lenscalc render lamp.scene --lens double-gauss-50 --size 40x20 --sensor 36x18mm -N 8 --samples 64 -t 1 -o $file
    done
done
ls lost.*
# 52 mm behind a lens of 52 mm lies its stop: the entrance pupil is infinitely far away, or by the
# last digits 10^12 km, and the camera's place the first vertex
printf 'lens telecentric\nwavelength d\naperture stop\nsurface 26 4 1.5/60 -\nsurface - 49.333333333333333 air -\nstop - 20 air 6\nsurface 20 4 1.5/60 -\nsurface -20 20 air -\n' > tele.lens
printf 'camera at=0,0,0 look=0,0,-1\nmaterial a black emission=1 luminance=1000\ncard size=20,20 at=0,0,-5 material=a\n' > wall.scene
printf 'camera at=0,0,0 look=0,0,-1\nmaterial a black emission=1 luminance=1000\nsphere radius=0.3mm at=0,0,2mm material=a\n' > glass.scene
for scene in wall glass; do
    lenscalc render $scene.scene --lens ./tele.lens --size 12x8 --sensor 6x4mm --samples 4 -t 1 --focus 20 -o lost.d.pfm 2>&1 | grep -e average -e stands
done
