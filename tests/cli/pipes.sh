# one command's output feeds the next
lenscalc dof -f 50 -N 2.8,4 -s 3,inf --csv --columns focal_mm,fnumber,distance_m,coc_mm,near_m,far_m |
    lenscalc dof --batch - --csv --columns focal_mm,near_m,far_m
lenscalc dof -f 50 -N 2.8,4 -s 3,inf --jsonl --columns focal_mm,fnumber,distance_m |
    lenscalc fov --batch - --csv --columns focal_mm,distance_m,field_width_m --digits 9
lenscalc fov --horizontal 40,60,90 --csv --columns focal_mm --digits 9 |
    lenscalc hyperfocal --batch - -N 8 --csv --columns focal_mm,hyperfocal_m --digits 7
