# what cannot be fitted is said, with its reason
say() { lenscalc "$@"; echo "status $?"; }
exec 2>&1
say fit
say fit double-gauss --field 0
say fit double-gauss --field 0,100
say fit double-gauss --field 0,x
say fit fisheye-16 --field 77.95
say fit double-gauss --position wide
say fit double-gauss --glass x.csv
say fit --glass none.csv
say fit double-gauss --field 0,5 --distortion 3
say fit double-gauss --field 0,50
say fit double-gauss --rays 0
say fit double-gauss --clip --no-clip
say fit double-gauss --chromatic -o x.lens
say fit nikkor-z-14-24 --position all -o x.lens
say fit fisheye-16 --field 120
printf 'lens afocal\nfield angle 0 1\naperture epd 10\nsurface - 5 1.5 -\nsurface - 50 air -\n' > afocal.lens
say fit afocal.lens
printf 'lens bare\nfield angle 0 5\nsurface 50 5 1.5 -\nsurface -50 50 air -\n' > bare.lens
say fit bare.lens
say fit bare.lens -N 8 --columns efl_mm,rms_um
printf 'wavelength_nm,index\n500,1.5\n600,abc\n' > bad.csv
say fit --glass bad.csv
printf 'wavelength_nm,index\n500,1.5\n500,1.5\n' > twice.csv
say fit --glass twice.csv
printf 'a,b\n500,1.5\n' > other.csv
say fit --glass other.csv
printf 'wavelength_nm,index\n500,1.5\n600,1.49\n' > few.csv
say fit --glass few.csv
say fit --glass few.csv --formula cauchy --terms 7
say fit --glass few.csv --formula cauchy --terms 2 --show matrix
say fit double-gauss -o x.lens
say fit double-gauss --distortion 1.5
say fit double-gauss --rays 1 --columns efl_mm,rms_um
say fit double-gauss --distortion 0 -o /nowhere/x.lens --columns efl_mm
touch there.lens
say fit double-gauss --distortion 0 -o there.lens --columns efl_mm
printf 'wavelength_nm,index\n500,nan\n600,1.5\n700,1.4\n' > nan.csv
say fit --glass nan.csv
say fit --glass few.csv --map x.svg
# without the solver: a mistake in the question comes first
cp "$(command -v lenscalc)" lenscalc
./lenscalc fit double-gauss
echo "status $?"
./lenscalc fit double-gauss --vary R1 -o alone.lens
echo "status $?"
./lenscalc fit double-gauss --distortion 0 -o alone.lens || ls *.lens
# what goes by the name of the one with the solver: itself, another version, no program, then one
# that is handed all over
cp lenscalc lenscalc-ceres
./lenscalc fit double-gauss 2>&1 | sed 's|in /.* is|in FOLDER is|'
LENSCALC_RELAYED=0.0.9 "$(readlink -f "$(command -v lenscalc)")-ceres" fit double-gauss 2>&1 | sed 's|in /.* is version|in FOLDER is version|'
printf 'no program\n' > lenscalc-ceres && chmod +x lenscalc-ceres
./lenscalc fit double-gauss 2>&1 | sed 's|: /.*/lenscalc-ceres|: lenscalc-ceres|'
# as a loader does that lacks a library
printf '#!/bin/sh\necho libceres.so: not found >&2\nexit 127\n' > lenscalc-ceres
./lenscalc fit double-gauss 2> said
echo "status $?"
sed 's|: /.*/lenscalc-ceres|: lenscalc-ceres|' said
printf '#!/bin/sh\ntest "$1" = --version && exit\necho "$@"\ncat\nexit 3\n' > lenscalc-ceres
echo input | ./lenscalc fit double-gauss --csv -o 'a b.lens'
echo "status $?"
# as well where who started it ignores its children
echo input | env --ignore-signal=CHLD ./lenscalc fit double-gauss
echo "status $?"
printf '#!/bin/sh\nkill -9 $$\n' > lenscalc-ceres
./lenscalc fit double-gauss 2>&1 | sed 's|: /.*/lenscalc-ceres|: lenscalc-ceres|'
lenscalc fit --help > help.txt && head -n 1 help.txt
say fit double-gauss --vary R1
say fit double-gauss --prescription efl=100
say fit double-gauss --prescription efl=100,xfl=3 --vary R1
say fit double-gauss --prescription height=3 --vary R1
say fit double-gauss --prescription efl=100 --vary R1,R1
say fit double-gauss --prescription efl=100 --vary 'R1[5'
say fit double-gauss --prescription efl=100 --vary R12
say fit double-gauss --prescription efl=100 --vary n5 --columns goal,reached_mm
say fit nikkor-z-14-24 --prescription efl=15 --vary R1
say fit double-gauss --prescription efl=100 --vary 'R1[60,50]'
for part in R0 R1234567 A21_1 v1 V1 r1 c1 k1 glass2 tilt_x1 A42; do
    say fit double-gauss --prescription efl=101 --vary "$part"
done
say fit double-gauss --field 0,10:-2,14deg
say fit double-gauss --field 0,10:inf
say fit double-gauss --field 0,10mm
printf 'lens twice\nsurface 50 7.5 1.5 20 R~ R~\nsurface -50 - air 20\n' > twice.lens
say fit twice.lens --prescription efl=52
printf 'lens crossed\nsurface 50 7.5 1.5 20 R~[60,40]\nsurface -50 - air 20\n' > crossed.lens
say fit crossed.lens --prescription efl=52
printf 'lens conic\nsurface 50 7.5 1.5 20 k~\nsurface -50 - air 20\n' > conic.lens
say fit conic.lens --prescription efl=52
# rows with other columns than the first
printf 'show\nmodels\nanswer\n' | lenscalc fit double-gauss --batch - --csv --columns lens
echo "status $?"
# the solver is asked from the lens alone
lenscalc optimize double-gauss --vary R1 --goals efl=100 --global 3 --solver ceres || echo "status $?"
