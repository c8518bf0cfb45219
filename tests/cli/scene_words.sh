# what is written in a scene another way than it is read is said, with what was meant
sky='camera at=0,0,3 look=0,0,0 focus=3\nmaterial grey lambert colour=0.5\nsphere material=grey radius=0.5\n'
photograph() {
    printf "$sky$1\n" > words.scene
    lenscalc render words.scene --lens double-gauss-50 --size 3x2 --samples 1 --model thin -N 8 -t 1/60 -o words.pfm
}
# a number of kelvin without its unit would be a grey; one up to 1 is white
photograph 'light sky uniform luminance=1000 spectrum=3000'
photograph 'light sky uniform luminance=1000 spectrum=3'
photograph 'material lamp black luminance=1000 emission=2700'
photograph 'light sky uniform luminance=1000 spectrum=1' && cp words.pfm white.pfm
photograph 'light sky uniform luminance=1kcd/m2' && cmp words.pfm white.pfm && echo same
# prefixes; each line throws 100 lx on what faces it 1 m away
photograph 'light point at=0,0,1.5 intensity=0.1kcd' && cp words.pfm candela.pfm
photograph 'light point at=0,0,1.5 intensity=100000mcd' && cmp words.pfm candela.pfm && echo same
photograph 'light sun illuminance=0.1klx towards=0,0,1' && cp words.pfm lux.pfm
photograph 'light sun illuminance=100000mlx towards=0,0,1' && cmp words.pfm lux.pfm && echo same
photograph 'light sky uniform luminance=1\nlight star magnitude=-1 elevation=20 azimuth=0 diameter=0'
photograph 'light sky uniform luminance=1\nbox material=grey size=1,1,1 spin=1e9'
# a turn in a day of 86164 s is 15.041 degrees an hour, or seconds of arc a second
night() {
    printf 'camera at=0,0,0 look=0,0,-1 focus=inf %s\nlight star illuminance=1 diameter=20deg elevation=0 azimuth=3\n' "$1" > night.scene
    lenscalc render night.scene --lens double-gauss-50 --size 12x8 --samples 64 --model thin -N 8 -t "$2" -o night.pfm
}
night spin=-15.041deg/h 0.5d && cp night.pfm hour.pfm
night spin=-15.041arcsec/s 12h && cmp night.pfm hour.pfm && echo same
# meshes: what is said of them names their file, and places in a texture count where there is one
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nf 1/1 2/1 3/1\nf 1 2 4\nf 1 2 2\n' > flat.obj
photograph 'mesh material=grey file=flat.obj\nmesh material=grey file=flat.obj at=1,0,0\nlight sky uniform luminance=1'
printf 'P6\n' > lost.png
photograph 'material wood lambert texture=lost.png'
lenscalc render chart:checker --lens double-gauss-50 -s 2m --size 6x4 --samples 1 -N 8 -t 1/8 -o wood.png 2> /dev/null
photograph 'material wood lambert texture=wood.png\nmesh material=wood file=flat.obj\nmesh material=wood file=flat.obj at=1,0,0\nlight sky uniform luminance=1'
printf 'v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r' > mac.obj
photograph 'mesh material=grey file=mac.obj\nlight sky uniform luminance=1'
printf 'camera at=0,0,3\rlight sky uniform luminance=1\r' > mac.scene
lenscalc render mac.scene --lens double-gauss-50 -s 2m -o lost.pfm
# what is neither a picture nor a scene
cp words.scene words.scn
mkdir folder
for file in words.scn folder none.png; do lenscalc render $file --lens double-gauss-50 -o lost.pfm; done
lenscalc render wood.png --lens double-gauss-50 -o lost.pfm
lenscalc render --scene words.scene --lens double-gauss-50 -o lost.pfm
lenscalc exposure -N 8 --scene words.scene
# lenses
printf "${sky}light sky uniform luminance=1\\n" > words.scene
lenscalc convert micro60x-na09 | sed '/^aperture/d' | lenscalc render words.scene --lens - -o lost.pfm
lenscalc convert asahi-takumar-100 | sed '/^field/d; s/^stop/surface/' | lenscalc render words.scene --lens - -N 4 -o lost.pfm
lenscalc convert asahi-takumar-100 | sed '/^field/d; s/^stop/surface/' | lenscalc render words.scene --lens - --focus table -o lost.pfm
lenscalc convert asahi-takumar-100 | sed '/^field/d; s/^stop/surface/' | lenscalc render words.scene --lens - --focus table -N 4 -o lost.pfm
ls lost.pfm
# a clear sky whose sun nobody places: no sun, and two
photograph 'light sky clear luminance=1000'
photograph 'light sun illuminance=1 towards=0,0,1\nlight sun illuminance=1 towards=0,1,1\n  light sky clear luminance=1000  # about which?'
