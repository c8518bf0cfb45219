# a drawing says what was given and does not change
lenscalc exposure -N 1.4..22 --ev 12 --iso 100,400 --plot ev.svg > /dev/null && grep -o '>EV at[^<]*<' ev.svg
lenscalc exposure -t 1/1000..1/2 -N 5.6 --plot time.svg > /dev/null && grep -o '>f-number[^<]*<' time.svg
lenscalc projector --throw 1.5 -s 2m..10m:2 --plot throw.svg > /dev/null && grep -o '>throw ratio[^<]*<' throw.svg
