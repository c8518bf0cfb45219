# cells that are handed through: csv keeps their bytes, html and markdown have no tags and no links of them
printf 'f,N,s,note\n50,4,2,"=1+2"\n50,4,2,+a\n50,4,2,-a\n50,4,2,@a\n50,4,2,\303\244\377\n' > cells.csv
lenscalc dof --batch cells.csv --csv --columns f | cut -d , -f 1 | od -An -c
printf 'f,N,s,note\n50,4,2,"<b>&</b> [a](javascript:alert(1)) ![b](file:///etc) | <javascript:c> https://d.org"\n50,4,2,q\n' > links.csv
lenscalc dof --batch links.csv --format markdown --columns f
lenscalc dof --batch links.csv --format html --columns f | grep javascript
# nor has the reason of a row that fails behind the first ones, for which there is no column
{ echo f,N,s; yes 50,4,3 | head -n 520; echo '50,<b>,3'; } > late.csv
for format in html markdown latex; do
    lenscalc dof --batch late.csv --columns near --format $format 2>/dev/null | grep '<\?b' | tail -n 1
done
