# cross-tables to print, metric and imperial, for people and for programs
for format in text markdown latex html; do
    lenscalc dof -f 50mm -N 2.8..16 -s 1,2,5,10 --table s,N --format $format
    echo "status $?"
done
lenscalc dof -f 50mm -N 2.8..16 -s 1,2,5,10 --table s,N --units imperial
lenscalc hyperfocal -f 24,35,50,85 -N 2.8..22 --table N,f
