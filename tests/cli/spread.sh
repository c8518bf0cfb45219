# images of lines and edges: widths, offsets, fields, spectra, drawings, refusals
lenscalc spread double-gauss -N 8
lenscalc spread double-gauss -N 8 --field 14 --offset -4..4:4 --csv --digits 4
lenscalc spread double-gauss -N 8 --field 0 --spectrum d:1,F:0.5 --json --digits 3
lenscalc spread double-gauss -N 8 --field 0,80 --csv --digits 3 --columns field,line_width_tangential,warning
lenscalc spread double-gauss -N 8 --field 0 -w d --defocus -0.1,0,0.1 --columns defocus,line_width_tangential,edge_width_sagittal
lenscalc spread questar-35 -w d --field 0 --offset 5um --value edge_tangential --digits 4
telescope='lens telescope\nobject inf\naperture epd 10\nfield angle 0\nfocus afocal\nsurface 50 0 1.5 - stop\nsurface - 150 air -\nsurface - 0 1.5 -\nsurface -25 10 air -\n'
printf "$telescope" | lenscalc spread -
lenscalc spread double-gauss -N 8 --offset 2deg
lenscalc spread double-gauss -N 8 --offset 1m --field 0 -w d
lenscalc spread double-gauss -N 8 --draw edge
lenscalc spread fisheye-270 --field 0 -w d
lenscalc spread double-gauss -N 8 -w d --plot line.svg > rows && lenscalc spread double-gauss -N 8 -w d --field 0 --draw edge --plot edge.svg > rows
for drawing in line.svg edge.svg; do
    grep -o '>[^<>]*</text>' $drawing | sed 's/^>//; s/<.*//' | grep -v '^[−0-9.]*$'
done
