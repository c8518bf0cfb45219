# goals where none is given: what a lens needs, and each left out by its name
show() {
    lenscalc optimize "$@" --show merit --columns goal,value_before,value_after --digits 3
    echo "status $?"
}
cat > flat.lens <<'EOF'
lens        Flattened
wavelength  d
field       angle 0 6 10
aperture    epd 8
focus       paraxial
stated      efl 50
surface     30 3 1.5168/64.17 20
surface     -180 40 air 20 stop
surface     -40 1 1.62/36.4 20
surface     - 5 air 20
EOF
# the flattener would go through the image
show flat.lens --vary R1,R2,c3,c4,t2
show flat.lens --vary R1,R2,c3,c4,t2 --no-goal bfl
show flat.lens --vary R1,R2,c3,c4,t2 --no-goal 'edge, air,center,efl,bfl' \
    --iterations 3
# to an image plane that varies by itself; an f-number that the stop does not fix
sed 's/focus .*/focus table/; s/50$/50\nstated fnumber 7/; s/epd 8/stop/; s/air 20 stop/air 8 stop/' \
    flat.lens > table.lens
show table.lens --vary R1,R2,c3,c4,t2,t4 --iterations 5
show table.lens --vary R1,R2,c3,c4,t2,t4 --iterations 5 --no-goal fnumber,grazing
show table.lens --vary R1,R2,c3,c4,t2,t4 --iterations 5 -N 8
# a virtual image is left where it is, one before a mirror is in front of it
printf '%s\n' 'lens Virtual' 'field angle 0 1' 'aperture epd 5' 'surface -50 2 1.5 20 stop' \
    'surface 60 -40 air 20' > virtual.lens
show virtual.lens --vary R1,R2
printf '%s\n' 'lens Mirror' 'field angle 0 1' 'aperture epd 5' 'surface -200 -100 mirror 20 stop' \
    > mirror.lens
show mirror.lens --vary k1,t1
for words in all 'edge,' '' poly,efl,bfl,center,edge,air; do
    show flat.lens --vary R1 --no-goal "$words"
done
show flat.lens --vary R1 --no-goal edge --goals efl=50
sed 's/^stated.*/goal efl = 50/' flat.lens > own.lens
show own.lens --vary R1 --no-goal air
show own.lens --vary R1 --no-goal grazing
