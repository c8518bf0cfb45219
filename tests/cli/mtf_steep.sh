# contrast behind wave fronts of hundreds of waves, whose sums have an end; of one that no sums can take
lenscalc mtf edmund-49-847 -w d --field 0 --frequency 40 --csv --digits 3 --columns frequency,tangential,sagittal,limit
lenscalc mtf cooke-anamorphic-bad -w d --field 0 --frequency 40 --csv --digits 3 --columns frequency,tangential,sagittal,limit,warning
lenscalc mtf cooke-anamorphic-bad -w d --field 0 --frequency 40 --plot steep.svg
