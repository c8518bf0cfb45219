# a drawing does without fields that no light comes from; where none is left it is not written
for question in wavefront "psf --size 16" "mtf --frequency 30" fan spot illumination field distortion; do
    lenscalc $question double-gauss -w d -N 8 --field 0,80,14 --plot some.svg --csv >rows 2>said
    echo "$question: $?, $(ls some.svg), $(grep -c "" said) line, $(grep -o '80°' some.svg | head -1)"
    lenscalc $question double-gauss -w d -N 8 --field 80,85 --plot none.svg --csv >rows 2>said
    echo "$question: $?, $(ls)"
    rm some.svg
done
