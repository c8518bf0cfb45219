# red, green and blue of Radiance pictures: those of sRGB, or what PRIMARIES= says
cat > sky.scene <<'EOF2'
camera at=0,0,0 look=0,0,-1 focus=inf
light environment file=sky.hdr luminance=1000
EOF2
sky() { # PRIMARIES, PIXELS
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n%b\n-Y 1 +X 2\n%b' "$1" "$2" > sky.hdr
    lenscalc render sky.scene --lens double-gauss-50 -t 1/100 --size 6x4 --samples 1 -o "$3" \
        2>&1 | grep -v 'lx on\|more than'
}
green='\100\200\100\201\100\200\100\201'
sky '' "$green" none.pfm
sky 'PRIMARIES= 0.64 0.33 0.30 0.60 0.15 0.06 0.3127 0.3290\n' "$green" same.pfm
sky 'PRIMARIES= 0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n' "$green" wide.pfm
cmp none.pfm same.pfm && echo the same
cmp -s none.pfm wide.pfm || echo another
# green alone is beyond sRGB: it loses saturation; no primaries at all; a white that they do not make
sky 'PRIMARIES= 0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n' '\0\200\0\201\0\200\0\201' green.pfm
sky 'PRIMARIES= 0.708 0.292\n' "$green" no.pfm
sky 'PRIMARIES= 0.708 0.292 0.170 0.797 0.131 0.046 0.8 0.1\n' "$green" no.pfm
# the same is said of a card's picture and of a texture, and by tone; luminance stays: by fractions,
# with the primaries that Radiance writes, 0.3492 of the first pixel and 0.8392 of the second
sky 'PRIMARIES= 0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333\n' '\010\200\010\200\100\200\100\201' own.pfm
lenscalc render sky.hdr --lens double-gauss-50 -s 2m -t 1/100 --size 6x4 --samples 1 -o card.pfm 2>&1 | grep beyond
lenscalc tone sky.hdr --calibrate 1 -o tone.png 2>&1 | grep 'beyond\|luminance'
cat > card.scene <<'EOF2'
camera at=0,0,5 look=0,0,0 focus=5
light sky uniform luminance=100
material cloth lambert texture=sky.hdr
card at=0,0,0 size=1,1 material=cloth
card at=1,0,0 size=1,1 material=cloth
EOF2
lenscalc render card.scene --lens double-gauss-50 -t 1/100 --size 6x4 --samples 1 -o card.pfm 2>&1 | grep beyond
# columns before rows
printf '#?RADIANCE\n\n+X 2 -Y 1\n%b' "$green" > sky.hdr
lenscalc render sky.scene --lens double-gauss-50 -t 1/100 --size 6x4 --samples 1 -o columns.pfm 2> /dev/null
cmp none.pfm columns.pfm && echo the same
ls
