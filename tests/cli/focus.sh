# conjugates, attachments, exposure factor; refusals with the legal range
lenscalc focus -f 50mm -s 3m -N 2.8
lenscalc focus -f 100mm -m 1:1 -N 8 -P 0.5 --front 30 --explain
lenscalc focus -m 1:4 --sensor-distance 0.45m --csv
lenscalc focus -f 100 --sensor-distance 0.5 --enlarged --json
lenscalc focus -f 100 -s 3.1 --from sensor --csv --columns distance_m,principal_distance_m --digits 8
lenscalc focus -f 100 -s 50cm --from entrance -P 2 --csv --columns distance_m,pupil_distance_m --digits 8
lenscalc focus -f 50 -s 45cm --from sensor --tube 12,20,36
lenscalc focus -f 100 -m 1:2 -N 4 --converter 2x --close-up 3
lenscalc focus -f 100 -s inf --tube 30 --converter 1.4 --order tube-converter,converter-tube
lenscalc focus -f 28 --reversed --image 46.5 -N 5.6 -P 1.6
lenscalc focus -f 200 --stacked 50 -N 8 --stacked-aperture 4
lenscalc focus -f 35,50,85,135 -m 1:10,1:5,1:2,1:1 --table f,m:distance
printf 'f_mm,s_m\n50,3\n50,0.04\n100,inf\n' | lenscalc focus --batch - --csv --columns image_mm,magnification,error
echo "status $?"
for words in '-f 50' '-f 50 -s 3 -m 1:2' '-f 50 -s 40mm' '-f 50 --sensor-distance 0.19' \
    '-f 100 --front 150 -m 2' '-s 1 --sensor-distance 1' '-s 2 --from sensor --sensor-distance 2' \
    '-s 2 --from entrance -m 1' '-f 100 --stacked 50 --stacked-aperture 2' '-f 100 -m -1' \
    '-f 100 --tube 5 --order tubes'; do
    lenscalc focus $words
    echo "status $?"
done
lenscalc focus -f 50 -m 1e300
echo "status $?"
