# a star is metered where no ray of the picture meets it; a pupil too small for rays
printf 'camera at=0,0,0 look=0,0,-1 focus=inf\nlight star magnitude=0 towards=0.01,0.01,-1 diameter=1arcmin\n' > star.scene
printf 'camera at=0,0,0 look=0,0,-1 focus=inf\nlight sky uniform luminance=1000\n' > sky.scene
few="--lens double-gauss-50 --size 12x8 --samples 1"
lenscalc render star.scene $few --no-skip lamps -o missed.png
lenscalc render star.scene $few -o star.png
lenscalc render star.scene $few --crop 0:0:2x2 -t 6000 -o corner.png
lenscalc render sky.scene $few -N 8000 -o small.png 2>&1 | grep -o 'arrive.*'
