# what several threads answer of a sweep or of one question: the same bytes in the same order,
# failures in their places
for question in "spot double-gauss --field 0,5,80,10 -w d,F --json" \
    "fan cooke-triplet-50 --field 0..20#5 --points 5 --csv" \
    "illumination double-gauss --height 0..25#6 -N 2,4 --csv" \
    "distortion fisheye-16 --field 0..80#40 --calibrated --csv" \
    "spot double-gauss --defocus -0.1..0.1#9 --field 0,10 --table defocus,field" \
    "spot double-gauss --defocus -0.1..0.1#9 --field 10 --explain --plot spots.svg" \
    "spot double-gauss --field 5,80,10 --fail-fast --csv" \
    "field double-gauss --field 0..14#30 --csv" "color double-gauss -N 2,4 --csv" \
    "spot fisheye-16 --field 0,54.565deg,77.95deg --csv" "spot nikkor-z-14-24 --position all --json" \
    "fan double-gauss --points 5 --csv" "mtf double-gauss -N 8 --csv" \
    "wavefront double-gauss --csv" "wavefront double-gauss --zernike noll --terms 9 --csv" \
    "illumination double-gauss --csv" "illumination questar-35 --plot spots.svg --csv" \
    "psf double-gauss -N 8 -w d --size 32 --csv" \
    "psf double-gauss -N 8 -w d --field 10 --size 24 --method huygens --csv" \
    "psf double-gauss -N 8 -w d --size 32 --plot spots.svg --csv"; do
    lenscalc $question --threads 1 >one 2>one.err
    echo "$question: $?"
    cat spots.svg >>one 2>/dev/null
    for threads in 0 2 7; do
        lenscalc $question --threads $threads >more 2>more.err
        cat spots.svg >>more 2>/dev/null
        cmp one more && cmp one.err more.err
    done
    rm -f spots.svg
done
lenscalc report double-gauss -N 8 -o one.html && lenscalc report double-gauss -N 8 -o two.html --threads 2 &&
    cmp one.html two.html
lenscalc spot double-gauss --threads -1
