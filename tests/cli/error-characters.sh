# what is wrong in lines with letters of other scripts: shown as it is, the caret under it
zmx() {
    printf '%s\n' 'MODE SEQ' 'NAME Größe' 'FCOM 0 Länge äöü' 'ENPD 10' 'SURF 0' '  DISZ INFINITY' 'SURF 1' \
        '  STOP' "  $1" 'SURF 2' '  DISZ 0'
}
zmx 'GLAS ÄÖ漢字 x 1' > utf8.zmx
zmx 'GLAS ÄÖ漢字 x 1' | iconv -f UTF-8 -t UTF-16 > utf16.zmx
zmx 'GLAS ÄÖ x 1' | iconv -f UTF-8 -t ISO-8859-1 > latin1.zmx
for file in utf8 utf16 latin1; do lenscalc convert $file.zmx; done
printf 'lens Größe\nsurface 漢字 5 air 3\n' > a.lens
printf 'lens Größe\nsurface 50 5 air 3 # ö\nsurface 50 5 air 3 名=1\n' > b.lens
printf 'lens Gr\366\337e\nsurface \344\366 5x\n' > c.lens
printf 'light sun ö名 x=1\n' > d.scene
printf '{"lens": "Größe 漢字", "surfaces": [{"radius": 1x}]}' > e.json
for file in a.lens b.lens c.lens e.json; do lenscalc convert $file; done
lenscalc render d.scene --lens double-gauss -o d.png
printf 'note,s\nGröße 漢字,2x\n' | lenscalc dof -f 50 -N 8 --batch - --csv
printf '{"note": "Größe 漢字", "s": "2x"}\n' | lenscalc dof -f 50 -N 8 --batch - --jsonl
lenscalc dof -f 50mm -N 8 -s 'ä2m'
lenscalc dof -f 50mm -N 8 -s '2漢字 3'
lenscalc dof -f 50mm -N '8..ö'
