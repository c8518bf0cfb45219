# wanted results solve for what is not given
lenscalc dof -f 35mm --near 2m --far 10m --csv --columns fnumber,distance_m,near_m,far_m --digits 9
lenscalc dof -f 50mm -N 8 -m 1:2 --csv --columns distance_m,magnification
lenscalc dof -N 8 -s 3m -m 1:50 --csv --columns focal_mm,magnification --digits 9
lenscalc dof -f 50mm -s 3m --dof 1m --csv --columns fnumber,dof_m --digits 9
lenscalc dof -f 50mm -N 8 --far inf --csv --columns distance_m,near_m,far_m --digits 9
lenscalc hyperfocal -f 35mm --hyperfocal 5m --csv --columns fnumber,hyperfocal_m --digits 9
lenscalc fov --horizontal 90deg --csv --columns focal_mm,horizontal_deg --digits 9
lenscalc fov --field-width 2m -s 3m --csv --columns focal_mm,field_width_m --digits 9
