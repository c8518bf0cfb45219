# more lenses than are kept at once: of a plane and a sphere in glass of 1.5, efl = 2 R
for r in $(seq 101 250); do
    printf '%s\n' "lens Plano $r" "aperture epd 5" "field angle 0 5" "stop - 1 air 3" \
        "surface - 2 1.5 10" "surface -$r $((2 * r)) air 10" > "$r.lens"
done
names=$(seq -f %g.lens 101 250)
# shellcheck disable=SC2086
lenscalc lens $names --csv --columns lens,efl_mm |
    awk -F '[, ]' 'NR > 1 && $3 == 2 * $2 {good++} END {print NR, good}'
# each with several values of what follows, and the first again behind the last
# shellcheck disable=SC2086
lenscalc lens $names 101.lens --csv -N 4,8 --columns lens,entrance_pupil_diameter_mm |
    awk -F '[, ]' 'NR > 1 && $3 * (NR % 2 ? 8 : 4) == 2 * $2 {good++} END {print NR, good}'
# what was found of one lens is not said of another in its place
columns=field_deg,y_min_mm,y_max_mm,z_mm,illumination
# shellcheck disable=SC2086
lenscalc pupil $names --side exit --field 0,3deg --csv --columns $columns > all.csv
for r in 101 165 166 250; do
    lenscalc pupil $r.lens --side exit --field 0,3deg --csv --columns $columns | tail -n 2 > alone.csv
    sed -n "$((2 * (r - 100))),$((2 * (r - 100) + 1))p" all.csv | cmp - alone.csv && echo "$r"
done
# by threads
# shellcheck disable=SC2086
lenscalc spot $names --field 3deg --csv --threads 1 > one.csv
# shellcheck disable=SC2086
lenscalc spot $names --field 3deg --csv --threads 3 | cmp - one.csv && wc -l < one.csv
cut -d, -f 3-9 one.csv | sort -u | wc -l
# rows that a table keeps
# shellcheck disable=SC2086
lenscalc lens $names -N 4,8 --table lens,fnumber:efl_mm --csv 2>/dev/null |
    awk -F '[,.]' '$3 == 2 * $1 && $4 == 2 * $1 {good++} END {print NR, good}'
# a pipe is read once, and all are read before the first row
mkfifo pipe
cat 250.lens > pipe &
# shellcheck disable=SC2086
lenscalc lens $names ./pipe 101.lens --csv --columns lens,efl_mm | tail -n 2
# shellcheck disable=SC2086
lenscalc lens $names missing.lens 101.lens --csv
