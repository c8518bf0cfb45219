# what cannot be optimised, or ends otherwise than it was meant, is said where it stands
cat > singlet.lens <<'EOF'
lens        Singlet
wavelength  d F C
field       angle 0 5
aperture    epd 10
focus       table
surface     50 3 SCHOTT:N-BK7 22 stop
surface     -50 48 air 22
EOF
ask() {
    lenscalc optimize "$@" --columns status,warning --csv
    echo "status $?"
}
# nothing varies; nothing is left of it
ask singlet.lens --goals efl=50
ask singlet.lens --vary '' --goals efl=50
ask singlet.lens --vary R1,t2 --hold t2,R1 --goals efl=50
# bounds that contradict each other, or leave one value; bounds that the start violates
ask singlet.lens --vary 't1[5,4]' --goals efl=50
ask singlet.lens --vary 't1[3,3]' --goals efl=50
ask singlet.lens --vary 'R1[60,70]' --goals efl=50
for mark in 't~[4,3]' 'k~[0,0]' 't~[60,70]'; do
    sed "s/48 air 22/48 air 22 $mark/" singlet.lens > marked.lens
    ask marked.lens --goals efl=50
done
# targets that are no numbers, deviations of nothing
for goal in efl=nan efl=inf efl=50:0; do
    ask singlet.lens --vary R1 --goals $goal
    sed "\$a goal $goal" singlet.lens > wanted.lens
    ask wanted.lens --vary R1
done
sed '$a goal edge > 1, spot = 3' singlet.lens > wanted.lens
ask wanted.lens --vary R1
# targets out of reach, and such as contradict each other
ask singlet.lens --vary 'R1[40,60]' --goals efl=5000
ask singlet.lens --vary R1,R2 --goals 'efl>50,efl<40'
ask singlet.lens --vary 'R1[40,60]' --goals efl==500
# a pick-up of itself, in a circle, and a number that follows another
for pickups in 'R2 = -R2' 'R1 = -R2\npickup R2 = -R1' 'R2 = -R1'; do
    sed "s/^focus.*/&\npickup $pickups/" singlet.lens > picked.lens
    ask picked.lens --vary R2 --goals efl=60
done
# what nothing depends on stays; a lens that cannot be made is told of
lenscalc optimize singlet.lens --vary R1,k1,t2 --goals efl=60 --show variables --csv --digits 6
ask singlet.lens --vary t1 --goals center==-1,efl=50:100
ask singlet.lens --vary R1,R2 --goals efl=14:0.01
# rays that are lost at the start and that nothing brings back; no time to do so
ask singlet.lens --vary t2 --goals poly -N 0.4
ask singlet.lens --vary R1,R2,t2 --goals poly,efl=50 -N 0.8 --seconds 1e-9
# plates whose goals are partly of a position that is left out: the others begin
cat > zoom.lens <<'EOF'
lens        Zoom of plates
position    wide tele
let d2 5 15
wavelength  d
field       angle 0 3
aperture    f/4
focus       table
goal        efl@wide = 60, efl@tele = 75, poly
surface     - 3 1.6/50 30 stop
surface     - d2 air 30
surface     - 2 1.5/64 20
surface     - 60 air 20
EOF
ask zoom.lens --vary c1,c2,c3,c4 --position tele
# wavelengths and fields that no goal is of
lenscalc optimize singlet.lens --vary R1 --goals efl=50 -w 400
lenscalc optimize singlet.lens --vary R1 --goals efl=50,spot@550nm -w 400
lenscalc optimize singlet.lens --vary R1 --goals efl=50,spot@5deg --field 3deg
