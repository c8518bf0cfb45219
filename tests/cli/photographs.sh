# what exiftool writes is read as it is: -csv, -json, -json with one object a line
cat > tags.csv <<'END'
SourceFile,FocalLength,FNumber,FocusDistance,SubjectDistance,ExposureTime,ISO,Model,LensModel
a.jpg,50.0 mm,2.8,3.2 m,undef,1/125,100,NIKON D750,AF-S 50mm f/1.8
b.jpg,85.0 mm,1.8,inf,inf,1/500,200,NIKON D1,"X, Y"
c.jpg,24.0 mm,8.0,undef,undef,0.5,200,NIKON D1,
d.jpg,24.0 mm,8.0,2 m,2 m,0.5,200,NIKON D99999,
END
cat > tags.json <<'END'
[{
  "SourceFile": "a.jpg",
  "FocalLength": "50.0 mm",
  "FNumber": 2.8,
  "FocusDistance": "3.2 m",
  "Model": "NIKON D750"
},
{
  "SourceFile": "b {x} \"y\".jpg",
  "FocalLength": "85.0 mm",
  "FNumber": 1.8,
  "FocusDistance": "inf",
  "Model": "NIKON D1"
},
{
  "SourceFile": "c.jpg",
  "FocalLength": "85.0 nn",
  "FNumber": 1.8,
  "FocusDistance": "3 m",
  "Model": "NIKON D1"
}]
END
lenscalc dof --batch tags.csv --columns near,far --csv --digits 6
echo "status $?"
lenscalc dof --batch - --columns near,far --csv --digits 6 < tags.json
echo "status $?"
# what an option says is not asked of the photographs
lenscalc dof --sensor 35mm --batch tags.csv --columns near --csv --digits 6
lenscalc exposure --batch tags.csv --columns ev100 --csv --digits 6
lenscalc fov --batch tags.csv --columns horizontal --csv --digits 6 --sensor 35mm
# names ignore case, '_' and '-'
printf 'Focal-Length_mm,APERTURE,DISTANCE\n50,2.8,3\n' |
    lenscalc dof --batch - --columns near --csv --digits 6
printf 'n,N,f,s\nfirst,2.8,50,3\n' | lenscalc dof --batch - --columns near --csv --digits 6
# several objects of one line; what is no array of objects
echo '[{"f":50,"N":2.8,"s":3},{"f":50,"N":4,"s":3}]' |
    lenscalc dof --batch - --columns near --jsonl --digits 6
for text in '[]' '[1,2]' '[{"f":50,"N":2.8,"s":3}' '[{"f":50,"N":2.8,"s":' \
    '[{"f":50,"N":2.8,"s":3},{"f":50,"N":2.8,"t":3}]'; do
    echo "$text" | lenscalc dof --batch - --columns near --csv --digits 6
    echo "status $?"
done
