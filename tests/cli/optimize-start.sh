# a lens from nothing: what is written can be taken by every other command; what cannot be is said
start() { lenscalc optimize --start "$@"; echo "status $?"; }
start elements=2,efl=100mm,fnumber=8,field=2deg --global 4 --keep 2 --rays 9 --escapes 0 \
    --relocate 1 --digits 2 --columns rank,status,goals,search,lens -o new.lens
grep -E '^(lens|wavelength|field|aperture|focus|goal)' new-1.lens
lenscalc lens new-2.lens -w d --digits 3 --columns efl
lenscalc optimize new-1.lens --digits 2 --columns status
start elements=1,efl=20,fnumber=10,image=4mm,object=100mm,stop=0 --global 2 --rays 9 --escapes 0 \
    --wavelength 632.8nm --goals poly,efl=20 --keep 1 --columns status,goals -o near.lens
grep -E '^(lens|wavelength|object|field|goal|stop)' near.lens
# words
start elements=3,efl=50,fnumber=4
start efl=50,fnumber=4,field=20
start elements=3,efl=50,fnumber=4,field=20,image=40
start elements=3,efl=50,fnumber=4,field=20deg,elements=4
start elements=3,efl=50,fnumbr=4,field=20
start elements=0,efl=50,fnumber=4,field=20
start elements=2.5,efl=50,fnumber=4,field=20
start elements=3,efl=-50,fnumber=4,field=20
start elements=3,efl=50,fnumber=0.4,field=20
start elements=3,efl=50,fnumber=4,field=80
start elements=3,efl=50,fnumber=4,field=20mm
start elements=3,efl=50,fnumber=4,image=1m
start elements=3,efl=50,fnumber=4,image=40,object=40
start elements=3,efl=50,fnumber=4,field=20,object=1m
start elements=3,efl=50,fnumber=4,field=20,stop=4
start elements=3,efl=50,fnumber=4,field=20,track=5
start elements=3,efl=50,fnumber=4,field=20,track=40,bfl=50
start ''
# beside other options
start elements=3,efl=50,fnumber=4,field=20 double-gauss
start elements=3,efl=50,fnumber=4,field=20 --vary R1
start elements=3,efl=50,fnumber=4,field=20 --field 3
start elements=3,efl=50,fnumber=4,field=20 --aperture 3
start elements=3,efl=50,fnumber=4,field=20 --global 2 --keep 3
lenscalc optimize
echo "status $?"
