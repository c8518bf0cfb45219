# light that passes beyond a gap in the pupil is named by whatever integrates over it or cuts it

for command in spot fan illumination pupil; do
    lenscalc $command cooke-triplet-50 --field 20deg --csv --columns warning | sort -u
done
# nothing is clipped, nothing lies beyond
lenscalc fan cooke-triplet-50 --field 20deg --no-clip --csv --columns warning | sort -u
