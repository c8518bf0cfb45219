# how many corners and crossings a polygon may have: the star {n/k} has n (k - 1) crossings
star() { # CORNERS STEP
    awk -v n="$1" -v k="$2" 'BEGIN {
        printf "aperture stop\nsurface 50 5 1.5 30\npass polygon"
        for (i = 0; i < n; i++) {
            turn = 2 * 3.141592653589793 * ((i * k) % n) / n
            printf " %.9f,%.9f", 9 * cos(turn), 9 * sin(turn)
        }
        print "\nstop - 5 air 10\nsurface - 90 air -"
    }' > star.lens
    lenscalc lens star.lens --csv --columns efl_mm 2> error; echo "$1/$2: status $?"
    head -1 error
}
star 5 2
star 50 3
star 101 2
star 1001 500
star 4096 1
star 4097 1
