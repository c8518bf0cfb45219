# convert --check: what becomes of each file, on any number of threads
head() { printf 'VERS 140124 347 24485\nMODE SEQ\nUNIT MM X W X CM MR CPMM\nENPD 10\nGCAT SCHOTT MYOWN\n'; }
body() {
    printf 'SURF 0\n  TYPE STANDARD\n  DISZ INFINITY\n'
    printf 'SURF 1\n  STOP\n  TYPE %s\n  CURV 0.02\n  SCOL 1 255 0 0\n%b  DISZ 4\n' "${1:-STANDARD}" "$2"
    printf '  GLAS %s\nSURF 2\n  CURV -0.02\n  DISZ 50\nSURF 3\n  DISZ 0\n' "${3:-N-BK7 0 0}"
    printf 'BLNK the merit function\nQQQQ 1 2 0 0 0 0 0 1 0 0\nTOL TOFF 0 0 0 0\n'
    printf 'MNUM 1 1\nMOFF 0 1 ""\nLTTL 0 1 "title"\n'
}
mkdir -p some/deep/er
{ head; body; } > some/plain.zmx
{ head; body; } | iconv -t UTF-16LE > some/wide.zmx
{ head; body STANDARD '  USAP a.uda\n  UDAD b.uda\n'; } > some/deep/blocked.zmx
{ head; printf 'VCYN 0 0.1\n'; body DGRATING '  WXYZ 1\n'; } > some/deep/er/grating.zmx
{ head; body STANDARD '' 'NOSUCH 0 0 1.5 40'; } | sed 's/^SURF 2/&\n  GLAS OTHER 0 0 1.5 40/; s/^SURF 3/SURF 3\n  GLAS THIRD 0 0 1.6 50\nSURF 5/' > some/deep/er/glass.zmx
{ head; body STANDARD '  USAP a.uda\n'; } | sed 's/^SURF 2/&\n  TYPE NONSEQCO/' > some/mixed.zmx
{ head; body USERSURF; } > some/dll.zmx
{ head; body; } | sed 's/SEQ/NSC/' > some/nsc.zmx
printf 'PK\003\004' > some/packed.zar
printf 'x' > some/project.ZOS
printf 'RDM\nLEN\nEPD 10\nWL 587.6\nSO 0 inf\nS 50 4 1.5:60; STO; &\n  CIR 6\nS 0 90\nSI 0 0\nTEM 20\nGO\n' > some/a.seq
printf 'RDM\nLEN\nEPD 10\nWL 587.6\nSO 0 inf\nS 50 4 1.5:60\nSTO\nREX 4\nS 0 90\nSI 0 0\nTEM 60\nGO\n' > some/b.seq
printf 'LEN NEW "x"\nEBR 5\nUNI 1\nTEM 20\nPRE 1\nAIR\nTH INF\nNXT\nGLA MOD 1.5 60\nRD 50\nTH 4\nAST\nNXT\nAIR\nTH 90\nNXT\nAIR\nWV 0.5876\nEND\n' > some/c.len
printf 'not a lens\n' > some/readme.txt
lenscalc convert --check some --threads 1 > one; echo $?
lenscalc convert --check some --threads 7 > seven 2> /dev/null
lenscalc convert --check some --threads 0 > cores 2> /dev/null
cmp one seven && cmp one cores && cat one
lenscalc convert --check --csv some/plain.zmx some/readme.txt some/none.zmx --columns file,format,status,losses,reasons
lenscalc convert --check --json some/deep
lenscalc convert --check some/plain.zmx; echo $?
lenscalc convert --check
lenscalc convert --check empty
lenscalc convert --check some --reverse
lenscalc convert some/plain.zmx --threads 2
lenscalc convert --check some --threads 1000
lenscalc lens some/mixed.zmx
lenscalc lens some/packed.zar
lenscalc lens ./some/project.ZOS --lossy
lenscalc lens ./some/deep/er/grating.zmx
lenscalc lens ./some/deep/er/glass.zmx
lenscalc lens ./some/deep/er/glass.zmx --lossy
mkdir empty; lenscalc convert --check empty
