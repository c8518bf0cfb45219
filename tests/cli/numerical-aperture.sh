# a numerical aperture in place of the f-number
lenscalc diffraction --na 0.65 --columns na,fnumber,airy_radius,cutoff
lenscalc diffraction --na 0.25,0.65 -m 40 --pitch 3.45um --csv --columns na,working_fnumber,airy_radius_um,nyquist_per_mm --digits 6
lenscalc diffraction --na 0.65 -m 40 --frequency 20,40 --json --columns na,frequency_per_mm,mtf_lens --digits 5
lenscalc diffraction --na 1.25 -m 100 --csv --columns na,airy_radius_um,working_fnumber --digits 4
lenscalc microscope 100x/1.25 --csv --columns na,rayleigh_um,working_fnumber --digits 4
lenscalc dof -f 50 -s 0.1 --na 0.1
lenscalc dof -f 20 -m 10 --na 0.1,0.25 --coc 14um --csv --columns na,fnumber,dof_m --digits 5
lenscalc dof --lens double-gauss -m 1:1 --na 0.05 --columns na,fnumber,dof
for wrong in "--na 0.65" "--na 0.65 -N 4 -f 50 -s 1" "-f 50 --na 0.1" "-f 50 --na 0.1 -s inf" "-f 50 --na 0 -s 1" \
    "-f 50 --na 0.1 -s 40mm" "-f 20 -m 40 --na 1" "-f 20 -m 60 --na 1.4"; do
    lenscalc dof $wrong --columns dof
    echo "status $?"
done
