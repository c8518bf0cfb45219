# a filled cell wins over the option, an empty one takes it, whatever the column is called
for name in N aperture fnumber f-number FNumber EXIF:FNumber; do
    printf "$name,note\n8,a\n,b\n" | lenscalc dof -f 50 -N 2 -s 2m --batch - --csv --columns fnumber
done
printf '{"SubjectDistance":"5 m"}\n{"SubjectDistance":null}\n{}\n' |
    lenscalc dof -f 50 -N 2 -s 2m --batch - --csv --columns distance
# no distance, by any word for that, and a camera or none
cat > a.csv <<'END'
SourceFile,Model,FocalLength,FNumber,Aperture,SubjectDistance,FocusDistance,Lens,DOF
a.jpg,NIKON D1,50.0 mm,8.0,8.0,5 m,5.0 m,24-70mm f/2.8,1.25 m (2.02 - 3.27 m)
b.jpg,,50.0 mm,8.0,,0 m,undef,,
c.jpg,,50.0 mm,8.0,5.6,,-,,
d.jpg,,50.0 mm,,5.6,3 m,2 m,,
END
lenscalc dof --batch a.csv -s 3m --sensor dx --csv --columns fnumber,distance,coc,error
echo "status $?"
# groups: the photograph's own tag counts, the maker's is handed through
printf '%s\n' 'EXIF:ExifIFD:ExposureTime,Canon:ExposureTime,IFD1:Model,Composite:ShutterSpeed' \
    '1/125,1/128,none,0.008' '0.5,1,none,1' |
    lenscalc exposure -N 8 --batch - --csv --columns time,ev
echo "status $?"
# units in brackets, decimal commas between semicolons
printf 'Focal Length (mm)\tf-number\tDistance [ft]\n50\t8\t10\n' |
    lenscalc dof --batch - --csv --columns focal,fnumber,distance_ft
printf 'Distance (kg)\n3\n' | lenscalc dof -f 50 -N 2 --batch -
echo "status $?"
printf 'file.name;"f";N;s\na.b;50;"2,8";3,5\na;50;2.8;3\nb;50;1.234,5;3\n' |
    lenscalc dof --batch - --csv --columns fnumber,distance,error
echo "status $?"
printf 'f;N;s\n50;2.8;3\n50;2,8;3\n' | lenscalc dof --batch - --csv --columns fnumber,error
echo "status $?"
printf 'f\tN\ts\n50\t2,8\t3\n' | lenscalc dof --batch - --csv --columns fnumber,error
echo "status $?"
# a companion and its column
printf 'distance_is_infinite,distance_m\ntrue,\nfalse,3\nfalse,\ntrue,3\n' |
    lenscalc dof -f 50 -N 8 -s 5 --batch - --csv --columns distance,error
echo "status $?"
# what rows lack is said once, with what is known and the option that says it
{
    echo SourceFile,FocalLength,FNumber,SubjectDistance
    for i in 1 2 3 4; do echo "$i.jpg,50.0 mm,2.8,"; done
    echo 5.jpg,,2.8,3
    echo 6.jpg,50.0 mm,2.8,3
} > lacking.csv
lenscalc dof --batch lacking.csv --csv --columns near
echo "status $?"
lenscalc dof --batch lacking.csv -s 3m -f 50 --csv --columns near --digits 6
echo "status $?"
# no column is known
printf 'a,b\n1,2\n3,4\n5,6\n' > unknown.csv
for words in 'dof -f 50' exposure 'trace' refract; do
    lenscalc $words --batch unknown.csv --csv
    echo "status $?"
done
lenscalc dof -f 50 -N 8 -s 3 --batch unknown.csv --csv --columns near --digits 6
echo "status $?"
# keys that only later objects have
printf '{"FNumber":8}\n{"FNumber":4,"Aperture":5.6}\n{"Aperture":5.6}\n{"FNumber":2,"Aperture":2}\n' |
    lenscalc dof -f 50 -s 3 --batch - --jsonl --columns fnumber
echo "status $?"
