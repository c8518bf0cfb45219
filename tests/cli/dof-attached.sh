# depth of field through tube, close-up lens, converter; T-stops and anamorphic lenses
lenscalc dof -f 50mm -N 8 --tube 25mm
lenscalc dof -f 100mm -N 8 --close-up 2 -s 40cm --columns combined_focal,combined_fnumber,fnumber
lenscalc dof -f 200mm -N 4 -s 10m --converter 2x,1.4x
lenscalc dof -f 100 -N 8 --tube 50 --near 24cm --far 25cm --stack --csv --columns shot,distance_m
lenscalc dof -f 100 --tube 50 --near 24cm --far 25cm --csv --columns fnumber,distance_m,tube_mm
lenscalc dof -f 50mm -N 2.8 --t-stop 3.1 -s 2m --squeeze 2 --sensor scope --explain
lenscalc dof -f 50mm -N 4 -s 3m --csv --columns tube_mm,t_stop,squeeze,blur_width_mm,lens_focus
lenscalc dof -f 100mm -N 4 --t-stop 4.5 --converter 2x -s 5m --json --columns working_t_stop
lenscalc hyperfocal -f 40mm -N 2.8 --squeeze 2 --sensor scope --explain
printf 'f,N,s,tube\n50,8,0.12,25\n50,8,3,25\n' | lenscalc dof --batch - --columns near_m,error
echo "status $?"
for wrong in "-f 100 -N 8 --close-up 2 -s 60cm" "--converter 2 -N 4 -s 3" "-f 50 --t-stop 3 -s 3" \
    "-f 50 --converter 2 -N 4 -s 3 --from sensor" "-f 50 -N 4 --t-stop 3 -s 3" \
    "-f 50 -N 4 -s 3 --squeeze 0" "-f 100 -N 8 --tube 50 --near 24cm --far 40cm --stack"; do
    lenscalc dof $wrong
    echo "status $?"
done
