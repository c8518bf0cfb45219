# options that would do nothing are refused, and so are rows with other columns than the first
say() { lenscalc "$@"; echo "status $?"; }
exec 2>&1
dof='dof -f 50 -N 4 -s 3 --csv --columns coc --digits 4'
say $dof --print 30in --viewing 1m
say $dof --coc print --print 30in --viewing 1m
say $dof --coc d/1500,print --print 30in
say $dof --acuity 7 --coc 0.03
say $dof --pitch 5um
say $dof --pitch 5um --coc 2px
printf 'c,s\nprint,3\nd/1500,3\n' | lenscalc dof -f 50 -N 4 --print 30in --batch - --csv --columns coc --digits 4
say stars -f 24 -N 2.8 --pitch 5um --csv --columns npf_s --digits 4
say stars -f 24 -N 2.8 --trail print --print 30in --csv --columns exact_s --digits 4
say dof -f 100 -N 8 --near 30cm --far 33cm --overlap 0.3
say fit double-gauss --vary R1
say draw double-gauss --csv
say draw double-gauss --columns x
say draw double-gauss --batch rows.csv
say draw double-gauss --table N,w
say list formats --batch rows.csv
say list formats --units imperial
say help --explain
say help --batch_format csv
say completion bash --lensdb .
say fov -f 50 --nominal
say check double-gauss --table N,w
say bracket --from 30s --to 1s..8s --plot plot.svg
say lens double-gauss -N 2,4 --plot plot.svg
say lens double-gauss -N 2,4 -w d --plot plot.svg --columns bfl > /dev/null
say list formats,cameras
say fit double-gauss --show answer,parameters
ls
