# long: a triplet as fast as f/1.4: on its way rays come near total reflection and near missing a surface
cat > fast.lens <<'EOF'
lens        Fast triplet
wavelength  d F C
field       angle 0 10 16
aperture    epd 35
focus       table
surface     -   6   1.6204/60.3   -  c=-0.01017
surface     -   5   air           -  c=0.0096
surface     -   2   1.62/36.4     -  c=-0.05759
surface     -   2   air           -  c=0.0139
stop        -   4   air           -
surface     -   5   1.6204/60.3   -  c=0.01586
surface     -   40  air           -  c=-0.05279
EOF
# where nothing keeps them off, many a step of still faster beams loses some; else it gets further
sed 's/epd 35/epd 44/' fast.lens > faster.lens
vary=c1,c2,c3,c4,c6,c7,t7
for goals in poly,efl=50,grazing\<90 poly,efl=50; do
    lenscalc optimize faster.lens --vary $vary --goals $goals --rays 36 --columns merit_after --csv |
        sed 1d
done | awk '{ merit[NR] = $1 } END { print (merit[2] < merit[1] / 1.5 ? "further" : "no further") }'
# what keeps them off has its own row where it counts, and is a goal that can be set: half a ball
# whose outermost rays just leave its plane, of which nothing but the image plane varies
cat > half.lens <<'END'
wavelength d
aperture   epd 102.93
field      angle 0
focus      table
surface    50 45 1.5 - stop
surface    -  50 air -
END
lenscalc optimize half.lens --vary t2 --goals poly --digits 2 --show merit \
    --columns goal,value_before,value_after,unit,merit_before,merit_after
lenscalc optimize fast.lens --vary $vary --goals 'poly,efl=50,grazing<50:0.1' --iterations 3 \
    --digits 2 --show merit --columns goal,value_before,value_after,unit,merit_before,merit_after
lenscalc optimize fast.lens --vary $vary --goals 'poly,grazing=75'
lenscalc optimize fast.lens --vary $vary --goals 'poly,grazing<95'
lenscalc optimize fast.lens --vary $vary --goals 'efl=50,grazing<80' --show merit --columns goal,value_after --digits 3
