# glasses by their indices, and the Abbe diagram
lenscalc glass --nd 1.5..1.52 --vd 66.. --status current
lenscalc glass --like N-BK7 --count 4 --csv --columns catalog,glass,status,difference --digits 3
# what is nearest to an nd, a Vd, both, near one within a range of the other; lists and batches
lenscalc glass --nd 1.517 --vd 64 --status current --count 4
lenscalc glass --nd 1.517 --count 2
lenscalc glass --nd 1.5..1.52 --vd 64 --count 2 --csv --columns glass,catalog,distance --digits 4
lenscalc glass --nd 1.517,1.62 --vd 64 --count 1 --csv --digits 4 \
    --columns nd_wanted,vd_wanted,glass,catalog,distance
lenscalc glass --nd 1.5..1.504,1.7..1.704 --vd 40..60 --status current --csv --columns glass,nd,vd --digits 5
printf 'id,nd,vd\na,1.517,64\nb,1.62,36\nc,0.2,3\nd,1.5..1.504,56..57\n' |
    lenscalc glass --batch - --count 1 --csv --digits 4 \
        --columns glass,catalog,distance,nd_difference,vd_difference
echo "status $?"
lenscalc glass --nd 1.8 --vd 25 --count 1 --status current --explain --columns glass,distance
lenscalc glass --nd 1.8 --count 1 --json --columns glass,nd_wanted,nd_difference,distance --digits 4
lenscalc glass --pgf ..0.5 --csv --columns catalog,glass,pgf --digits 4
lenscalc list glasses n-bk7 --csv
lenscalc glass --catalog schott --status current --abbe abbe.svg --label N-BK7,N-SF6 --csv | wc -l
python3 - <<'END'
import xml.etree.ElementTree as tree
root = tree.parse("abbe.svg").getroot()
marks = [e for e in root.iter() if e.tag.endswith("circle")]
texts = {"".join(e.itertext()) for e in root.iter() if e.tag.endswith("text")}
inside = all(0 < float(e.get("cx")) < 900 and 0 < float(e.get("cy")) < 640 for e in marks)
print(len(marks), inside, {"N-BK7", "N-SF6", "SCHOTT", "Abbe number Vd"} <= texts)
END
# the diagram of what is near to a point has that point, and ticks no finer than tolerances
lenscalc glass --nd 1.517 --vd 64 --count 8 --abbe near.svg --csv --columns glass | wc -l
python3 - <<'END'
import re
import xml.etree.ElementTree as tree
texts = {e.text for e in tree.parse("near.svg").getroot().iter() if e.tag.endswith("text")}
numbers = [text for text in texts if re.fullmatch(r"[\d.]+", text)]
print({"wanted", "E-BK7"} <= texts, max(map(len, numbers)) <= 6)
END
lenscalc glass --nd 1.5..1.52 --count 3
lenscalc glass --nd 1.5..1.52 --vd 60..70 --count 3 --csv
