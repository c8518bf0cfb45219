# light on the card in words, filters on the lens
card='render chart:edge --lens double-gauss-50 -s 1m --size 16x8 --samples 1 -N 16'
lenscalc $card --ev 15 -t 1/125 -o a.pfm
lenscalc $card --scene sunny-16 --filter ND8+polarizer -o b.png
tr '\0' ' ' < b.png | grep -ao 'Light sunny-16\|Filter [^)]*)'
lenscalc $card --filter wratten-85b -o c.pfm
lenscalc $card --filter wratten-25 -o lost.png
lenscalc $card --filter ND3 --radiance -o lost.pfm
lenscalc $card --ev 3 --luminance 4 -o lost.png
lenscalc $card --ev 3 --scene sunny-16 -o lost.png
lenscalc $card --scene sunny-17 -o lost.png
lenscalc render --lens double-gauss-50 --ev 3 --rays lost.csv
lenscalc render --lens double-gauss-50 --filter ND3 --rays lost.csv
ls
