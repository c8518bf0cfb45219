# folders with what is no file, what leads around, and what cannot be read: nobody waits or gives up
singlet() { printf 'lens %s\naperture epd 10\nsurface 50 5 1.5 20\nsurface - 100 air 20\n' "$1"; }
say() { timeout 20 lenscalc "$@"; echo "status $?"; }
# links that lead back: each folder is read once
mkdir -p loop/sub
singlet Once > loop/once.lens
singlet Deep > loop/sub/deep.lens
ln -s . loop/sub/self; ln -s .. loop/sub/self2; ln -s sub loop/sub2
say convert --check --files loop --csv --columns file,status
# a pipe in a folder is a row; one that the user names is read
mkdir pipes; singlet Plain > pipes/plain.lens; mkfifo pipes/pipe.lens pipes/pipe.txt
say convert --check --files pipes --csv --columns file,status,reasons
singlet Named > pipes/pipe.lens &
say convert --check --files pipes/pipe.lens --csv --columns file,status,reasons
# a folder whose path is too long to be opened: a row, and the rest
mkdir deep; singlet Top > deep/top.lens
long=$(printf '%0240d' 0)
(cd deep && for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18; do mkdir $long && cd -P $long; done)
say convert --check --files deep --csv --columns file,status,reasons | sed 's/0000[0/]*0/~/g'
# the user's lenses: the ending as it is
mkdir -p own/lenses own/glass
singlet Upper > own/lenses/UPPER.LENS
singlet 'by itself' > own/lenses/a-b.lens; singlet other > own/lenses/ab.lens
lenscalc list lenses --lensdb own --csv --columns lens,title,efl_mm | head -4
lenscalc lens upper --lensdb own --csv --columns efl_mm
lenscalc convert ab --lensdb own | head -1; lenscalc convert a_b --lensdb own | head -1
# and glasses: what is no file is said once, and the rest is used
printf 'CC mine\nNM MINE 1 0 1.5 60 0 0 0\nCD 2.25 0 0 0 0 0\nLD 0.4 0.7\n' > own/glass/mine.agf
mkdir own/glass/D.agf own/glass/T.tsv; mkfifo own/glass/pipe.agf own/glass/pipe.tsv
ln -s nowhere own/glass/gone.agf
say glass MINE --lensdb own --csv --columns glass,index
say glass N-BK7 --lensdb own --csv --columns glass,nd
say list glasses MINE --lensdb own --csv --columns glass
