# the user's own formats and cameras come first
mkdir mine
printf 'name\taliases\twidth_mm\theight_mm\tclass\tconfidence\tsource\nmyplate\tglass\t120\t90\town\tsourced\tmy ruler\n35mm\t-\t36.1\t24.1\town\tsourced\tmy ruler\n' > mine/formats.tsv
printf 'maker\tmodel\twidth_mm\theight_mm\tpx_w\tpx_h\tpitch_um\tpitch_from\tconfidence\tsource\nMine\tBox 1\t30\t20\t3000\t2000\t10\tpublished\tsourced\tmy ruler\n' > mine/cameras.tsv
for sensor in myplate glass 35mm 'box 1' 'Mine Box 1' half-frame; do
    lenscalc dof -f 50 -N 4 -s 3 --sensor "$sensor" --lensdb mine --csv --digits 6 --columns coc_mm,sensor
done
LENSCALC_DB=mine lenscalc dof -f 50 -N 4 -s 3 --sensor 'box 1' -c 2px --csv --columns coc_mm
lenscalc dof -f 50 -N 4 -s 3 --sensor myplate
echo "status $?"
lenscalc list formats myplate --lensdb mine --csv --columns format,width_mm,height_mm
printf 'name\twidth_mm\nx\t1\n' > mine/formats.tsv
lenscalc dof -f 50 -N 4 -s 3 --sensor x --lensdb mine
echo "status $?"
printf 'name\taliases\twidth_mm\theight_mm\tclass\tconfidence\tsource\nx\t-\twide\t90\town\tsourced\tmy ruler\n' > mine/formats.tsv
lenscalc dof -f 50 -N 4 -s 3 --sensor x --lensdb mine
echo "status $?"
lenscalc dof -f 50 -N 4 -s 3 --lensdb nowhere
echo "status $?"
lenscalc lens double-gauss --lensdb no-such-folder
lenscalc glass N-BK7 --lensdb no-such-folder
lenscalc list lenses --lensdb no-such-folder
