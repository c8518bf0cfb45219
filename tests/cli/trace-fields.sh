# a field whose chief ray is lost and others pass; points of the pupil in a batch; ends of the range
printf 'lens ended\nobject inf\naperture stop\nsurface - 5.655 1.587 -\nsurface 29.78 2.568 1.871 -\nsurface -27.02 0.5335 1 -\nsurface - 6.104 1.845 -\nsurface 16.57 8.852 1.799 -\nsurface -11.44 0.7117 1 -\nsurface -9.474 2.175 1.767 -\nsurface -24.03 3.539 1 -\nstop - 8.878 1 4.146\nsurface 9.747 6.879 1 -\n' > ended.lens
lenscalc trace ended.lens --field 12
lenscalc trace ended.lens --field 12 --csv --digits 8 --columns ray,pupil_x,pupil_y,status,surface
lenscalc trace ended.lens --field 12 --pupil-point 0:0.95 --csv --digits 8 --columns pupil_x,pupil_y,y_out_mm,status
lenscalc trace ended.lens --field 12 --pupil-point 0:0 --csv --columns pupil_x,pupil_y,y_out_mm,status
lenscalc trace ended.lens --field 40
lenscalc pupil ended.lens --field 12 --side entrance --csv --digits 8 --columns field,projected_mm2,status
printf 'field,pupil_x,pupil_y\n0,0,0.5\n10,0.2,-0.1\n10,1,\n' > points.csv
lenscalc trace double-gauss --batch points.csv --csv --digits 8 --columns field,pupil_x,pupil_y,y_out_mm,status
lenscalc trace double-gauss --field 10 --pupil-point 0.2:-0.1 --csv --digits 8 --columns y_out_mm
lenscalc trace double-gauss --field 10 --pupil-point 0.2:-0.1 --pupil-x 0 --pupil-y 0
lenscalc trace double-gauss --field 10 --pupil-x 0
lenscalc trace double-gauss --field 180
lenscalc check double-gauss --field -180
lenscalc pupil double-gauss --field 180
lenscalc pupil double-gauss --field 17 --side exit --csv --columns field
