# goals of --goals take the place of the lens's own in what is written
cat > marked.lens <<'END'
wavelength  d F C
field       angle 0 5
aperture    f/8
focus       table
goal        spot, efl == 50
goal        bfl > 40
surface     -   4     1.6204/60.3   20  stop c~
surface     -   60    air           20  c~ t~[30,80]
END
lenscalc optimize marked.lens --goals 'poly, efl == 60' -o new.lens --columns status,goals --csv
grep -e '^goal' -e '^note' new.lens
lenscalc optimize marked.lens -o own.lens --columns status,goals --csv
grep -e '^goal' -e '^note' own.lens
# an f-number that is given is no figure of the lens
lenscalc optimize marked.lens --goals 'poly, efl == 60, fnumber = 9' --columns status,warning --csv
lenscalc optimize cooke-triplet-50 --vary R1 -N 4 --goals 'efl = 50, fnumber < 5' \
    --columns status,warning --csv
lenscalc optimize double-gauss --vary R1 --goals 'fnumber = 2.1' --columns status,warning --csv
# refused: a position twice, what is no wavelength of light, or of a glass
refuse() {
    lenscalc optimize "$@" --columns status
    echo "status $?"
}
refuse itoh-zoom-100-146 --vary R1 --position wide,tele,wide
refuse double-gauss --vary R1 --goals efl@5=100
refuse double-gauss --vary R1 --goals efl@0.5=100
refuse double-gauss --vary R1 --goals efl@1e9=100
lenscalc lens double-gauss -w 99 --columns efl
echo "status $?"
lenscalc lens double-gauss -w 200 --columns efl --digits 3 --csv
