# fields whose bundle folds over itself, where edges enclose no area; names of rays by their pupil
lenscalc pupil edmund-achromat-120 --field 50,55,60 --csv --digits 8 --columns field,pupil,x_max,y_min,y_max,y,area_mm2,fraction
lenscalc pupil edmund-achromat-120 --field 60 --side exit --digits 5
lenscalc trace double-gauss --field 14 --pupil-x 0.5 --pupil-y 0.5 --csv --columns ray,pupil_x,pupil_y,status
lenscalc trace double-gauss --field 14 --pupil-point 0.5:0.5 --csv --columns ray,pupil_x,pupil_y,status
lenscalc trace edmund-achromat-120 --field 60 --pattern hexapolar --rays 20 --csv --columns status,warning | sort | uniq -c | sed 's/^ *//'
lenscalc trace edmund-achromat-120 --field 40 --pattern hexapolar --rays 20 --csv --columns status,warning | sort | uniq -c | sed 's/^ *//'
lenscalc pupil double-gauss --field 5..85:5 --csv --side entrance --columns field | tr '\n' ' '
