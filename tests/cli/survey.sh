# surveys from the air: ground sampling, overlaps, intervals, motion blur
lenscalc survey Mavic 3 --altitude 100m --overlap 80% --sidelap 70% -v 10m/s --explain
lenscalc survey mini 3 pro --gsd 2cm
lenscalc survey mavic3,mini2 --altitude 400ft --columns gsd
lenscalc survey --sensor 'Mavic 3' --altitude 60m,120m --overlap 80% --interval 2s --csv --digits 6
lenscalc survey --sensor 'Mavic 3' --altitude 100m --overlap 0.8 --along width -v 36km/h --json --digits 6
lenscalc survey -f 35 --sensor 35mm --pixels 8192x5460 --altitude 100m -v 15m/s -t 1/500,1/1000 --blur 1px
printf 'altitude_m,speed_m_s,site\n50,5,field\n80,,wood\n0,5,lake\n' | lenscalc survey --sensor 'Mavic 3' --overlap 75% --batch - --csv --digits 5 --columns photo_spacing,interval_s,longest_s
for words in '--altitude 100m' '-f 10 --altitude 100m' '--sensor mavic3' '--sensor mavic3 --altitude 100 --gsd 2' \
    '--sensor mavic3 --altitude 100 --overlap 80' '--sensor mavic3 --altitude 100 --interval 2' \
    '--sensor mavic3 --altitude 100 -t 1/500' '--sensor mavic3 --altitude 100 -v 10 --blur 2um'; do
    lenscalc survey $words
    echo "status $?"
done
