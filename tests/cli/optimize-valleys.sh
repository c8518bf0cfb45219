# narrow and bent valleys, where straight steps creep: conics from spheres, edges as inequalities
cat > cassegrain.lens <<'EOF'
lens    Cassegrain from spheres
wavelength d
field   angle 0 0.1 0.2
aperture epd 200
focus   table
surface -1200 -440 mirror 200 stop
surface -420 600 mirror 60
EOF
# a thousand straight steps end at 4.8e-6
lenscalc optimize cassegrain.lens --vary R1,R2,k1,k2,t2 --goals poly,efl=2000:10 \
    --iterations 600 --columns merit_after,status --csv | sed 1d |
    awk -F, '{ print ($1 < 1e-6 ? "small" : "large"), $2 }'
# what the step runs into is part of it: steep edges take no more steps than mild ones
for deviation in 1 0.01; do
    lenscalc optimize cooke-triplet-50 --vary all-R,all-t \
        --goals "poly,efl=50,edge>1:$deviation,center>1.5:$deviation,air>0.5:$deviation" \
        --columns iterations,status --csv
done | awk -F, 'NR % 2 == 0 { print ($1 < 60 ? "few" : "many"), $2 }'
