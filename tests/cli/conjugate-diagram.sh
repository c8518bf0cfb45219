# the construction of an image by thin lenses and mirrors
diagram() {
    lenscalc conjugate "$@" --diagram rays.svg > /dev/null &&
        sed -n 's/.*<text[^>]*>\([^<]*\)<.*/\1/p' rays.svg | grep "^f\|^s\|^image: \|image at\|ray$" | paste -s -d ';'
}
diagram -f -15cm --object 10cm --height 3cm
diagram -f 10cm --object 15cm
diagram -f 10cm --image inf
diagram -f 10cm --object inf
diagram -f 10cm --object -15cm
diagram --object 5mm --image 12mm
diagram -f 8cm --then "gap 14cm, f -9.5cm" --object 12cm --steps
diagram -f 31.5cm --object 156cm --from sensor
for kind in "concave -R 30cm" "convex -R 30cm" plane; do
    diagram --mirror $kind --object 20cm
done
refused() {
    lenscalc conjugate "$@" 2>&1
    echo "status $?"
}
refused -f 10cm --object 0 --diagram rays.svg
refused double-gauss --object 1m --diagram rays.svg
refused -f 10cm --object 1m --object-medium water --diagram rays.svg
refused -f 10cm --object 1m --diagram rays.gif
refused -f 10cm,20cm --object 1m --diagram rays.svg
