# object and image of a lens; focusing by the lens and by gaps; what is refused
lenscalc conjugate double-gauss --object 1m
lenscalc conjugate double-gauss --object 0.5m,1m,2m,inf --from front
lenscalc conjugate double-gauss -m -0.5 -N 4 --json
lenscalc conjugate double-gauss --object 0 --from focal --csv
lenscalc conjugate double-gauss --object 1m --from sensor --focus-by lens --explain
lenscalc conjugate canon-nfd-70-210 --object 3m --from sensor --gap d5 --position all
lenscalc conjugate double-gauss --object 2m --from sensor --gap last -w d,F,C
lenscalc conjugate double-gauss --object 2m --object-medium water --image-medium 1.33
lenscalc conjugate double-gauss --object 0.5m..3m:0.5m --plot out.svg --columns magnification > /dev/null
grep -c '<svg' out.svg
lenscalc conjugate double-gauss --object 1m,2m --from front,focal --table from,object:image_distance
printf 'surface 75 0 1.5 -\nsurface - 100 air -\nsurface -25 0 1.5 -\nsurface - 0 air -\n' > scope.lens
lenscalc conjugate scope.lens --object 900 --from front
lenscalc conjugate scope.lens --object 900
lenscalc conjugate scope.lens -m 0.5
lenscalc conjugate scope.lens --object 900 --from entrance
lenscalc conjugate scope.lens --object 900 --from front --focus-by lens
lenscalc conjugate double-gauss --object 200 --from sensor
lenscalc conjugate double-gauss --object 200 --from sensor --focus-by lens
lenscalc conjugate double-gauss --object 100 --from sensor --gap 4
lenscalc conjugate double-gauss --object 10m --from sensor --gap 5,6:-1
lenscalc conjugate canon-nfd-70-210 --object 1m --from sensor --gap d10
lenscalc conjugate canon-nfd-70-210 --object 1m --gap d6
lenscalc conjugate canon-nfd-70-210 --object 1m --gap d5:0
lenscalc conjugate canon-nfd-70-210 --object 1m --gap d5,5
lenscalc conjugate double-gauss --object 1m --gap 3 --focus-by lens
lenscalc conjugate double-gauss --object 1m -m -1
lenscalc conjugate double-gauss --image 90 --from sensor
lenscalc conjugate double-gauss --image 90 --gap last
lenscalc conjugate
