# long: one page about a lens; what it holds is checked by check_report.py
lenscalc report double-gauss -N 4 -o page.html
sed -n 's/.*<code>\(.*\)<\/code>.*/\1/p' page.html
lenscalc report double-gauss -N 4 --threads 3 | cmp - page.html
lenscalc report canon-nfd-70-210 --position wide,tele | grep '<h2>'
lenscalc report canon-nfd-70-210 --position tele | grep -c figcaption
lenscalc convert double-gauss | lenscalc report - | grep -c '<p>'
printf 'object inf\nsurface 50 3 1.5168/64.2 -\nsurface -50 0 air -\n' > bare.lens
lenscalc report bare.lens | grep '<p>'
# commands that a shell reads back, texts that XML holds
printf 'lens  a \377 url(#x) <b>\nobject inf\nsurface 50 3 1.5168/64.2 -\nsurface -50 0 air -\n' > "it's \$(x).lens"
lenscalc report "it's \$(x).lens" -N 2.8 -o odd.svg
grep -e '<title>a' -e 'lenscalc lens' odd.svg | sort -u
rm odd.svg it*.lens
# refused
lenscalc report
lenscalc report double-gauss -o page.eps
lenscalc report no-such-lens
lenscalc report double-gauss --position wide
lenscalc report double-gauss wide-35
lenscalc report double-gauss -N 2,4
lenscalc report double-gauss -w d
{ echo 'lens Many'; printf 'field angle'; seq -f ' %g' -s '' 0 0.1 10; echo
    printf 'surface 50 2 1.5 20\nsurface - 97 air 20\n'; } > many.lens
lenscalc report many.lens -o many.html
rm many.lens
ls
# what the page says of its parts is not said again
lenscalc convert erfle-eyepiece | sed '/^aperture/d' | lenscalc report - --images -o lost.html && grep -c 'size of its pupil is not known' lost.html
lenscalc report cooke-triplet-50 --theme dark --title Triplet --subtitle "" -o dark.html && grep -c "color-scheme: dark" dark.html && grep -o "<h1>.*\|<p>.*" dark.html | head -1
lenscalc report cooke-triplet-50 --theme dark -o dark.svg && grep -o "<rect width=.1720.*" dark.svg
