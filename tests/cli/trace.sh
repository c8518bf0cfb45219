# exact rays: by field, by point, at every surface, beside the paraxial ones
lenscalc trace double-gauss
lenscalc trace double-gauss --no-clip --field 14deg -w F,C
lenscalc trace double-gauss --point 0:10:-20 --all --focus best
lenscalc trace double-gauss --point 0:2:-20 --direction 0:0.24192:0.97030 --no-clip --paraxial
lenscalc trace double-gauss --x 0 --y 40 --z -20 --json
lenscalc trace double-gauss --field 10deg --pattern fan --rays 10 --csv --digits 6 --columns pupil_x,pupil_y,weight,x_out_mm,y_out_mm,status,surface
lenscalc trace double-gauss --field 0,10deg --pupil-point 0.5:0.5 --aim entrance --to 6
lenscalc trace double-gauss -N 8 --height 20mm --focus 72 --to image
lenscalc trace questar-35 --position all
lenscalc trace fisheye-16
lenscalc trace double-gauss --point 0:10:-20 --explain
lenscalc trace double-gauss --point 0:30:-5 --direction 0:-0.8:0.6 --all --no-clip --csv --digits 6 --columns surface,y_out_mm,path_mm,incidence_deg,refraction_deg,status
lenscalc trace cooke-triplet-50 --pupil-point 0:0.5
lenscalc trace nikkor-z-14-24 --position wide,tele --field 0
lenscalc trace double-gauss --no-clip --field 0..14deg:7 --pupil-point 0:0.5 --plot trace.svg > /dev/null && grep -c '<poly\|<path' trace.svg
