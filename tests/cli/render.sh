# rays from a film: rows and doubles, other seeds, dark corners, and what is refused
lenscalc render cs348b-dgauss-50 --rays - --samples 4 -w d |
    awk -F, 'NR > 1 { for (i = 1; i <= NF; i++) $i = sprintf("%.7g", $i) } { print }'
lenscalc render cs348b-dgauss-50 --rays - --samples 2 -w d --seed 5 | tail -1 | cut -c 1-40
lenscalc render cs348b-dgauss-50 --rays rays.tsv --samples 300 --spectrum d:2,F:1
cut -f 3 rays.tsv | sort | uniq -c | sed 's/^ *//'
lenscalc render cs348b-dgauss-50 --rays rays.raw --samples 4 -w d
head -1 rays.raw
tail -n +2 rays.raw | od -A n -t f8 -w80 -v | awk 'NR == 1 { for (i = 1; i <= NF; i++) printf "%.7g\n", $i }'
# the mean of E/L over the film, by an independent program: 0.110853
lenscalc render cs348b-dgauss-50 --rays - -w d --focus 36.3612 | awk -F, 'NR > 1 { sum += $10 } END { printf "%.4f\n", sum }'
lenscalc render fisheye-16 --rays fisheye.csv --samples 10
lenscalc render nikkor-z-14-24 --position tele --rays - --samples 1 | tail -1 | cut -c 1-30
lenscalc render double-gauss
lenscalc render double-gauss --rays rays.png
lenscalc render double-gauss --rays rays.csv -w d --spectrum photopic
lenscalc render nikkor-z-14-24 --position all --rays rays.csv
lenscalc render double-gauss -N 2,4 --rays rays.csv
lenscalc render schneider-anamorphic-31 --rays lost.csv
lenscalc render phone-6p --rays lost.csv
lenscalc render laikin48-telescope --focus 0 --rays lost.csv
printf 'lens afocal\naperture stop\nstop - 1 air 5\nsurface 50 5 1.5 20\nsurface - 100 air 20\nsurface - 5 1.5 20\nsurface -50 0 air 20\n' | lenscalc render - --rays lost.csv
ls lost.csv
