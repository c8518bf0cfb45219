# the machine formats, with and without infinities
for format in csv tsv json jsonl; do
    lenscalc dof -f 50mm -N 2.8 -s 3m,inf --format $format
    echo "status $?"
done
lenscalc dof -f 50mm -N 2.8 -s 3m --sensor 35mm --json
for format in text csv tsv json jsonl markdown latex html; do
    lenscalc dof -f 50mm -N 2.8 -s 3m --columns near_m,far_m --format $format
done
lenscalc dof -f 50 -N 2.8 -s 3 --format jsn
echo "status $?"
lenscalc dof -f 50 -N 2.8 -s 3 --csv --json
echo "status $?"
# more than a page of LaTeX is a longtable, one page a tabular; signs that its fonts lack are written by others
for count in 40 41; do
    lenscalc hyperfocal -f 50 -N 1..16#$count --format latex | grep -E 'needs|begin|end'
done
lenscalc list units --format latex | grep micrometre
