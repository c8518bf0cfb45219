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
