# words of an answer are whole, however long: in a table, below it, for programs
title=$(yes word | head -n 90 | tr '\n' ' ')end
printf 'lens %s\nsurface 50 3 1.5 20\nsurface -50 40 air 20\n' "$title" > long.lens
for form in "" "--csv --columns efl,lens" --json "--columns efl,lens" "--columns efl,lens --format markdown"; do
    lenscalc lens long.lens $form | tr -s ' \n' '  ' | grep -c "word word end"
done
