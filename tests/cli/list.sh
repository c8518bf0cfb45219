# the data, for programs
lenscalc list formats 35mm --csv --columns format,width_mm,height_mm,crop_factor --digits 6
lenscalc list cameras nikon d1 --csv --digits 6
lenscalc list stops --kind full --csv --columns quantity,label,exact --digits 6 | sed -n 8,12p
lenscalc list units --kind length --csv --columns dimension,unit,spellings
lenscalc list commands --csv | sed -n 1,2p
lenscalc list options --kind hyperfocal --tsv --columns option,letter,unit,range,default
lenscalc list formats no-such-thing
echo "status $?"
lenscalc list nothing
echo "status $?"
