# beams on surfaces: fields, one field without clipping, heights, positions, a dark field, a drawing, refusals
lenscalc surfaces double-gauss --show footprints
lenscalc surfaces double-gauss --show footprints --field 14 --no-clip -N 4 --csv --digits 6 | head -4
lenscalc surfaces double-gauss --show footprints --field 5 --field-x 10 -w d,F --json --digits 5 | head -3
lenscalc surfaces questar-35 --show footprints --columns field,surface,beam_radius,semi_diameter,filled
printf 'lens near\nobject 200\naperture stop\nfield height 10\nstop - 3 air 8\nsurface 60 4 1.6 20\nsurface -80 130 air 20\n' | lenscalc surfaces - --show footprints
printf 'lens dark\nobject inf\naperture stop\nfield angle 0 20\nsurface - 30 air 2\nstop - 20 air 2\nsurface 50 3 1.5 -\n' | lenscalc surfaces - --show footprints --csv --digits 4
lenscalc surfaces double-gauss --show footprints --field 80
lenscalc surfaces double-gauss --clip
lenscalc surfaces double-gauss --show footprint
lenscalc surfaces double-gauss --show footprints --plot beams.svg --csv --digits 3 | tail -1
grep -o '<text[^>]*>[^<]*</text>' beams.svg | sed 's/<[^>]*>//g'
