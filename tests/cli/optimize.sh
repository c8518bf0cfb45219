# paraxial goals; what is written is found again; what is refused
cat > achromat.lens <<'END'
lens        Achromat from plates
wavelength  d F C
object      inf
field       angle 0 1
aperture    epd 20
focus       table
surface     -   6   1.5168/64.17  22  stop
surface     -   3   1.6727/32.21  22
surface     -   100 air           22
END
lenscalc optimize achromat.lens --vary c1,c2,c3 --goals 'efl==100,axial==0,S1=0' -o new.lens \
    --columns status
# one focal length in d, the same focus in F and C
lenscalc lens new.lens -w d --columns efl --digits 12 --csv
lenscalc lens new.lens --columns wavelength,bfl --digits 6 --csv
lenscalc optimize new.lens --vary c1,c2,c3 --goals 'efl==100,axial==0,S1=0' -o new.lens
echo "status $?"
# at a bound; what nothing depends on
lenscalc optimize double-gauss --vary 'R1[50,60],R11,t11' --goals efl=95,bfl=72 --show variables \
    --digits 5
lenscalc optimize double-gauss --vary 'R1[50,60],R11,t11' --goals efl=95,bfl=72 --show merit \
    --digits 4 --columns goal,value_before,value_after
# the image plane is the paraxial one: nothing depends on the last thickness
lenscalc optimize double-gauss --vary R1..R11,t11 --hold R3 -N 4 --goals spot,efl=100 --digits 3 \
    --columns fnumber,merit_before,merit_after,status
# a bound that the start violates, a contradiction, other refusals
for question in "--vary R1[60,70] --goals efl=95" "--vary R1 --goals efl==100,efl==90" \
    "--goals efl=95" "--vary R1 --goals spott" "--vary R1 --goals efl=nan" \
    "--vary R1,R1 --goals efl=95" "--vary R99 --goals efl=95" "--vary R1[5 --goals efl=95" \
    "--vary R1 --goals efl=95 --seed 3" "--vary R1[3,2] --goals efl=95"
do
    lenscalc optimize double-gauss $question --columns status
    echo "status $?"
done
# marks and goals of the file; what is wrong with them has a place
cat > marked.lens <<'END'
lens        Triplet with marks
wavelength  d F C
field       angle 0 10 14
aperture    epd 12
focus       table
goal        poly, efl == 50
surface     -   4     1.6204/60.3   20  c~
surface     -   6     air           20  c~
surface     -   1.5   1.6200/36.4   14  c~
surface     -   0.5   air           14  c~
stop        -   5.5   air           12
surface     -   4     1.6204/60.3   18  c~
surface     -   42    air           18  c~ t~[30,44]
END
lenscalc optimize marked.lens --digits 3 --show merit --columns goal,value_after
lenscalc optimize marked.lens --digits 4 --show variables --columns variable,low,high,note \
    --hold c2
sed 's/efl ==/elf ==/' marked.lens > wrong.lens
lenscalc optimize wrong.lens
echo "status $?"
# a goal of a position that is left out is said not to count
lenscalc optimize itoh-zoom-100-146 --vary R1 --position tele --goals efl@wide=100,efl@tele=146 \
    --columns status,goals
# rays that are just lost: a lens is found that has a value
cat > edge.lens << 'END'
lens        rays at an edge
position    wide tele
let d2 5 15
let d4 20 5
wavelength  d
field       angle 0 3
aperture    epd 8
focus       table
goal        efl@wide = 60, efl@tele = 75, spot
pickup      R5 = -R6
surface     80 3 1.6/50 30
surface     -80 d2 air 30
surface     -60 2 1.5/64 20
surface     60 d4 air 20
surface     40 4 1.6/50 20
surface     -40 50 air 20
stop        - 30 air 12
END
lenscalc optimize edge.lens --vary R2 --digits 3 --columns merit_after,status
# a stop does not move into glass
lenscalc optimize itoh-zoom-100-146 --vary all-R,all-t --iterations 20 --show variables --csv |
    sed -n '1p;/^t9/p' | cut -d, -f1,4-6
# small spots alone are had of another focal length: it is said
lenscalc optimize double-gauss --vary all-R --goals poly --digits 3 --columns warning --csv |
    sed 's/and is .*/and is another/'
# a lens that was written on its bound begins there; a field of no weight counts for nothing
cat > singlet.lens << 'END'
wavelength  d F
object      200
field       height 0 10
aperture    epd 10
focus       paraxial
surface     50 3 SCHOTT:N-BK7 22 stop
surface     -50 40 air 22
END
lenscalc optimize singlet.lens --vary 'c1[0.01,0.03]' --goals efl=10 -o bound.lens > bound.txt
lenscalc optimize bound.lens --vary 'c1[0.01,0.03]' --goals efl=10 --show variables --csv --digits 6
lenscalc optimize singlet.lens --vary R1 --goals poly,efl=49 --field 0:1,10:0 --digits 3 \
    --columns merit_after,status
# sheets of a sweep tell its rows apart; positions that are left out set no usual goals
lenscalc optimize singlet.lens --vary R1 --goals poly,efl=49 -N 8,16 --show merit --csv \
    --columns goal,unit
lenscalc optimize itoh-zoom-100-146 --vary R1 --position tele --columns goals --csv
