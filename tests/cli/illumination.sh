# light over the image: tenths of the field, heights, fields, a narrower stop, mirrors, refusals
lenscalc illumination double-gauss --digits 3
lenscalc illumination double-gauss --height 0,10,20 --csv --digits 8 --columns height,field,irradiance_per_radiance,relative_point,relative_field,vignetted_fraction,cos4
lenscalc illumination cs348b-dgauss-50 --focus paraxial --stop-diameter 4.275 --height 10 --json --digits 6
lenscalc illumination double-gauss --no-clip --field 0,14 --csv --digits 6 --columns height,field,relative_point,relative_field,vignetted_fraction
lenscalc illumination double-gauss -N 4 --height 20 --height-x 10 --csv --digits 6 --columns height,height_x,irradiance_per_radiance,vignetted_fraction
lenscalc illumination double-gauss --object 1000 --field 10 --csv --digits 6 --columns height,field,irradiance_per_radiance,relative_point,relative_field
lenscalc illumination questar-35 --height 0,5 --csv --digits 5 --columns height,irradiance_per_radiance,relative_point,vignetted_fraction
lenscalc illumination nikkor-z-14-24 --position wide,tele --height 15 --csv --digits 5 --columns position,field,relative_point,vignetted_fraction
lenscalc illumination schneider-anamorphic-31 -N 4 --csv --digits 5 --columns height,height_x,relative_point,relative_field | tail -1
lenscalc illumination fisheye-16 --height 21,22 --csv --digits 5 --columns height,field,irradiance_per_radiance,relative_point,vignetted_fraction
lenscalc illumination mirror-tele-us5331467 --csv --digits 4 --columns height,field,relative_point | tail -2
printf 'lens disc\nobject inf\naperture stop\nstop - 0 air 50\n' | lenscalc illumination - --focus 50 --height 0,40 --error 1e-9 --csv --digits 10 --columns height,irradiance_per_radiance
printf 'lens telescope\nobject inf\naperture epd 10\nfield angle 0 1\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n' | lenscalc illumination -
printf 'lens no stop\nobject inf\naperture epd 4\nfield angle 5\nsurface 50 2 1.5 -\nsurface - 98 air -\n' | lenscalc illumination -
lenscalc convert phone-6p | sed '/^aperture/d' | lenscalc illumination -
lenscalc illumination double-gauss --stop-diameter 40 --height 0
lenscalc illumination double-gauss --stop-diameter 0 --height 0
lenscalc illumination double-gauss --stop-diameter 10 -N 4
lenscalc illumination double-gauss --field 80
lenscalc illumination double-gauss --field 0,80,14 --csv --digits 4 --columns field,relative_point
lenscalc illumination double-gauss --height 10 --field 3
lenscalc illumination double-gauss --height 10 --clip --no-clip
lenscalc illumination double-gauss --height 10 --error 2
lenscalc illumination double-gauss --height 0 --plot light.svg --columns height
lenscalc illumination double-gauss --height 0..25#6 -N 2,4 --table height,aperture --plot light.svg && grep -o '<text[^>]*>[^<]*</text>' light.svg | sed 's/<[^>]*>//g' | tail -6
lenscalc illumination double-gauss --object 30
