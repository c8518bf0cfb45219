# the same rows as csv, tsv, jsonl, with CRLF, BOM, blanks, and no line end at the end
printf 'f_mm,N,s_m\n50,2.8,3\n35,4,1.5\n' > a.csv
printf 'f_mm\tN\ts_m\n50\t2.8\t3\n35\t4\t1.5\n' > a.tsv
printf '{"f_mm":50,"N":2.8,"s_m":3}\n{"s_m":1.5,"f_mm":"35mm","N":"f/4"}\n' > a.jsonl
printf '\357\273\277f_mm,N,s_m\r\n50,2.8,3\r\n35,4,1.5\r\n' > b.csv
printf 'focal_mm, fnumber ,distance_m\n 50 ,2.8, 3\n35,4,1.5' > c.csv
lenscalc dof --batch a.csv --csv --columns focal_mm,near_m,far_m | tee first
for file in a.tsv a.jsonl b.csv c.csv; do
    lenscalc dof --batch $file --csv --columns focal_mm,near_m,far_m | cmp - first && echo "$file same"
    lenscalc dof --batch - --csv --columns focal_mm,near_m,far_m < $file | cmp - first && echo "$file same"
done
lenscalc dof --batch a.tsv --batch-format tsv --csv --columns near_m
lenscalc dof --batch a.csv --tsv --columns near_m
