# radii, gaps and indices that give what was measured
lenscalc fit double-gauss --prescription efl=101,bfl=72.5 --vary R1,R11 -o new.lens --columns goal,reached_mm
lenscalc lens new.lens -w d --columns efl,bfl --digits 8
lenscalc fit double-gauss --prescription efl=101,bfl=72.5 --vary R1,R11 --show parameters
lenscalc fit double-gauss --prescription efl=101,bfl=72.5,ffl=-55:0.1,height@10deg=17.8,bfl@F=72.4 --vary 'R1[50,60],t5[11,12],n1' --columns goal,target_mm,reached_mm
lenscalc fit double-gauss --prescription efl=101,bfl=72.5,ffl=-55:0.1,height@10deg=17.8 --vary 'R1[58,59],t5[11,12],n1' --show parameters --columns parameter,value,note --csv --digits 5
cat > marked.lens << END
lens marked
surface 50 7.5 1.5 20 R~[40,60]
surface -50 - air 20 R~[-60,-40]
END
lenscalc fit marked.lens --prescription efl=52 --show parameters --columns parameter,value
# marks that no fit varies are named in every format
cat > others.lens << END
lens others
surface 50 7.5 1.5 20 R~[40,60] k~ A4~ glass~
surface -50 - air 20 c~
END
lenscalc fit others.lens --prescription efl=52
lenscalc fit others.lens --prescription efl=52 --csv 2>&1
lenscalc fit others.lens --prescription efl=52 --show parameters --json
# a mark loses the bounds that the answer violates, so that the next fit takes the file
lenscalc fit others.lens --prescription efl=30 --vary R1 -o freed.lens
cat freed.lens
lenscalc fit freed.lens --prescription efl=31 --show parameters --columns parameter,value
# at a bound it keeps them, to the last bit
sed 's/\[40,60\]/[41,49.1]/; s/50 7.5/49 7.5/' others.lens > bound.lens
lenscalc fit bound.lens --prescription efl=60 -o bounded.lens --columns goal,reached_mm
lenscalc fit bounded.lens --prescription efl=49 --columns goal,reached_mm
# behind the last surface is before the first of the lens turned around, which has no marks
printf 'lens wet\nsurface 50 7.5 1.5 20 glass~\nsurface -50 10 1.33 20 t~ glass~\n' > wet.lens
lenscalc convert wet.lens --reverse 2>&1
