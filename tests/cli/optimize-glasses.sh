# model glasses end as glasses of catalogues
cat > plates.lens <<'END'
lens        Achromat from plates
wavelength  d F C
field       angle 0 1
aperture    epd 20
focus       table
goal        efl == 100, axial == 0, poly
surface     -   6   1.52/60  22  stop c~ glass~
surface     -   3   1.65/35  22  c~ glass~
surface     -   96  air      22  c~ t~
END
lenscalc optimize plates.lens --glasses N-BK7,N-SF5 --digits 4 -o found.lens \
    --columns merit_before,merit_after,status
grep -v '^goal' found.lens | sed 's/\(surface *[-0-9.]\{8\}\)[0-9]*/\1/; s/ \(95\.[0-9][0-9]\)[0-9]*/ \1/'
lenscalc optimize plates.lens --glasses schott:n-bk7,N-SF5,N-BK7 --show glasses --csv --digits 4
lenscalc optimize plates.lens --glasses N-BK7,N-SF5 --show variables --csv --digits 4 \
    --columns variable,after,note
lenscalc optimize plates.lens --glasses N-BK7,N-SF5 --show merit --csv --digits 4 \
    --columns goal,value_after
# a marked one in the flint's place follows the crown; bounds hold for what takes a model's place
cat > follows.lens <<'END'
wavelength  d F C
field       angle 0
aperture    epd 10
focus       table
pickup      glass4 = glass1
surface     60   4   1.52/60  22  stop
surface     -60  1   air      22
surface     -50  2   1.65/35  22
surface     -    4   1.52/60  22
surface     -80  90  air      22
END
lenscalc optimize follows.lens --vary R1,R3,glass1 --goals efl=100,axial --glasses N-BK7,N-LAK8 \
    -o follows-found.lens --columns status
grep '^surface' follows-found.lens | awk '{ print $4 }'
lenscalc optimize follows.lens --vary 'R1,R3,n1[1.5,1.56],V1' --goals efl=100,axial --csv \
    --glasses N-LAK8,N-BK7,N-BAK1,SCHOTT:LF5 --show glasses --columns surface,glass,nd,vd --digits 5
lenscalc optimize follows.lens --vary 'R1,R3,n1[1.519,1.521],V1' --goals efl=100,axial --csv \
    --glasses N-LAK8,N-BK7
echo "status $?"
sed 's/glass4 = glass1/n4 = n1/' follows.lens > number.lens
lenscalc optimize number.lens --vary R1,R3,glass1 --goals efl=100,axial --glasses N-BK7
echo "status $?"
# a lens whose glass lies on the border of the map begins there
lenscalc optimize plates.lens -o border.lens > border.txt
lenscalc optimize border.lens --columns merit_before,status --digits 3
# what is refused
refuse() {
    lenscalc optimize "$@" --columns status
    echo "status $?"
}
refuse plates.lens --glasses SCHOT
refuse plates.lens --glasses N-BK77
refuse plates.lens --glasses N-BK7,,N-SF5
refuse plates.lens --glasses F2
refuse plates.lens --glasses SCHOTT:N-BK7,MISC:GERMANIUM
refuse plates.lens --glasses SCHOTT,N-SF5 -w d,3um
refuse plates.lens --glasses OHARA -w d,12um
refuse plates.lens --glasses N-BK7 --hold glass1,glass2
lenscalc optimize plates.lens --show glasses
echo "status $?"
refuse plates.lens --threads 2
mkdir -p own/glass
printf 'name\tformula\tcoefficients\tstatus\nLOST\tconstant\t1.5\tobsolete\n' > own/glass/EMPTY.tsv
refuse plates.lens --glasses EMPTY --lensdb own
# no time for the glasses
refuse follows.lens --vary R1,R3,glass1,glass3 --goals efl=100,axial --glasses N-BK7 --seconds 1e-6
# glasses alone vary: once they are real nothing is left to vary
lenscalc optimize double-gauss --vary glass1,glass10 --goals poly --glasses N-SK2,N-LAK9,N-LAF34 --rays 12 --show glasses --columns surface,glass --csv
