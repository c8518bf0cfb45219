# -f 50, -f50, -f=50, --name value, --name=value, _ for -, -- before operands
for words in '-f 50 -N 4 -s 3' '-f50 -N4 -s3' '-f=50 -N=4 -s=3' \
    '--focal-length 50 --aperture 4 --distance 3' '--focal_length=50 --aperture=4 --distance=3'; do
    lenscalc dof $words --csv --columns near_m
done
lenscalc list --csv --columns format -- formats half-frame
