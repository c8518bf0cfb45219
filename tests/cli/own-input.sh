# what a command reads is not written over unless --force says so, and rows never feed themselves
printf 'f,N,s\n50,2.8,3\n' > c.csv
kept() { cp "$1" "$1.before"; shift; "$@"; echo $?; for file in *.before; do cmp "${file%.before}" "$file" && rm "$file"; done; }
kept c.csv lenscalc dof --batch c.csv --csv -o c.csv
kept c.csv lenscalc dof --batch - --csv -o c.csv < c.csv
ln c.csv hard.csv
ln -s c.csv soft.csv
kept c.csv lenscalc dof --batch c.csv --csv -o hard.csv
kept c.csv lenscalc dof --batch soft.csv --columns '?' -o ./c.csv
ulimit -f 100
lenscalc dof --batch c.csv --csv >> c.csv
echo $?
lenscalc dof --batch - --csv < c.csv >> c.csv
echo $?
lenscalc dof --batch c.csv --csv --columns dof 1<> c.csv
echo $?
wc -l c.csv
lenscalc convert double-gauss-50 -o mine.lens 2> /dev/null
kept mine.lens lenscalc convert mine.lens --focal-length 20mm -o mine.lens
kept mine.lens lenscalc lens double-gauss-50 mine.lens -o mine.lens
kept mine.lens lenscalc spot --lens mine.lens -o mine.lens
lenscalc convert mine.lens --focal-length 20mm -o mine.lens --force
lenscalc lens mine.lens --columns efl
lenscalc render chart:wedge --lens mine.lens -s 2m --size 12x8 --samples 4 -o w-1.png 2> /dev/null
kept w-1.png lenscalc tone w-1.png=1/8 -o w-1.png
kept w-1.png lenscalc render w-1.png --lens mine.lens -s 2m --size 12x8 --samples 4 -o w-1.png
cat > own.scene << END
camera at=0,0,5 look=0,0,0 focus=5
light sky uniform luminance=100
material cloth lambert texture=w-1.png
card at=0,0,0 size=1,1 material=cloth
END
film='--lens double-gauss-50 --size 6x4 --samples 1 --bounces 0'
kept w-1.png lenscalc render own.scene $film -t 1/9 -o w-1.png
kept w-1.png lenscalc render own.scene $film -t 1/9,1/30 -o w.png
kept own.scene lenscalc render own.scene $film -t 1/9 -o own.scene
lenscalc render own.scene $film -t 1/9 -o w-1.png --force 2> /dev/null; echo $?
# a frame is given once
ln w-1.png same.png
lenscalc tone w-1.png w-1.png -o y.hdr
lenscalc tone w-1.png=1/8 same.png=1/4 -o y.hdr
# rows of a file beside it, or into it when they are done
lenscalc dof --batch c.csv --csv --columns f,dof -o new.csv
lenscalc dof --batch c.csv --csv --columns f,dof -o c.csv --force
cat c.csv
ls
# a lens of lensdb, or of the user's, is read before a file of its name is
lenscalc lens double-gauss --columns efl -o double-gauss; echo $?
lenscalc lens double-gauss --columns efl -o double-gauss; echo $?
mkdir -p own/lenses
lenscalc convert double-gauss-50 -o own/lenses/mine.lens 2> /dev/null
lenscalc lens mine --lensdb own -o own/lenses/mine.lens; echo $?
lenscalc lens mine --lensdb own --columns efl -o mine; lenscalc lens mine --lensdb own --columns efl -o mine; echo $?
