# formulas in machine formats: on standard error, or a key of the JSON object
lenscalc dof -f 50mm -N 2.8 -s 3m --explain --csv --columns near_m 2> formulas
head -n 1 formulas
lenscalc dof -f 50mm -N 2.8 -s 3m --explain --json --columns near_m |
    python3 -c 'import json, sys; print(json.load(sys.stdin)["explain"].split("\n")[0])'
