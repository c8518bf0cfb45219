# One column bare, for $(...); csv and tsv without the line of names.
lenscalc dof 50mm f/2.8 3m --value coc_criterion
lenscalc dof 50mm f/2.8 inf --value far_m
test "$(lenscalc dof 50mm f/2.8 3m --value near_m)" = \
    "$(lenscalc dof 50mm f/2.8 3m --csv --columns near_m | tail -n 1)" && echo same
lenscalc dof 50mm f/2.8 3ft --value distance_ft
printf 'f,s,who\n50,5,a\n50,x,b\n50,7,c\n' | lenscalc dof f/4 --batch - --value distance
echo $?
lenscalc dof 50mm f/4,8 3m --csv --no-header --columns fnumber,distance
lenscalc dof 50mm f/4,8 3m,5m --table N,s:distance --tsv --no-header
printf 'f,s,who\n50,5,a\n50,7,c\n' | lenscalc dof f/4 --batch - --csv --no-header --columns fnumber
# and what says nothing
lenscalc dof 50mm f/4 3m --value near,far
lenscalc dof 50mm f/4 3m --value nearest
lenscalc dof 50mm f/4 3m --value near --csv
lenscalc dof 50mm f/4 3m --value near --columns far
lenscalc dof 50mm f/4 3m --no-header
lenscalc convert double-gauss --value near
