# photographs through real lenses: each command, positions, batches, what overrides, what is refused
lenscalc dof --lens double-gauss -N 4 -s 2m
lenscalc dof --lens double-gauss -s 2m --from front --json
lenscalc dof --lens canon-nfd-70-210 --position all -s 3m
lenscalc dof --lens canon-nfd-70-210 --position tele,wide -s 3m,5m --csv \
    --columns position,distance_m,focal_mm,near_sensor_m
lenscalc dof --lens double-gauss --near 2m --far 3m --csv --columns fnumber,distance_m
lenscalc dof --lens double-gauss -P 1 -s 2m --csv --columns pupil_magnification,fnumber
lenscalc dof --lens double-gauss -N 8 --near 1m --far 1.1m --from front --stack
lenscalc dof --lens asahi-takumar18-bad -s 1m --columns near,far
lenscalc hyperfocal --lens wide-35 -N 8 --explain
lenscalc fov --lens double-gauss -s 0.5m --explain
lenscalc fov --lens nikkor-z-14-24 --position all
lenscalc fov --lens fisheye-16 --columns diagonal
lenscalc fov --lens fisheye-16 --columns diagonal --projection equidistant
lenscalc focus --lens double-gauss -m 1:4 --explain
lenscalc focus --lens double-gauss -s 1m --from front --tube 30 --columns distance,working_distance
lenscalc exposure --lens cooke-triplet-50 --ev 12 -m 1:2
lenscalc exposure --lens cooke-triplet-50 --ev 12 -t 1/125 --iso 400 --columns fnumber
lenscalc diffraction --lens laikin54-ir --columns airy_diameter,working_fnumber
lenscalc diffraction --lens double-gauss --near 2m -w F
lenscalc equivalent --lens canon-nfd-70-210 --position all --to aps-c
# of a batch the lens may be a column too
printf 'lens,s,N\ndouble-gauss,2m,4\nwide-35,2m,\nnone,1m,4\ndouble-gauss,3m,4\n' |
    lenscalc dof --batch - --csv --columns focal_mm,fnumber,near_m,near_sensor_m
printf 'lens,s\n-,1m\nwide-35,1m\n' | lenscalc dof --batch - --csv --columns near_m
printf 's\n1m\n' | lenscalc dof --lens - --batch -; echo $?
lenscalc dof --lens double-gauss -f 50 -s 3m
lenscalc dof --position tele -f 50 -s 3m -N 4
lenscalc dof --lens canon-nfd-70-210 --position wide,tela -s 3m
lenscalc dof --lens canon-nfd-70-210 --position all -s 3m --scale all.svg
lenscalc dof -f 50 -N 4 -s 3m --from front
lenscalc dof --lens schmidt-flat -s 30m
lenscalc dof --lens canon-retrofocus-14 -s 30mm
lenscalc equivalent --lens canon-retrofocus-14 -s 30mm
lenscalc dof --lens micro60x-na09 -s 3m -N 4
printf 'surface 50 5 1.5 -\nsurface -50 0 air -\n' > own.lens
lenscalc dof --lens own.lens -s 3m -N 4
lenscalc dof --lens own.lens -s 3m -N 4 -P 1 --columns near,far
lenscalc dof --lens - -s 3m -N 4 -P 1 --columns near,far < own.lens
printf 'surface 8 22 1.336 -\n' | lenscalc fov --lens - -P 1
printf 'surface -50 2 1.5 -\nsurface 50 0 air -\n' | lenscalc hyperfocal --lens - -N 4 -P 1
