# beside a complete question a wish is met by the circle of confusion, which is said first
lenscalc dof -f 50mm -N 8 -s 3m --near 2m --columns coc,near
for wish in '--far inf' '--dof 1m' '--hyperfocal 6m' '--near 1m,2m'; do
    lenscalc dof -f 50mm -N 8 -s 3m $wish --csv --columns coc --digits 4
done
lenscalc dof -f 50mm -N 8 -s 3m --near 2m --format markdown --columns near
# a question that is solved for what is missing is what it looks like
lenscalc dof -f 50mm -N 8 --near 2m --csv --columns near
