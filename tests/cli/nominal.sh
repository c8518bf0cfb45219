# labels of stop series stand for their exact values; what is no label is refused
exact() {
    echo "[$1]" $(lenscalc dof -f 50mm -s 3 --csv --columns fnumber --nominal -N "$1" | tail -n +2)
}
exact 5.6
exact 1.4..16
exact 4..8/third
exact 5.7
lenscalc dof -f 50mm -s 3 -N 5.7 --nominal > text
echo "status $?"
