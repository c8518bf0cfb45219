# cells that cannot be read: file, line and column
cat > rows.csv <<'END'
f,N,s
"2,8",2.8,3
50,2.8,3s
50,nan,3
50,2.8
50,2.8,3,4
"50,2.8,3
END
lenscalc dof --batch rows.csv --jsonl --columns near_m
echo "status $?"
