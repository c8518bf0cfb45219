# errors name a quantity by how it was given: option, column, key, or neither
printf 's_m\n0.04\n3\n' | lenscalc dof -f 50 -N 2.8 --batch - --csv --columns near_m
printf '{"s":"4cm","f":50}\n' | lenscalc dof -N 2.8 --batch - --jsonl --columns near_m
lenscalc dof --lens cooke-triplet-50 -s 40mm -N 8
printf 'near_m,far_m,f\n5,3,50\n' | lenscalc dof -N 8 --batch - --csv --columns near_m
printf 'near_m,f\n5,50\n' | lenscalc dof --batch - --csv --columns near_m
printf 'f,N,s\n50,2.8,3\n' | lenscalc dof -c 2px --batch - --csv --columns near_m --sensor 36x24mm
lenscalc dof -f 50
lenscalc dof -f 50 -N 2.8 -s 3 --near 2
lenscalc dof -f 50 -N 2.8 --hyperfocal 9
lenscalc tilt -f 50 -N 2.8 -c 30mm --tilt 5 -s 3
lenscalc tilt -f 50 -N 1 --tilt 5 -s 3 --sensor 80mmx80000mm
lenscalc exposure -N 8 -t 1/125 --ev-at-iso 9
printf 't,sync,g,N,ev,s\n1/500,1/200,36,8,12,4.5\n' | lenscalc flash --batch - --csv --columns time_s
lenscalc fov -f 50 --horizontal 30
lenscalc motion -f 50 -s 10 --speed 1 -t 20 --angle 0
printf 'v,t\n1,20\n' | lenscalc motion -f 50 -s 10 --batch - --angle 0 --csv --columns time_s
lenscalc bracket --from 1 --to 2
lenscalc stars -f 24 -t 100000
lenscalc diffraction -f 50 --near 3 --far 2
lenscalc dof -f 50 -N 2.8 -s '{focal length}'
# what a command itself asks for
printf 'g,N,ceiling\n36,8,2\n' | lenscalc flash --batch - --csv --columns distance_m
printf 's_m,m\n3,0.1\n' | lenscalc equivalent -f 50 --batch - --csv --columns equal_focal_mm
printf 'f,tilt\n50,5\n' | lenscalc tilt -N 8 --batch - --csv --columns hinge_m
printf 'tilt,N,s\n5,8,3\n' | lenscalc tilt --batch - --csv --columns hinge_m
printf 'near_m,focus_spread,f\n3,1,50\n' | lenscalc diffraction --batch - --csv
printf '{"h_scale":1,"field":3,"height":2}\n' | lenscalc trace double-gauss --batch - --jsonl --columns y_out_mm
printf 'coc,f\nd/1500,50\n' | lenscalc dof -N 8 --print 300mm --batch - --csv --columns near_m
printf 'f,far,distance\n50,inf,inf\n' | lenscalc dof --batch - --csv --columns fnumber
