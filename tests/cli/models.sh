# models of lenses, and what is focused by what: rays of each, and what is refused
printf 'lens hand\nunit mm\nwavelength d\nobject inf\naperture stop\nsurface - 12 air -\nstop - 8 air 20\nthick 50 15 air - hiatus=5\nsurface - 0 air -\n' > hand.lens
for model in exact paraxial thick thin pinhole
do
    lenscalc render --lens hand.lens --model $model --rays - --samples 1 --sensor 1e-9x1e-9mm |
        awk -F, 'NR > 1 { printf "%.4f %.4f %.4f\n", $4, $5, $10 }'
done
lenscalc render chart:grid --lens double-gauss-50 -s 1m --size 8x8 --samples 1 --model thin -o thin.png
tr '\0' ' ' < thin.png | grep -ao 'Lens model [a-z]*'
lenscalc render --lens hand.lens --model pinhole --blades 5 --rays lost.csv
lenscalc render --lens hand.lens --model fish --rays lost.csv
lenscalc render --lens schneider-anamorphic-31 --model thin --rays lost.csv
printf 'lens afocal\naperture stop\nstop - 0 air 5\nthick 50 100 air - hiatus=0\nthick 50 0 air - hiatus=0\n' > afocal.lens
lenscalc render --lens afocal.lens --focus 100 --model thick --rays lost.csv
lenscalc render chart:grid --lens double-gauss-50 -s 1m --gap 30 -o lost.png
lenscalc render chart:grid --lens double-gauss-50 -s 1m --gap last --focus best -o lost.png
lenscalc render chart:grid --lens double-gauss-50 -s 1m --focus-at best -o lost.png
lenscalc render --lens double-gauss-50 --gap last --rays lost.csv
# too near: with the distance that is the least
lenscalc render chart:grid --lens double-gauss-50 -s 10cm --from sensor -o lost.png
lenscalc render chart:grid --lens double-gauss-50 -s 10cm --from sensor --gap last -o lost.png
lenscalc render chart:grid --lens double-gauss-50 -s 20cm --gap 6 -o lost.png
lenscalc render chart:grid --lens double-gauss-50 -s 1cm -o lost.png
ls lost.*
# what lies at a point of the picture
printf 'Pf\n2 1\n-1.0\n\0\0\200\077\0\0\200\177' > map.pfm
card='render chart:edge --lens double-gauss-50 --size 8x8 --samples 1'
lenscalc $card --depth-map map.pfm --autofocus 0.2:0.5 -o near.png
lenscalc $card --depth-map map.pfm --autofocus 0.8:0.5 -o lost.png
lenscalc $card --depth-map map.pfm --autofocus 0.8:0.5 -s 2m -o lost.png
lenscalc $card --autofocus 0.8:0.5 -o lost.png
lenscalc $card --autofocus 0.8 -s 2m -o lost.png
lenscalc $card --autofocus 0.8:1.5 -s 2m -o lost.png
lenscalc $card --autofocus 0.8:0.5 -s 2m --field-width 1m -o lost.png
lenscalc render --lens double-gauss-50 --autofocus 0.8:0.5 --rays lost.csv
ls lost.*
# as many rays as an error takes
card='render chart:edge --lens double-gauss-50 -s 1m --size 16x8'
lenscalc $card --error 50% -o error.png
lenscalc $card --error 0.01% --samples 16 -o error.png
lenscalc $card --error 1% --samples 8 -o lost.png
lenscalc $card --error 2 -o lost.png
lenscalc render --lens double-gauss-50 --error 1% --rays lost.csv
ls lost.*
# a model has no clear apertures: all of f/1 passes it, of the lens what f/2.03 lets through
for model in exact thick; do
    lenscalc render chart:wedge --lens double-gauss-50 --model $model -N 1 -s 2m --size 6x4 --samples 4 -t 1/9 \
        -o wide.hdr --force 2>&1 | grep wide
    grep -a '^# Aperture' wide.hdr
done
