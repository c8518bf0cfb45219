# glasses by their indices, and the Abbe diagram
lenscalc glass --nd 1.5..1.52 --vd 66.. --status current
lenscalc glass --like N-BK7 --count 4 --csv --columns catalog,glass,status,difference --digits 3
lenscalc glass --pgf ..0.5 --csv --columns catalog,glass,pgf --digits 4
lenscalc list glasses n-bk7 --csv
lenscalc glass --catalog schott --status current --abbe abbe.svg --label N-BK7,N-SF6 --csv | wc -l
python3 - <<'END'
import xml.etree.ElementTree as tree
root = tree.parse("abbe.svg").getroot()
marks = [e for e in root.iter() if e.tag.endswith("circle")]
texts = {e.text for e in root.iter() if e.tag.endswith("text")}
inside = all(0 < float(e.get("cx")) < 900 and 0 < float(e.get("cy")) < 640 for e in marks)
print(len(marks), inside, {"N-BK7", "N-SF6", "SCHOTT", "Abbe number Vd"} <= texts)
END
