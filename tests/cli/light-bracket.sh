# brackets between two times, around one, for a scene
lenscalc bracket --from 30s --to 1/1000s
lenscalc bracket --from 30s --to 1/1000s --nominal --csv --digits 6 | sed -n '1,2p;$p'
lenscalc bracket --to 1/1000s --shots 16 --step 1 --csv --digits 6 | sed -n '1,2p;$p'
lenscalc bracket --from 1/4 --to 1/4000 --shots 6 --json --digits 4 --columns shot,time,step
lenscalc bracket -t 1/60 --shots 5 --step 2/3
lenscalc bracket -t 1/60 --scene-range 18 --range 10 --step 2 --explain
