# exposure: every unknown, scenes, filters, shutters, nominal labels, films by two sources
csv() {
    echo "[$*]"
    lenscalc exposure "$@" --csv --digits 6
}
one() {
    columns=$1
    shift
    echo "[$*]" $(lenscalc exposure "$@" --csv --digits 6 --columns "$columns" | tail -n +2)
}
lenscalc exposure --scene sunny-16 -N 16
csv -N 8 --ev 12
csv -t 1/60 --ev 12 --iso 400
csv -N 8 -t 1/60
one iso -N 8 -t 1/60 --ev 14
one deviation -N 8 -t 1/125 --iso 400 --ev 12
one ev100,luminance_fL,illuminance_fc -N 8 -t 1/60 --meter-k 14
one time,nominal_time,loss -N 8 --ev 12 --filter ND8
one time,nominal_time,loss -N 8 --ev 12 --filter "ND0.9 + 3stops+2x+polarizer-b+w-low"
one time,loss,t_stop -N 8 --ev 12 --transmittance 80%
one time,loss,transmittance -N 2 --ev 8 --t-stop 2.3
one time,loss -N 8 --ev 12 -m 1:1
one fnumber,time,shutter_angle --shutter-angle 180deg --frame-rate 24 --ev 10
one shutter_angle -t 1/50 --frame-rate 25 --ev 10
one exposure,lens_q -N 8 -t 1/125 --focal-plane
one av,tv,sv,bv,ev_set -N 8 -t 1/64 --iso 400
for film in "HP5 Plus" "HP5 Plus (Gainer)" "kodak tmax 400" "T-Max 400 (photocalcs)"; do
    one time,corrected_time,reciprocity_stops,film,film_source -t 10s --film "$film"
done
one time,corrected_time --corrected-time 50s --film "tri-x 400"
lenscalc exposure --ev 9 -N 2.8..8 --iso 100..800 --table N,iso:nominal_time
lenscalc exposure -N 5.6,8 -t 1/60,1/125 --table N,t
printf 'N,t,iso,ev\n8,1/60,,\n8,,400,12\n,1/60,100,12\n8,1/125,400,12\n8,0,,\n' |
    lenscalc exposure --batch - --csv --digits 6 --columns fnumber,time,iso,ev100,deviation,error
