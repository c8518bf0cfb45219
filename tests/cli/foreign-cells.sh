# cells that are handed through: csv keeps their bytes, html and markdown have no tags and no links of them
printf 'f,N,s,note\n50,4,2,"=1+2"\n50,4,2,+a\n50,4,2,-a\n50,4,2,@a\n50,4,2,\303\244\377\n' > cells.csv
lenscalc dof --batch cells.csv --csv --columns f | cut -d , -f 1 | od -An -c
printf 'f,N,s,note\n50,4,2,"<b>&</b> [a](javascript:alert(1)) ![b](file:///etc) | <javascript:c> https://d.org"\n50,4,2,q\n' > links.csv
lenscalc dof --batch links.csv --format markdown --columns f
lenscalc dof --batch links.csv --format html --columns f | grep javascript
