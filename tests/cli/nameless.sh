# a lens without a title is called by its file's name, in drawings too
cat > bare.lens <<'LENS'
object inf
aperture f/4
field angle 0 3
wavelength d F C
stop - 0 air -
surface 50 3 1.5168/64.2 -
surface -50 0 air -
LENS
for command in seidel fan spot field distortion illumination wavefront color; do
    lenscalc $command bare.lens --plot $command.svg > /dev/null
    grep -o 'bare.lens' $command.svg | head -1
done
lenscalc field bare.lens bare.lens --plot both.svg --csv --columns field_deg
lenscalc illumination bare.lens --height 0,1 --csv --columns height_mm
