# objects with other keys than the first, rows that fail, and what is handed through of them
cat > rows.jsonl <<'END'
{"f":50,"N":"x","s":2,"note":"a\",\"near_m\":1","count":7}
{"f":50,"N":4,"s":2,"note":3,"count":null}
{"f":50,"N":4,"distance_ft":9,"near_m":3,"id":"a"}
{"f":50,"N":4,"s":2,"focal_mm":50,"note":"q"}
{"f":50,"N":4,"s":2,"focal_mm":60,"note":"r"}
{"f":50,"N":4,"s":"1 parsec","id":true,"note":"behind what failed"}
{"f":50,"N":4,"s":3,"error":"computed anew","error":1}
{"f":50,"N":4,"s":3,"count":-1.5e3}
END
for format in json jsonl csv text; do
    lenscalc dof --batch rows.jsonl --format $format --columns distance,near --digits 6
done
# the first row fails, and the last is of another kind
head -n 1 rows.jsonl | lenscalc dof --batch - --json --columns near
# numbers that JSON does not have are not handed through as such
for number in 007 -.5 1. +1 1e 0x1 -; do
    printf '{"f":50,"N":4,"s":2,"n":1}\n{"f":50,"N":4,"s":2,"n":%s}\n' "$number" |
        lenscalc dof --batch - --jsonl --columns near --digits 6
done
# rays wait for one another, with what is theirs
cat > rays.jsonl <<'END'
{"x":0,"y":1,"z":-20,"n":1}
{"x":0,"y":1,"z":-20,"n":"q\",\"m\":0"}
{"x":0,"y":2,"z":-20,"n":null}
{"x":0,"y":2,"z":-20,"n":2,"m":1,"w":486}
{"x":0,"y":2,"z":-20}
END
lenscalc trace double-gauss --batch rays.jsonl --jsonl --columns wavelength,y_out --digits 6
# one reason why a row failed, and one error of its contrast
printf 'N\n8\n0\n' | lenscalc mtf double-gauss --field 0 -w d --frequency 40 --batch - --csv |
    head -n 1 | tr , '\n' | grep error
