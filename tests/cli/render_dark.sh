# light that is too little for a file: 5.6e-9 lx s is below the least half, 2^-24, and 1e-60 any float
printf 'camera at=0,0,0 look=0,0,-1 focus=inf\nlight sky uniform luminance=1e-4\n' > night.scene
night='render night.scene --lens double-gauss-50 --size 12x8 --samples 16'
lenscalc $night -t 1/1000 --bits 16 -o lost.exr
lenscalc $night -t 1e-60 -o lost.exr
lenscalc $night -t 1e-60 -o lost.pfm
lenscalc $night -t 1e-60 -o lost.hdr
lenscalc $night -t 1e-60 -o black.png
# some is black, some has fewer digits than 11 bits, and what is above 2^-14 has all
lenscalc $night -t 1.8ms --bits 16 -o some.exr
lenscalc $night -t 10 --bits 16 -o coarse.exr
lenscalc $night -t 100 --bits 16 -o all.exr
lenscalc $night -t 1/1000 -o all.pfm
ls
