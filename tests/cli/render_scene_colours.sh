# colours of a scene that sRGB does not hold: said, with their share; kept by wavelengths
printf 'wavelength_nm\tshare\n380\t0\n610\t0\n620\t1\n780\t1\n' > red.tsv
cat > colours.scene <<'EOF'
scene Colours
camera at=0,0,5 look=0,0,0 focus=5
colour red table=red.tsv
material red lambert colour=red
material ember black luminance=100 emission=1000K
material warm black luminance=100 emission=2700K
card size=2,2 material=red
sphere radius=0.2 at=0,0,1 material=ember
sphere radius=0.2 at=1,0,1 material=warm
light sky uniform luminance=1000
light sun illuminance=100 towards=0,0,1 spectrum=600K
EOF
small="--lens double-gauss-50 --size 12x8 --samples 2"
lenscalc render colours.scene $small -o a.pfm 2>&1 | grep saturated
lenscalc render colours.scene $small --spectral -o b.pfm 2>&1 | grep saturated
sed 's/600K/800K/' colours.scene > more.scene
echo 'light sun illuminance=1 towards=0,1,1 spectrum=700K' >> more.scene
lenscalc render more.scene $small -o c.pfm 2>&1 | grep -e saturated -e likewise

# light narrower than bands: with how many its colour comes
printf 'wavelength_nm,power\n385,0\n395,0.14\n405,1\n415,0.14\n425,0\n' > violet.csv
cat > violet.scene <<'EOF2'
camera at=0,0,3 look=0,0,0 focus=3
colour c table=violet.csv
material l black luminance=1000 emission=c
card material=l size=4,4
EOF2
for bands in 8 16 32; do
    lenscalc render violet.scene $small --spectral --bands $bands -o v.pfm 2>&1 | grep narrow
done
