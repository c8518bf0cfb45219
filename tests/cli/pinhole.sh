# a camera with a hole in place of a lens
lenscalc pinhole -f 150mm --sensor 4x5 --metered 1/60 --film "HP5 Plus"
lenscalc pinhole 49mm --diameter 0.3mm
lenscalc pinhole -f 50mm --rule rayleigh,petzval,young,airy
lenscalc pinhole -f 50 --diameter 0.2,0.3 -s 20cm --csv
lenscalc pinhole -f 24mm-eq --sensor 6x9 --json
lenscalc pinhole -f 100 --metered 1/8 --metered-at 8 --explain
for wrong in "" "-f 0" "-f 50 --diameter 7" "-f 50 --metered 1s --film Gainer" "-f 50 -s 0" "-f 50 --rule best" \
    "-f 50 --metered 1/60 --film Kodachrome"; do
    lenscalc pinhole $wrong
    echo "status $?"
done
