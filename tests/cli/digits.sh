# --digits cuts as printf does; without it the shortest text
for digits in 1 3 6 10; do
    lenscalc dof -f 50mm -N 2.8 -s 3m --csv --columns near_m,far_m,coc_mm --digits $digits
done
lenscalc dof -f 50mm -N 2.8 -s 3m --csv --columns near_m,far_m,coc_mm
lenscalc dof -f 50mm -N 2.8 -s 3m --columns near_m,far_m --digits 8 | head -n 2
