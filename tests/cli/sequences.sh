# files of CODE V and OSLO: a lens in each, and what is said of what is wrong in them
cat > a.seq <<'END'
RDM;LEN
TITLE 'plano-convex'    ! a comment
EPD 10; DIM M
WL 656.3 587.6&
 486.1
REF 2
YAN 0 5
SO 0.0 0.1e14
S 50.0 6.0 NBK7_SCHOTT; STO
  CIR 8.0
S 0.0 92.9
  PIM
SI 0.0 0.0
GO
END
lenscalc surfaces a.seq
sed 's/NBK7_SCHOTT/NBK77_SCHOTT/' a.seq > b.seq && lenscalc lens b.seq
sed 's/NBK7_SCHOTT/SK16_NOWHERE/' a.seq > b.seq && lenscalc lens b.seq
sed 's/S 50.0 6.0/S 50,0 6.0/' a.seq > b.seq && lenscalc lens b.seq
sed 's/CIR 8.0/CIRC 8.0 mm/' a.seq > b.seq && lenscalc lens b.seq
sed 's/CIR 8.0/VIG 8.0/' a.seq > b.seq && lenscalc lens b.seq
sed 's/CIR 8.0/REX 8.0/' a.seq > b.seq && lenscalc lens b.seq
sed 's/^YAN.*/FOR ^i 1 3/' a.seq > b.seq && lenscalc lens b.seq
sed 's/^RDM;LEN/LEN/' a.seq > b.seq && lenscalc lens b.seq
cat > a.len <<'END'
// OSLO 6.6 0 0 0
LEN NEW "plano-convex" 100 3
EBR 5.0
ANG 5.0
UNI 1.0
AIR
TH 1.0e+20
NXT
WV 0.5876 0.4861 0.6563
GLA MOD M1 1.5168 1.52238 1.51432
RD 50.0
TH 6.0
AP CHK 8.0
NXT
AIR
PY 0.0
NXT
AIR
WV 0.5876 0.4861 0.6563
WW 1.0 1.0 1.0
END 3
END
lenscalc surfaces a.len
sed 's/^GLA.*/GLA MOD M1 1.5168 1.52238/' a.len > b.len && lenscalc lens b.len
sed 's/^GLA.*/GLA BK77/' a.len > b.len && lenscalc lens b.len
sed 's/^GLA.*/GLA LAK9/' a.len > b.len && lenscalc lens b.len
sed 's/^RD.*/RD fifty/' a.len > b.len && lenscalc lens b.len
sed 's/^RD.*/PFL 50/' a.len > b.len && lenscalc lens b.len
sed 's/^NXT/NEXT/' a.len > b.len && lenscalc lens b.len
sed 's/^UNI.*/UNI 3/' a.len > b.len && lenscalc lens b.len
