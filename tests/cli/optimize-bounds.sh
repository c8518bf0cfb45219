# one number of a model glass stays within the map of glasses too: 1.695/60 and 1.52/81.78 lie on
# its crown side, 59.5 - 96.6 y + 94.4 y^2 - 315 y^3, y = nd - 1.7
cat > singlet.lens <<'EOF'
lens        Singlet
wavelength  d F C
field       angle 0 5
aperture    epd 10
focus       table
surface     50 3 1.52/60 22 stop
surface     -50 48 air 22
EOF
ask() { lenscalc optimize "$@" --csv; }
ask singlet.lens --vary n1 --goals efl=30 --show variables --digits 5 --columns variable,after,note
ask singlet.lens --vary V1,R1 --goals efl=50,axial --show variables --digits 3 \
    --columns variable,after,note
# as far as the bounds of the other let it go: 2.004/30 lies there
ask singlet.lens --vary 'n1,V1[30,80]' --goals efl=20 --show variables --digits 4 \
    --columns variable,after,note
# bounds of its own are the user's
ask singlet.lens --vary 'n1[1.3,3]' --goals efl==25 --columns status,warning --digits 4
# outside of it is no start
sed 's/1.52/1.40/' singlet.lens > water.lens
ask water.lens --vary n1 --goals efl=60
echo "status $?"
# a goal that is met has an effect nevertheless, on the answer and on a search; k2 has none
ask singlet.lens --vary R1,k2 --goals 'efl<100' --show variables --columns variable,note
ask singlet.lens --vary R1,R2,k2 --goals 'efl<100' --global 2 --columns warning
# what is infinite is said to be
sed 's/-\{0,1\}50 /- /' singlet.lens > flat.lens
lenscalc optimize flat.lens --vary c1 --goals 'efl>100' --show merit --json \
    --columns value_before,value_after
