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
printf 'lens afocal\naperture stop\nstop - 1 air 5\nsurface 50 5 1.5 20\nsurface - 100 air 20\nsurface - 5 1.5 20\nsurface -50 0 air 20\n' > afocal.lens
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
