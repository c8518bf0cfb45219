# what cannot be traced is named
lenscalc trace
lenscalc trace double-gauss --point 0:1
lenscalc trace double-gauss --point 0:1:x
lenscalc trace double-gauss --point 0:1:2kg
lenscalc trace double-gauss --point 0:inf:2
lenscalc trace double-gauss --direction 0:0:1
lenscalc trace double-gauss --point 0:0:-20 --direction 0:0:0
lenscalc trace double-gauss --x 1 --y 2
lenscalc trace double-gauss --x 0 --y 0 --z 0 --cos-x 1 --cos-y 1 --cos-z 1
lenscalc trace double-gauss --point 0:0:0 --x 0 --y 0 --z 0
lenscalc trace double-gauss --point 0:0:0 --field 3
lenscalc trace double-gauss --point 0:0:0 --pattern fan
lenscalc trace double-gauss --pupil-point 0:0 --pattern fan
lenscalc trace double-gauss --field 3 --height 3
lenscalc trace double-gauss --to 12
lenscalc trace double-gauss --to middle
lenscalc trace double-gauss --to 3 --verify
lenscalc trace double-gauss --focus sharp
lenscalc trace double-gauss --wavelength -5
lenscalc trace double-gauss --field 85deg
lenscalc trace double-gauss --field 180deg
lenscalc trace double-gauss --clip --no-clip
lenscalc trace double-gauss --position wide
lenscalc convert phone-6p | sed '/^aperture/d' | lenscalc trace -
printf 'lens no stop\nobject inf\nsurface 50 5 1.5 -\nsurface -50 - air -\n' > bare.lens
lenscalc trace ./bare.lens
lenscalc trace ./bare.lens --no-clip
lenscalc trace ./bare.lens -N 4
printf 'lens telescope\nobject inf\naperture stop\nsurface 50 300 1.5 10 stop\nsurface -50 - air 30\n' > afocal.lens
lenscalc trace ./afocal.lens --to image
lenscalc trace ./afocal.lens --focus best
lenscalc lens ./afocal.lens -N 4
printf 'x,y\n0,1\n' | lenscalc trace double-gauss --batch - --csv
# a field is answered by itself: a weight would be lost
lenscalc trace double-gauss --field 0,10:2,14deg
lenscalc pupil double-gauss --field 10deg:0.5
lenscalc draw double-gauss --field 10:x
