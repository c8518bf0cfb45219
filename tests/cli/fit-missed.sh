# a goal that is missed is said, whatever the format, and is no success
say() { lenscalc "$@"; echo "status $?"; }
exec 2>&1
say fit double-gauss --prescription efl=-100 --vary R1 -o turned.lens
say fit double-gauss --prescription efl=101,bfl=72.5 --vary R1
say fit double-gauss --prescription efl=101:2,bfl=72.5:2 --vary R1
say fit double-gauss --prescription efl=101,bfl=72.5 --vary R1 --json
say fit double-gauss --prescription efl=101,bfl=72.5 --vary R1 --csv --columns goal,off_mm,warning
say fit double-gauss --prescription efl=101,bfl=72.5 --vary R1 --show parameters -o missed.lens
grep note missed.lens
say fit double-gauss --prescription efl=50 --vary 't5[11,12]'
say fit double-gauss --prescription efl=0 --vary R1
say fit double-gauss --prescription length=40 --vary t2
