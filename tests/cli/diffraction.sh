# Airy disc, limits by pixels and film, contrast, best f-number
lenscalc diffraction -N 64 -w 500nm --explain
lenscalc diffraction -N 2.8..32 --sensor "Nikon D1"
lenscalc diffraction --sensor "Nikon D1" --film 100
lenscalc diffraction -N 16 -m 1:1 --json --digits 6
lenscalc diffraction -N 8 --frequency 10..100:10 --pitch 4um
lenscalc diffraction -N 8 --frequency 50 --defocus 20 --explain
lenscalc diffraction -f 90,150,300 --near 2m --sensor 4x5
lenscalc diffraction --focus-spread 3 --explain
lenscalc diffraction -N 4,8,16 --frequency 0..200:10 --plot mtf.svg --csv --columns mtf_total > table
ls mtf.svg
for words in '-N 0' '--near 0.1 -f 150' '--near 2' '--frequency 10' '-N 8 --film 0' \
    '-N 8 --near 3 --far 2 -f 50' '-N 8 -w 0' '-N 8 -c 2px'; do
    lenscalc diffraction $words
    echo "status $?"
done
lenscalc diffraction --aperture 11in --frequency 40
# of a diameter alone there are angles, and no image
lenscalc diffraction --aperture 11in,8in --csv --columns diameter,rayleigh --digits 6
for words in '--pitch 4um' '-c 0.03' '--sensor aps-c' '--print A2' '--film 60' '-P 2'; do
    lenscalc diffraction --aperture 11in $words
    echo "status $?"
done
lenscalc diffraction --aperture 0in
