# tests/bench/dof.awk - the batch of dof in awk, for comparison.
NR == 1 { print "hyperfocal_m,near_m,far_m"; next }
{
    f = $1; N = $2; s = $3 * 1000; c = $4
    h = f * f / (N * c); d = h + (s - f); g = h - (s - f)
    printf "%.6g,%.6g,", (h + f) / 1000, s * h / d / 1000
    if (g > 0) printf "%.6g\n", s * h / g / 1000; else print "inf"
}
