# weights integrate over the whole pupil; where clear apertures stop rays the output says so
lenscalc trace double-gauss --field 0deg --pattern gauss --rays 3 --columns pupil_x,pupil_y,weight,status
lenscalc trace double-gauss --field 14deg --pattern gauss --rays 3 --columns pupil_x,pupil_y,weight,status
lenscalc trace double-gauss --field 14deg --pattern gauss --rays 3 --jsonl --columns weight,status,warning
lenscalc trace double-gauss --field 14deg --pattern gauss --rays 3 --no-clip --csv --columns weight,status,warning
lenscalc trace double-gauss --field 14deg --pattern sobol --rays 3 --csv --columns weight,status,warning
lenscalc trace double-gauss --field 14deg --pattern gauss --rays 3 --to 2 --csv --columns weight,status,warning
