# one lens: forwards, each unknown, two solutions, the file, and what is refused
lenscalc lensmaker --r1 50 --r2 -50 -n 1.5 -d 6
lenscalc lensmaker --r1 50 --r2 -50 -n 1.5 -d 6 --before 1.333 --json --digits 9
echo "solved:"
lenscalc lensmaker -f 100 --shape 1 -n 1.5 --csv --columns radius_1,radius_2
lenscalc lensmaker -f 100 --r1 60 -n 1.5 -d 6 --csv --digits 9 --columns radius_2,shape
lenscalc lensmaker -f 100 --r2 -60 -n 1.5 -d 6 --csv --digits 9 --columns radius_1
lenscalc lensmaker -f 50 --r1 50 --r2 -50 --csv --columns index
lenscalc lensmaker --r1 60 --r2 40 -n 1.5 -f inf --csv --columns thickness,power,bfl
lenscalc lensmaker --r1 50 -q 0.5 -n 1.5 --csv --digits 9 --columns radius_2,focal
lenscalc lensmaker --ball -d 10 -n 1.5 --csv --digits 9 --columns focal,bfl
lenscalc lensmaker --ball -f 7.5 -n 1.5 --csv --digits 9 --columns thickness
lenscalc lensmaker -f 100 -q 0.3 -n 1.5 -d 8 --solution first,second
lenscalc lensmaker --r1 50 --r2 50 -n 1.5 --columns focal,shape,power
lenscalc lensmaker --r1 inf --r2 inf -n 1.5 -d 5 --csv
lenscalc lensmaker -f 100 --r1 60 -n 1.5 -d 6 --before 1.333 --lens-file s.lens -o answer
cat s.lens
exec 2>&1
lenscalc lensmaker -f 100 --r1 60,70 -n 1.5 --lens-file t.lens
lenscalc lensmaker --r1 50 --r2 -50
lenscalc lensmaker --r1 50 --r2 -50 -n 1.5 -d 1 -f 50
lenscalc lensmaker --r1 50 --r2 -50 -n 1.5 -q 0
lenscalc lensmaker --r1 50 --r2 -50 -n 1.5 -f 40
lenscalc lensmaker --r1 50 --r2 -50 -f -80
lenscalc lensmaker -f 19.9 -q 0 -n 1.5 -d 30
lenscalc lensmaker -f 100 -q 0 -n 1.5 --solution second
lenscalc lensmaker -f 0 -q 0 -n 1.5
lenscalc lensmaker --r1 50 -f 80 -n 1
lenscalc lensmaker --r1 50 --r2 -50 -n 1.5 -d -1
lenscalc lensmaker --ball -d 10 -n 1.5 --r1 5
lenscalc lensmaker --ball -d 10
ls
# a focal length that is drawn is none of the title
lenscalc lensmaker --r1 20..200:20 --r2 -100 --thickness 5 --index 1.5 --plot focal.svg > /dev/null &&
    grep -o '>Focal length of[^<]*<\|>second radius[^<]*<' focal.svg
