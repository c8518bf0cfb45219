# projectors: throw, image size, lumens and brightness
lenscalc projector --throw 1.5 --screen 100in --explain
lenscalc projector --throw 1.4,2.24 -s 4m
lenscalc projector --width 3m --gain 1.3 --luminance '50 ft-L'
lenscalc projector --width 3m --gain 1.3 --illuminance 500lux --json --digits 6
lenscalc projector --screen 100in,120in,150in --lumens 2500 --csv --digits 5
lenscalc projector --lumens 1000 --luminance 16fL --columns width_ft,diagonal
lenscalc projector --throw 1.2,1.5 --screen 80,100,120 --aspect 16:10 --table screen,throw:distance
printf 'throw_ratio,diagonal_in\n1.5,100\n-2,100\n' | lenscalc projector --batch - --csv --digits 5
for words in '--throw 1.5' '--throw 1.5 -s 3m --screen 100in' '--width 3m --height 2m' \
    '--screen 100in --lumens 2500 --luminance 16fL' '--screen 100in --luminance 50 --illuminance 9' \
    '--screen 100in --lumens 2500nits' '--screen 100px' '-s 4m'; do
    lenscalc projector $words
    echo "status $?"
done
