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
# green alone is beyond sRGB; no primaries at all; a white that they do not make
sky 'PRIMARIES= 0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n' '\0\200\0\201\0\200\0\201' no.pfm
sky 'PRIMARIES= 0.708 0.292\n' "$green" no.pfm
sky 'PRIMARIES= 0.708 0.292 0.170 0.797 0.131 0.046 0.8 0.1\n' "$green" no.pfm
# columns before rows
printf '#?RADIANCE\n\n+X 2 -Y 1\n%b' "$green" > sky.hdr
lenscalc render sky.scene --lens double-gauss-50 -t 1/100 --size 6x4 --samples 1 -o columns.pfm 2> /dev/null
cmp none.pfm columns.pfm && echo the same
ls
