# thin lenses and mirrors by their numbers: what is found, what is refused
lenscalc conjugate -f -15cm --object 10cm --height 3cm
lenscalc conjugate --object 5cm --image 12cm --csv
lenscalc conjugate --object 10cm -m 3 --json
lenscalc conjugate -f 8cm --then "gap 14cm, f -9.5cm" --object 12cm --height 1cm --steps
lenscalc conjugate -f 8cm --then "gap=14cm, power=-10dpt, f 20cm" --object 12cm --columns efl,image_distance
lenscalc conjugate -f 31.5cm --object 156cm --from sensor
lenscalc conjugate --object 5m --from sensor -m -100
lenscalc conjugate --power 5 --object 1m,20cm,10cm,inf,-10cm --explain
lenscalc conjugate -f 10cm --image -25cm --explain
lenscalc conjugate -f 10cm --object 0 --from focal
for mirror in "concave -R 30cm" "convex -R 30cm" "convex -f 15cm" "convex -f -15cm" plane; do
    lenscalc conjugate --mirror $mirror --object 20cm --columns focal,image_distance,image_kind,magnification,total --csv
done
lenscalc conjugate --mirror concave --object 30cm --image -20cm --columns focal,radius
lenscalc conjugate -f 10cm --object 20cm --object-medium water --columns image_distance --csv
printf 'f_cm,object_cm\n10,15\n-10,15\n10,10\n0,5\n' | lenscalc conjugate --batch - --csv 2>&1
printf 'object_cm,image_cm\n10,15\n10,\n' | lenscalc conjugate --batch - --csv 2>&1
lenscalc conjugate -f 10cm,20cm --object 5cm,15cm --table f,object:image_distance
lenscalc conjugate -f 10cm --object 5cm..50cm:5cm --plot curve.svg > /dev/null && grep -c '<svg' curve.svg
refused() {
    lenscalc conjugate "$@" 2>&1
    echo "status $?"
}
refused --object 10cm
refused --mirror concave --object 10cm
refused --object 10cm --image 10cm -m 2
refused --object 10cm --image -10cm
refused --mirror concave --object 30cm -m 0.013
refused --mirror concave -f -15cm --object 30cm
refused --mirror concave -R -30cm --object 30cm
refused --mirror plane -f 15cm --object 30cm
refused --mirror convex -R 30cm --object 30cm --image-medium water
refused --mirror convex -R 30cm --object 30cm --from focal
refused -f 10cm -R 20cm --object 30cm
refused -f 10cm --power 10 --object 30cm
refused -f 0 --object 30cm
refused -f 5D --object 30cm
refused -f inf --object 30cm
refused --then "gap 14cm, f -9.5cm" --object 12cm --image 5cm
for then in "14cm, -9.5cm" "gap 14cm" "gap 14cm, gap 2cm, f 5cm" "gap -1cm, f 5cm" "f 0" "lens 5cm" "gap 5kg, f 2"; do
    refused -f 8cm --then "$then" --object 12cm
done
refused -f 8cm --steps --object 12cm
refused -f 8cm --object 12cm -N 4
refused -f 8cm --object 12cm --gap 14cm
refused double-gauss -f 8cm --object 12cm
refused double-gauss --object 12cm -m 2
# in front of the focus of a mirror images are positive: so is the one at infinity
lenscalc conjugate --mirror concave -f 6cm --object 6cm,7cm --columns image_distance,image_kind,image_focal --csv
