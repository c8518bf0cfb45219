# indices of glasses by name, in the order asked
lenscalc glass n-bk7,N-SF6 -w d,F,0.55um --csv --columns glass,wavelength,index --digits 9
lenscalc glass schott:n-bk7
lenscalc glass N-BK7 -w d --thickness 25
lenscalc glass N-BK7 -w e --temperature 60 --pressure 0 --csv --digits 8 \
    --columns index,temperature,pressure,index_relative_to
lenscalc glass 1.5168/64.17,1.5 -w C --csv --columns glass,index,catalog,vd --digits 7
lenscalc glass N-BK7,N-SF6 -w 400..700:100 --table wavelength,glass
printf 'glass,wavelength_nm,id\nN-BK7,587.5618,1\nN-BK7,d,2\nnone,500,3\nN-BK7,200,4\n' |
    lenscalc glass --batch - --csv --columns index --digits 8
echo "status $?"
# a wrong formula is mended, a doubtful range is told; crystals and infrared materials
lenscalc glass NHG:ZNSE,MISC:ZNSE,GERMANIUM,IRG22 -w 10.6um --csv --columns catalog,glass,index --digits 5
lenscalc glass TOPAS:5013LS-01,NHG:H-BAK6 -w 600
lenscalc glass NHG:IRG209 -w 16um
echo "status $?"
lenscalc glass SAPPHIRE_O,SAPPHIRE_E,QUARTZ_E --csv --columns glass,index,vd -w d --digits 6
lenscalc glass IRG26 -w 10um --temperature 40 --csv --columns index,dn_dt_vacuum_per_k --digits 6
# several glasses of a name: the current one, said; other programs' names
lenscalc glass SF6 -w d --columns glass,catalog,index
lenscalc glass --like SF6 --count 1 --csv --columns glass,catalog,taken_as
printf 'glass\nSF6\nF2\nZNSE\nGE\nINFRARED:AMTIR1\nMISC:SILICA\nSCHOTT:SILICA\nBK7\n' |
    lenscalc glass --batch - -w 3um --csv --columns catalog,index,taken_as --digits 6
printf 'wavelength 3um\nsurface 100 5 GE 20\nsurface - 90 air 20\n' > ge.lens
lenscalc lens ge.lens
echo "status $?"
printf 'wavelength d\nsurface 100 5 SF6 20\nsurface - 90 air 20\n' > sf6.lens
lenscalc lens sf6.lens
echo "status $?"
lenscalc conjugate double-gauss --object-medium SF6
echo "status $?"
