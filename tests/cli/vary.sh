# --vary and marks, as fit reads them
say() {
    lenscalc fit "$@" > out; echo "status $?"
}
cat > four.lens <<'END'
lens parts
pickup R4 = -R3
surface 50 3 1.5/60 20
surface -50 2 air 20
surface 70 5 1.6 20
surface -70 3 air 20
surface - 2 air 20
END
fit() {
    lenscalc fit four.lens --prescription efl=95,bfl=90,length=10 --show parameters \
        --columns parameter --csv --vary "$1" 2> err | tail -n +2 | tr '\n' ' ' | grep . || cat err
}
fit R1,R2
fit R1..R2
fit R1..2
fit 'R1..R2[-90,-20],R1[20,90]'
fit 'all-t[1mm,1cm]'
fit t1..t4
fit 'R1[1in,4in],t2[0.1cm,5],n1[1.4,1.6]'
fit 'R1[inf,-20]'
fit 'R1[20,inf],all-n'
fit 'R1[20,-inf]'
fit 'R1[40,-100],t2'
fit 'R1[-10,100]'
fit R3
fit all-R
for part in R1,R1 R1,R1..R2 all-Q R2..R1 R1..t2 R1..R9 R5..R5 'R1[2,3deg]' 'R1[2' 'R1[2,3,4]' c1 all-k t1@wide; do
    say four.lens --prescription efl=80 --vary "$part"
done
