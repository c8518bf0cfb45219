# a lens whose source states a T-stop: shown by dof and exposure, kept in every format
lenscalc convert double-gauss | sed 's/^stated fnumber.*/&\nstated tstop 2.3/' > cine.lens
lenscalc dof --lens cine.lens -N 4 -s 3m --columns fnumber,t_stop,working_fnumber,working_t_stop
lenscalc dof --lens cine.lens -s 3m --t-stop 2.5 --csv --columns fnumber,t_stop --digits 6
lenscalc dof --lens cine.lens -s 3m --converter 2x -N 4 --csv --columns t_stop,working_t_stop --digits 6
lenscalc exposure --lens cine.lens --ev 12 --csv --columns time_s,transmittance,t_stop,loss_stops --digits 6
lenscalc exposure --lens cine.lens --ev 12 --transmittance 0.9 --csv --columns t_stop --digits 6
lenscalc exposure --lens cine.lens --ev 12 -N 4 --t-stop 4.4 --csv --columns t_stop --digits 6
for type in zmx seq len json; do
    lenscalc convert cine.lens --to $type > cine.$type
    lenscalc convert cine.$type | grep tstop
done
lenscalc convert cine.lens --scale 2 | grep stated
lenscalc dof --lens double-gauss -s 3m --csv --columns t_stop
sed 's/tstop 2.3/tstop 1.8/' cine.lens > bad.lens
lenscalc dof --lens bad.lens -s 3m
echo "status $?"
sed 's/tstop 2.3/tstop/' cine.lens | lenscalc dof --lens - -s 3m
echo "status $?"
sed 's/tstop 2.3/tspot 2.3/' cine.lens | lenscalc dof --lens - -s 3m
echo "status $?"
