# 10000 surfaces are read in every format, the object and the image beside them; one more is not
lines() { yes "$2" | head -n "$1"; }
for n in 10000 10001; do
    { echo 'lens Many'; lines $n 'surface - 0.01 air 20'; } > many.lens
    { echo '50 1 1.5 10'; lines $((n - 1)) '1e9 0.01 1 10'; } > many.dat
    { printf 'VERS 1\nMODE SEQ\nUNIT MM X W X CM MR CPMM\nENPD 10\nFTYP 0 0 1 1\nYFLN 0\nWAVM 1 0.58 1\n'
      printf 'SURF 0\n DISZ INFINITY\n'
      for i in $(seq $n); do printf 'SURF %d\n CURV 1e-5\n DISZ 0.01\n' $i; done
      printf 'SURF %d\n DISZ 0\n' $((n + 1)); } > many.zmx
    { printf 'RDM\nLEN\nEPD 10\nWL 587\nYAN 0\nSO 0 1e11\n'; lines $n 'S 50 1'; printf 'SI 0 0\nGO\n'; } > many.seq
    { printf 'LEN NEW "x" 50 %d\nEBR 5\nANG 5\nAIR\nTH 1e20\nNXT\n' $((n + 1)); lines $n 'AIR; RD 500; TH 1; NXT'; echo "END $((n + 1))"; } > many.len
    for file in many.lens many.dat many.zmx many.seq many.len; do
        lenscalc lens $file --csv --columns efl --digits 4
    done
done
