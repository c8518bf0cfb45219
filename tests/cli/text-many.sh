# many answers in text: a table
lenscalc dof -f 50mm -N 2.8..8 -s 1,5,inf
lenscalc fov -f 14,24,50,200
