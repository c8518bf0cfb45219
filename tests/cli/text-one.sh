# one answer in text: a list of label, number, unit
lenscalc dof -f 50mm -N 2.8 -s 3m
