# control characters of a file do not reach the terminal
printf 'lens \033[31mred\nsurface 50 1 1.5 10\nsurface -50 1 air 10\n' > title.lens; lenscalc lens title.lens
printf 'lens x\nsurface 50 1 1.5 10 name="\302\2335m"\nsurface -50 1 air 10\n' > name.lens; lenscalc surfaces name.lens
printf 'VERS 1\nMODE SEQ\nUNIT MM\nXYZ\033[31m 4\nENPD 5\nSURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 5\n  GLAS ___BLANK 1 0 1.5 60\nSURF 2\n  CURV -0.02\n  DISZ 50\nSURF 3\n  DISZ 0\nMNUM 1 1\n' > lost.zmx
lenscalc convert lost.zmx --to lens --lossy > /dev/null
