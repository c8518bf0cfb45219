# nothing that follows from what is lost is given as if it were kept: solves through a surface of an
# unknown type leave the file's numbers, and the focal length is marked
zmx() {
    printf 'MODE SEQ\nUNIT MM\nENPD 10\nSURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n'
    printf '  TYPE %s\n  CURV 0.02\n  DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\n' "$1"
    printf 'SURF 2\n  CURV -0.01 4 1 -0.5 0\n  DISZ 6\nSURF 3\n  CURV 0.001 2 -0.07\n  DISZ 2\n'
    printf '  GLAS ___BLANK 1 0 1.5 0\nSURF 4\n  DISZ 31.5\n  MAZH 0 0\nSURF 5\n  DISZ 0\nMNUM 1 1\n'
}
zmx GRINSUR1 > grin.zmx
lenscalc convert grin.zmx --lossy
lenscalc lens grin.zmx --lossy --columns efl,warning
zmx STANDARD | sed 's/CURV 0.001 2/CURV 0 2/; s/DISZ 31.5/DISZ 0/' > plain.zmx
lenscalc convert plain.zmx | tail -n 5
# the same in a .seq and a .len
printf 'RDM;LEN\nEPD 10\nSO 0 1e13\nS 50 4 1.5\nSTO\nDIF GRT\nS -50 31.5\nPIM\nSI 0 0\nGO\n' > d.seq
lenscalc convert d.seq --lossy
printf 'LEN NEW "d" 50 2\nEBR 5\nTH 1e20\nNXT\nRD 50\nTH 4\nGLA 1.5\nAST\nGSP 0.001\nNXT\n' > d.len
printf 'RD -50\nTH 31.5\nPY 0\nNXT\nEND 2\n' >> d.len
lenscalc convert d.len --lossy
# a decentred aperture is kept, or left out with its decentre: a centred one clips another beam
printf 'MODE SEQ\nUNIT MM\nENPD 10\nSURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n' > o.zmx
printf '  DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\n  CLAP 0 6 0\n  OBDC 0 20\n  DIAM 26 0\n' >> o.zmx
printf 'SURF 2\n  CURV -0.02\n  DISZ 40\n  DIAM 26 1\n  CLAP 0 6 0\n  OBDC 0 20\nSURF 3\n  DISZ 0\nMNUM 1 1\n' >> o.zmx
lenscalc convert o.zmx --lossy
printf 'RDM;LEN\nEPD 10\nSO 0 1e13\nS 50 4 1.5\nSTO\nCIR 6\nADY 20\nS -50 40\nSI 0 0\nGO\n' > o.seq
lenscalc convert o.seq --lossy
