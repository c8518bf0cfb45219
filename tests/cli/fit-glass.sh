# a glass from measured indices
cat > bk7.csv <<'END'
# rounded indices of N-BK7
wavelength_nm, index
706.5188, 1.51289
656.2725, 1.51432
587.5618, 1.51680
F, 1.52238
g, 1.52668
404.6561, 1.53024
365.0146, 1.53627
1013.98, 1.50731
2325.42, 1.48921
1529.58, 1.50091
END
lenscalc fit --glass bk7.csv --columns formula,from,to,rms,largest,nd,vd,indices,status
lenscalc fit --glass bk7.csv --show residuals --columns wavelength,measured,index
lenscalc fit --glass bk7.csv --formula schott --show parameters --csv --digits 4
lenscalc fit --glass bk7.csv --formula cauchy --terms 2 --show correlations
lenscalc fit --glass bk7.csv --formula buchdahl --columns formula,rms,largest,nd,vd
lenscalc fit --glass bk7.csv --formula conrady --csv --columns from_nm,to_nm,rms --digits 4
mkdir -p own/glass
lenscalc fit --glass bk7.csv --name MYBK7 -o own/glass/LAB.tsv --columns rms
grep -v '^#' own/glass/LAB.tsv | cut -f 1,2,4-
lenscalc glass LAB:MYBK7 -w d --lensdb own --columns glass,index,formula
printf 'wl,n,sigma\n0.5,1.5,0.001\n0.6,1.49,0.002\n0.7,1.485,0.001\n' > refractive.csv
lenscalc fit --glass refractive.csv --formula cauchy --terms 2 --show parameters
