# time-lapse and star trails: what is missing is solved for, what contradicts is refused
lenscalc timelapse --event 2h --clip 20s
lenscalc timelapse --event 1h --interval 5s --frame-size 25MB --card 16GB --explain
lenscalc timelapse --clip 10s --interval 4s --frame-rate 30 -t 2s
lenscalc timelapse -t 30s --star-angle 30deg -f 20mm --pitch 4.3um --explain
lenscalc timelapse --clip 5min --frame-rate 24 --frame-size 12MB --card 512GB --json
lenscalc timelapse --event 30min,1h,2h,4h --clip 10s,20s,30s --table event,clip:interval
lenscalc timelapse --card 64GiB --frame-size 40MiB --csv
lenscalc timelapse --event 3h -t 30s,60s --gap 0,2s
# intervals and clips are no settings of a camera: no labels, with --nominal or between ends
lenscalc timelapse --event 1h --interval 5..8 -t 1/60 --nominal --columns interval,shots,time
printf 'event_min,interval\n60,5\n60,\n' | lenscalc timelapse --batch - --csv --columns shots,error
echo "status $?"
for wrong in "" "--event 1h" "--event 1h --interval 5 --shots 100" "--interval 5 -t 5 --shots 10" \
    "--shots 2.5" "--event 5s --interval 10s" "--card 64GB --shots 5" "--card 1MB --frame-size 2MB" \
    "--event 1h --interval 5 --clip 30 --frame-rate 30" "--shots 5 -f 20" "--star-angle 30deg" \
    "--shots 5 -t 3 --declination 10deg" "--shots 5 --gap 3" "--frame-size 5m --shots 3"; do
    lenscalc timelapse $wrong
    echo "status $?"
done
