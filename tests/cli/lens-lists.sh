# several lenses, lists and ranges of wavelengths
lenscalc lens double-gauss wide-35 telephoto-200 -w d
lenscalc lens double-gauss wide-35 -w d --csv --columns lens,efl_mm
lenscalc lens --lens double-gauss wide-35 -w d,F --columns wavelength_nm,efl_mm,lens
lenscalc lens double-gauss -w 450,0.55um,C --columns wavelength_nm,bfl_mm --csv
lenscalc lens double-gauss -w 400..700:100 --columns wavelength_nm,bfl_mm --csv
lenscalc lens double-gauss -w 0.4um..0.7um#3 --columns wavelength_nm,bfl_mm --csv
lenscalc lens double-gauss -w d --field 0,7deg,14deg -N 2,4 --columns fnumber,lagrange_mm --csv
lenscalc lens double-gauss wide-35 -w 400..700#7 --plot shift.svg > /dev/null && grep -o "Back focal distance[^<]*<" shift.svg
lenscalc lens double-gauss wide-35 -w d,F --table lens,wavelength:bfl_mm
printf 'lens,wavelength_nm\ndouble-gauss,450\nwide-35,650\n' | lenscalc lens --batch - --columns efl_mm --csv
lenscalc lens double-gauss -w 400..
lenscalc lens double-gauss -w 0..700:100
lenscalc lens double-gauss no-such-lens
lenscalc draw double-gauss wide-35
lenscalc draw double-gauss -w d,F
