# Cartesian product, the first option slowest; the order is that of the command's options
lenscalc dof -s 1,2 -f 50,85 -N 4 -c 0.03,0.02 --csv --columns focal_mm,distance_m,coc_mm
lenscalc fov -f 35 --sensor aps-c,35mm --csv --digits 8 --columns sensor,focal_mm,horizontal_deg
lenscalc dof -f 50 -N 4 -s 3 --model exact,no-f,popular,close-up --csv --columns model,near_m,far_m
