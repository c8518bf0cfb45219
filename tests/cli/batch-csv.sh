# rows in, rows out: units in the header and in cells, notes handed through, quotes, comments
cat > rows.csv <<'END'
# my lenses

f,aperture,s_ft,c_um,note
50mm,f/2.8,10,30,plain
3.5cm,4,5ft6in,,"quoted, ""so"""
# an empty cell is what the option is without it
85,1.8,2m,0.03mm,"a line
break"
50,8,inf,d/1730,
END
lenscalc dof --batch rows.csv --csv --columns focal_mm,distance_m,coc_mm,near_m --digits 8
echo "status $?"
lenscalc dof --batch rows.csv --jsonl --columns far_m --digits 8
echo "status $?"
