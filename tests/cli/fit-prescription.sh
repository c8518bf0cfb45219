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
