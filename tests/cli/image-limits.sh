# image planes so far away that squares of distances overflow are refused
for command in spot wavefront psf mtf fan distortion field illumination color; do
    lenscalc $command double-gauss --focus 1e308 --csv
    echo "$?"
done
lenscalc spot double-gauss --defocus=-1e200 --field 0
echo "$?"
lenscalc spot double-gauss --defocus 1,1e200 --field 0 --csv --columns defocus,rms --digits 4
