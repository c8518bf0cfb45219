# goals that are arithmetic: in --goals, in lines of the lens, across positions; and what is refused
show() {
    lenscalc optimize "$@" --show merit --columns goal,value_before,value_after,unit --digits 4
    echo "status $?"
}
show double-gauss --vary all-R --goals 'poly, length + bfl < 130 : 0.1, (R1 + R2)/(R1 - R2) = -2 : 0.1'
show double-gauss --vary all-R --goals 'poly, 1/efl = 0.01/mm : 1e-5, bfl > efl * 0.65, t6 + t7 > 2cm'
lenscalc optimize itoh-zoom-100-146 --vary all-R --goals \
    'poly, efl@wide = 99.9, efl@tele/efl@wide = 1.46 : 1e-3, bfl@wide - bfl@tele < -30' \
    --show merit --columns position,goal,value_before,value_after,unit --digits 4
printf '%s\n' 'lens Own goals' 'wavelength d F C' 'field angle 0 14' 'aperture f/6' \
    'goal poly, efl == 50' 'goal length + bfl < 52, bfl@F - bfl@C < 0.1 : 0.01' \
    'surface 22 3.3 1.6204/60.3 -' 'surface -430 6 air -' 'surface -22 1 1.62/36.4 -' \
    'surface 20 4.7 air - stop' 'surface 80 3 1.6204/60.3 -' 'surface -18.4 42 air -' > own.lens
show own.lens --vary all-R,t2,t4
sed 's/length + bfl/length + cra@5deg/' own.lens > mixed.lens
show mixed.lens --vary all-R
for goal in 'length + telecentric < 3' 'efl*bfl < 3mm' '(efl < 3' '2*poly < 3' 't1@nowhere > 2' \
    'weight + 1 < 3' 'edge - air > 0' 't1 / (t2 - t2) > 1'; do
    show double-gauss --vary all-R --goals "$goal"
done
