# long: the same steps with every instruction set: glibc tells the program of fewer than there are
cat > triplet.lens <<'EOF'
lens        Fast triplet
wavelength  d F C
field       angle 0 10 16
aperture    epd 25
focus       table
surface     -   6   1.6204/60.3   30  c=0.03
surface     -   5   air           30  c=-0.005
surface     -   2   1.62/36.4     24  c=-0.02
surface     -   2   air           24  c=0.03
stop        -   4   air           20
surface     -   5   1.6204/60.3   30  c=0.01
surface     -   40  air           30  c=-0.025
EOF
with() {
    only=$1
    shift
    GLIBC_TUNABLES=glibc.cpu.hwcaps=$only lenscalc optimize "$@" --csv --digits 17 -o new.lens \
        --force && cat new.lens
}
for caps in -AVX512F -AVX512F,-AVX2 -AVX512F,-AVX2,-FMA; do
    for question in \
        "triplet.lens --vary all-R,all-t,glass1,k7 --goals poly,efl==50,edge>1,air>0.5" \
        "phone-80deg --vary all-R,A4_2,A6_2,k3 --goals opd,efl=5.164 --iterations 40" \
        "itoh-zoom-100-146 --vary all-R --goals spot,efl@wide=99.9,incidence<40 --iterations 30" \
        "double-gauss --vary R1..R11,t11 --goals poly,efl=90 --aim entrance"
    do
        with '' $question > all.txt
        with $caps $question > few.txt
        test -s all.txt && cmp all.txt few.txt && echo same
    done
done
