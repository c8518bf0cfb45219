# --scale and --plot write whole, well-formed SVG
lenscalc dof -f 50mm -N 5.6 -s 3m --scale scale.svg --csv --columns near_m --digits 6
lenscalc dof -f 50mm -N 5.6 -s 1..10 --plot plot.svg --csv --columns near_m,far_m --digits 4
lenscalc hyperfocal -f 24,50 -N 2.8..16 --plot two.svg --csv --columns hyperfocal_m --digits 4
lenscalc fov -f 14..200 --plot fov.svg > table
for drawing in scale.svg plot.svg two.svg fov.svg; do
    python3 - $drawing <<'END'
import sys, xml.etree.ElementTree as tree
root = tree.parse(sys.argv[1]).getroot()
texts = [e for e in root.iter() if e.tag.endswith("text")]
lines = [e for e in root.iter() if e.tag.rsplit("}")[-1] in ("line", "path", "polyline")]
print(sys.argv[1], root.tag, "texts" if len(texts) > 4 else "NO TEXTS",
      "lines" if lines else "NO LINES")
END
done
ls
# f-numbers have marks of their own, and a subtitle stands there whole
lenscalc dof -f 50mm -N 2.8..16#10 -s 3m --plot ticks.svg > table
grep -oE '>f/5.6<' ticks.svg
lenscalc pupil double-gauss --plot pupils.svg > table
grep -o '…' pupils.svg || echo whole
