# the scenes of tests/scene are whole
for name in still-life moving colours night room toy village; do
    lenscalc render "$TESTS/../scene/$name.scene" --lens double-gauss-50 -N 4 -t 1/60 --size 6x4 \
        --samples 1 -o "$name.pfm" 2> /dev/null && echo "$name: $(head -c 2 "$name.pfm")"
done
# what is wrong with others is said with its place
photograph() { lenscalc render "$1" --lens double-gauss-50 -s 3m --size 6x4 --samples 1 -o x.pfm; echo "status $?"; }
{ echo 'camera at=0,0,3 look=0,0,0'; echo 'light sky uniform luminance=100'; } > begin
scene() { cat begin - > "$1.scene"; echo "-- $1" | tee /dev/stderr; photograph "$1.scene"; }
printf '\211PNG\r\n\032\n' > cut.png
printf 'PF\n2 1\n-1.0\n\000\000\300\177\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000' > nan.pfm
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n# three of them\nf 1 2 4\n' > bad.obj
printf 'wavelength_nm,reflectance\n400,0.5\n500,half\n' > bad.csv
scene missing-texture << 'END'
material wood lambert texture=wood.png
END
scene truncated-png << 'END'
card file=cut.png size=1
END
scene nan << 'END'
light environment file=nan.pfm luminance=1000
END
scene mesh << 'END'
material grey lambert colour=0.18
mesh material=grey file=bad.obj
END
scene table << 'END'
colour leaf table=bad.csv
END
scene unknown << 'END'
material grey lambert colour=0.18
sphere material=gray radius=1
END
scene size << 'END'
material grey lambert colour=0.18
sphere material=grey radius=0
END
scene key << 'END'
material grey lambert color=0.18
END
echo 'camera at=0,3,0 look=0,0,0' > up.scene
photograph up.scene
echo 'camera at=0,3,0 look=0,0,-9' > dark.scene
photograph dark.scene
