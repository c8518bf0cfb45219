# shutters: what is said of each, what they need, and what does not go together
shot='render chart:checker --lens double-gauss-50 -s 1m --size 32x24 --samples 1'
lenscalc $shot -t 1/250 --shutter focal --travel-time 8ms --curtain-distance 2mm -o a.pfm
lenscalc $shot -t 1/250 --shutter leaf --opening-time 2ms -N 4 --explain -o b.png 2>&1 | grep -v pupil:
lenscalc $shot -t 1/250,1/60 --shutter leaf --opening-time 2ms --closing-time 4ms --explain -o c.pfm 2>&1 | grep 'leaf\|exposures'
lenscalc $shot -t 1/250 --shutter rolling --readout 20ms --shutter-direction up -o d.png
tr '\0' ' ' < b.png | grep -ao 'Shutter leaf, opens in 0.002 s, closes in 0.002 s'
tr '\0' ' ' < d.png | grep -ao 'Shutter rolling, up in 0.02 s'
lenscalc render --lens double-gauss-50 -t 1/250 --shutter leaf --opening-time 2ms --samples 4 --model thin -s 1m --rays - --explain 2>&1 | sed 's/[0-9.]* % of/N % of/; s/^-*[0-9].*,.*/a ray/'
# what is missing
lenscalc $shot --shutter rolling --readout 20ms -o lost.png
lenscalc $shot -t 1/250 --shutter rolling -o lost.png
lenscalc $shot -t 1/250 --shutter focal -o lost.png
lenscalc $shot -t 1/250 --shutter leaf --closing-time 1ms -o lost.png
lenscalc $shot -t 1/250 --shutter curtain -o lost.png
lenscalc render --lens double-gauss-50 --shutter leaf --opening-time 2ms --rays lost.csv
lenscalc render --lens double-gauss-50 -t 1/250 --rays lost.csv
# what says nothing
lenscalc $shot -t 1/250 --opening-time 2ms -o lost.png
lenscalc $shot -t 1/250 --shutter leaf --opening-time 2ms --curtain-distance 2mm -o lost.png
lenscalc $shot -t 1/250 --shutter leaf --opening-time 2ms --shutter-direction up -o lost.png
# what cannot be
lenscalc $shot -t 1/1000 --shutter leaf --opening-time 2ms -o lost.png
lenscalc $shot -t 1/100,1/1000 --shutter leaf --opening-time 2ms -o lost.png
lenscalc $shot -t 1/100,1/200 --shutter leaf --opening-time 2ms -o lost.part
lenscalc $shot -t 1/100 --shutter leaf --opening-time 2ms --model pinhole -o lost.png
lenscalc $shot -t 1/100 --shutter focal --travel-time 5ms --curtain-distance 39mm -o lost.png
lenscalc $shot -t 1/100 --shutter focal --travel-time -5ms -o lost.png
ls
