# the form of a benchmark: numbers are masked, rows for the instructions of the machine left out
mask() {
    awk -F, -v OFS=, '{ for (i = 1; i <= NF; i++) if ($i ~ /^[0-9.]+(e-?[0-9]+)?$/) $i = "#"; print }' |
        grep -v "sse2\|avx2\|avx512"
}
columns=model,variant,degree,terms,quantity,rms_error,error_unit,digits,truth_error
lenscalc bench double-gauss --rays 20 --columns $columns,fitted_error --csv | mask
lenscalc bench double-gauss --quantity spot --rays 30 --degree 5 --columns $columns,rays --csv | mask
lenscalc bench double-gauss --quantity mtf --rays 30 --degree 3 --columns $columns,rays --csv | mask
lenscalc bench double-gauss --quantity photograph --columns $columns,rays --csv | mask
# times: a number, or none where turns do not agree
lenscalc bench double-gauss --degree 3 --rays 12 --columns model,seconds,time_us,pareto --csv 2> said |
    awk -F, 'NR > 1 && $2 != "" && ($2 <= 0 || $2 > 1 || $3 < 999999 * $2) { print "bad " $0 }'
grep -v "the machine is busy" said
# what keeps an error: far out fewer do, and all that are exact
lenscalc bench double-gauss --degree 3 --rays 12 --error 10um --csv --columns model,keeps_to_fnumber,keeps_to_field |
    awk -F, '{ print $1, ($2 > 0 ? "somewhere" : $2), ($3 > 0 ? "within" : $3) }' | sort -u
lenscalc bench double-gauss --degree 3 --rays 12 --plot a.svg --columns model,seconds,pareto --csv > rows 2> said
grep -v "the machine is busy" said
grep -c "Time against error" a.svg
echo "refused:"
lenscalc bench double-gauss --error 1kg --columns model; echo "status $?"
lenscalc bench double-gauss --quantity mtf --error 1um --columns model; echo "status $?"
lenscalc bench nikkor-z-14-24 --position all --plot a.svg; echo "status $?"
lenscalc bench; echo "status $?"
lenscalc bench double-gauss --degree 4 --columns model,rms_error,warning --csv | grep poly
lenscalc bench double-gauss --quantity photograph --rays 10; echo "status $?"
lenscalc bench double-gauss --frequency 10; echo "status $?"
printf 'object inf\nfocus afocal\naperture epd 20\nfield angle 1\nsurface 80 6 1.5 - stop\nsurface - 0 air -\n' > a.lens
lenscalc bench a.lens; echo "status $?"
lenscalc bench cooke-anamorphic-bad --degree 3 --csv --columns model,warning | head -n 9
