# microscopes: objective and eyepiece, cameras, immersion, other tube lenses
lenscalc microscope 40x/0.65 --eyepiece 10x/22 --tube-lens 180mm
lenscalc microscope 4x/0.1,10x/0.25,40x/0.65,100x/1.25 --eyepiece 10x/22
lenscalc microscope 20x/0.5 --pitch 3.45um --sensor 2/3in --explain
lenscalc microscope 20x/0.75 --condenser 0.5 --columns abbe,rayleigh --explain
lenscalc microscope 100x/1.25 oil --eyepiece 10x --field-number 20 --json
lenscalc microscope Plan Apo 60x/1.2 water --csv --digits 5
lenscalc microscope --na 1.4 -m 60 --index 1.518 --pitch 6.5um -w 520nm --columns pixel,sampling,depth_camera
lenscalc microscope --objective 20x/0.42 --tube-lens 180 --marked-for 200 --columns magnification,focal
lenscalc microscope 10x/0.3 --sensor "Nikon D850" --adapter 0.5x --columns field_width,pixel
lenscalc microscope 10x/0.25 --eyepiece 40x/20 --columns power
for wrong in "" "40x" "40/0.65" "40x/0.65 lard" "40x/0.65 10x/22" "--na 1.4 --immersion air" "--na 0" \
    "40x/0.65 --na 0.7" "40x/0.65 --field-number 22" "40x/0.65 --adapter 2" "40x/0.65 --pitch 3mm" \
    "100x/1.25 oil --immersion water" "100x/1.25 lard --index 1.5" "100x/1.25 lard --immersion oil"; do
    lenscalc microscope $wrong --columns rayleigh
    echo "status $?"
done
