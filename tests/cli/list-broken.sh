# a folder of the user's own in which not all is a lens: the rest is listed, and nobody waits at a pipe
mkdir -p own/lenses/folder.lens
printf 'lens Good\naperture epd 10\nsurface 50 5 1.5 20\nsurface - 100 air 20\n' > own/lenses/good.lens
printf 'lens Broken\nsurface x\n' > own/lenses/broken.lens
: > own/lenses/empty.lens
mkfifo own/lenses/pipe.lens
ln -s nowhere own/lenses/gone.lens
lenscalc list lenses --lensdb own --csv --columns lens,efl_mm,surfaces,warning | head -7
lenscalc list lenses broken --lensdb own
lenscalc list lenses good --lensdb own --columns lens,efl_mm
lenscalc list lenses --kind zoom --lensdb own --columns lens --csv > zooms.csv; echo "status $?"
for name in pipe gone folder; do lenscalc lens $name --lensdb own; done
mkfifo own/formats.tsv
lenscalc dof -f 50 -N 4 -s 3 --lensdb own
