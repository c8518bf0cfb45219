# rows in, rows out: units in the header and in cells, notes handed through, quotes, comments
cat > rows.csv <<'END'
# my lenses

f,aperture,s_ft,note
50mm,f/2.8,10,plain
3.5cm,4,5ft6in,"quoted, ""so"""
85,1.8,2m,"a line
break"
50,2.8,,
END
lenscalc dof --batch rows.csv --csv --columns focal_mm,distance_m,near_m --digits 8 -c 0.03
echo "status $?"
lenscalc dof --batch rows.csv --jsonl --columns near_m --digits 8 -c 0.03
echo "status $?"
