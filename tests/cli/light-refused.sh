# what cannot be answered, and why
refuse() {
    lenscalc "$@"
    echo "status $?"
}
refuse exposure -N 8 -t 0 --ev 12
refuse exposure -N 8 -t 1/60 --iso -100
refuse exposure -N 8
refuse exposure -N 8 --ev 12 --luminance 100
refuse exposure -N 8 --ev 12 --scene sunny-16
refuse exposure -N 8 --scene suny-16
refuse exposure -N 8 -t 1/60 --ev-at-iso 12
refuse exposure -N 2.8 --ev 8 --t-stop 2
refuse exposure -N 2.8 --ev 8 --t-stop 3 --transmittance 0.9
refuse exposure -t 1/20 --frame-rate 24 --ev 8
refuse exposure -t 60s --film "Velvia 50"
refuse exposure -t 2s --film "Ektar 100"
refuse exposure -t 10s --film Gainer
refuse exposure -t 10s --film "HP6 Plus"
refuse exposure --corrected-time 150s --film "Acros 100"
refuse exposure --corrected-time 150s -N 8
refuse exposure -N 8 --ev 12 --filter 3
refuse exposure -N 8 --ev 12 --filter ND
refuse exposure -N 8 --ev 12 --filter ND0.9+
refuse exposure -N 8 --ev 12 --filter wraten-8
refuse exposure -N 8 --ev 12 --filter 0.5x
refuse exposure -N 8 --ev 12 --filter=-2stops
refuse exposure -N 8 --ev 12 --series quarter
refuse bracket --from 30s
refuse bracket --from 30s --to 1/1000s --step 0.001
refuse bracket --from 30s --to 1/1000s --shots 1
refuse bracket --from 0s --to 1s
refuse bracket -t 1/60 --from 30s --shots 3
refuse bracket -t 1/60 --scene-range 18 --range 1 --step 2
refuse flash -g 36
refuse flash -g 36 -N 8 -s 20m
refuse flash -g 36 -N 8 -s 4.5m --power 2
refuse flash -g 36 -N 8 --ceiling 1m
refuse flash -g 36 -N 8 -s 4m --power 1/2 --ev 12 -t 1/500 --sync 1/200
refuse flash --ratio 1:1
refuse motion -f 50
refuse motion -f 50mm -s 40mm -v 1m/s
refuse motion -f 50 -s 10m -v 5km/h --angle 200deg
refuse motion -f 50 -s 10m -v 100m/s -t 1s --angle 0deg
refuse motion -f 50 -s 10m -v 1m/s --blur 2px
refuse stars -f 50 --declination 90deg
refuse stars -f 50 --declination 91deg
refuse stars
refuse stars -f 50 -t 0
refuse stars -f 50 --trail 1px
refuse exposure -N 8 -t 1/125 --filter "nd2+nd2+nd2+nd2+nd2+nd2+nd2+nd2+nd2+nd2+nd2+nd2+nd2+nd2+nd2+nd2+nd2"
