# chosen columns, in other units by their suffix
lenscalc dof -f 50mm -N 2.8 -s 3m --csv --columns near_ft,far_in,near_mm,focal_cm,hyperfocal_yd
lenscalc dof -f 50mm -N 2.8 -s 3m --csv --columns near,far,near_diopter
lenscalc dof -f 50mm -N 2.8 -s 3m --jsonl --columns far_ft,sensor
lenscalc fov -f 50mm --csv --digits 10 --columns horizontal_rad,horizontal_deg,vertical_arcmin
lenscalc dof -f 50mm -N 2.8 -s 3m --csv --columns neer_m
echo "status $?"
lenscalc dof -f 50mm -N 2.8 -s 3m --csv --columns near_kg
echo "status $?"
# people see what was swept before what they name; machines get what they name
lenscalc dof -f 50mm -N 2.8,4 -s 2m,3m --columns near_m,far_m
lenscalc dof -f 50mm -N 2.8,4 -s 3m --columns near_m,fnumber
lenscalc dof -f 50mm -N 4 -s 3m -c 0.01,0.02 --columns far_ft
lenscalc dof -f 50mm -N 4 -s 3m --sensor 35mm,aps-c --columns near_m
lenscalc dof -f 50mm -N 2.8,4 -s 3m --columns near_m --csv
