# columns by name, in other spelling, by label, symbol, letter or name of the option; and lists of them
dof() {
    lenscalc dof -f 50 -N 4,8 -s 3 -c 0.03 --csv --digits 5 "$@" || echo "status $?"
}
dof --columns N,s,near
dof --columns aperture,focal-length,distance
dof --columns 'Near Limit,far-limit,Depth_of_Field,H'
dof --columns near_limit_ft,FAR_M
lenscalc flash -g 36 -s 3 --columns 'guide number,f-number' --csv
lenscalc exposure --ev 12 -N 8 --columns 't,EV at ISO 100,time-ms' --csv
dof --columns limit
dof --columns blur
dof --columns sharpness
dof --columns hyperfocal_s
lenscalc dof -f 50 -N 4,8 -s 3,4 -c 0.03 --table N,s:H --csv --digits 5
lenscalc dof -f 50 -N 4,8 -s 3,4 -c 0.03 --table N,s:limit
lenscalc refract --columns '?'
lenscalc matrix --columns '?' --csv | tail -3
lenscalc draw --columns '?'
lenscalc list columns conjugate image --columns column,unit,label
lenscalc list columns dof nowhere
# every column of every command has a meaning
lenscalc list columns --jsonl | grep -c '"meaning":null'
# words of the trade for options
lenscalc dof -f 50 --fnumber 8 -s 3
lenscalc exposure --metered 1/125 --nd 10
lenscalc exposure --shutter-speed 1/125
# labels that two columns of a command share, so that neither answers to it
lenscalc list columns --tsv --columns command,label,column | sed 's/_\(um\|mm\|mrad\|deg\|per_m\|m\|diopter\)$//' | sort -u | cut -f 1,2 | uniq -d
# of both forms of a column its label means the first
lenscalc spot double-gauss --columns 'RMS in x,RMS in x mrad' --field 0 -w d --csv --digits 3
lenscalc wavefront --columns '?' | grep '^rays '
