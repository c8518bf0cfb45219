# scenes of meshes: as cards and boxes of the same corners; triangles without area
cat > card.obj <<'END'
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
v 0 -1 0
f 1 2 3 4
f 1 5 2
END
cat > card.scene <<'END'
camera at=0.3,0.2,3 look=0,0,0 focus=3
material lamp black emission=1 luminance=1000
card size=2,2 material=lamp
END
sed 's/card size=2,2/mesh file=card.obj/' card.scene > mesh.scene
small="--lens double-gauss-50 --size 48x32 --samples 8 -t 1/100"
lenscalc render card.scene $small -o card.pfm
lenscalc render mesh.scene $small -o mesh.pfm
cmp card.pfm mesh.pfm && echo same
# turned and moving, before something at rest
cat > solid.obj <<'END'
v -.3 -.3 -.3
v .3 -.3 -.3
v .3 .3 -.3
v -.3 .3 -.3
v -.3 -.3 .3
v .3 -.3 .3
v .3 .3 .3
v -.3 .3 .3
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
f 2 3 7 6
f 1 5 8 4
END
cat > box.scene <<'END'
camera at=0,1,3 look=0,0.3,0 focus=3
material lamp black emission=1 luminance=1000
material red black emission=1,0.1,0.1 luminance=300
disc radius=0.5 at=0.3,0.1,-0.3 material=red
box size=0.6,0.6,0.6 at=0,0.5,0 turn=0,30,0 move=10,0,0 spin=3000 axis=0,1,0 material=lamp
END
sed 's/box size=0.6,0.6,0.6/mesh file=solid.obj/' box.scene > solid.scene
lenscalc render box.scene $small -o box.pfm
lenscalc render solid.scene $small -o solid.pfm
cmp box.pfm solid.pfm && echo same
# nothing is there
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' > card.obj
lenscalc render mesh.scene $small -o none.pfm
