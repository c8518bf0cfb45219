# what is not shown need not be computed; what is shown stays the same, alone and with the rest
lenscalc spot double-gauss --csv --columns rms_um,radius_um,energy_radius_um --energy 80% > all.csv
for column in 1:rms_um 2:radius_um 3:energy_radius_um; do lenscalc spot double-gauss --csv --columns ${column#*:} --energy 80% > one.csv; cut -d, -f${column%%:*} all.csv | cmp - one.csv && echo same ${column#*:}; done
lenscalc illumination double-gauss --csv --columns height_mm,irradiance_per_radiance,relative_point,relative_field,vignetted_fraction > all.csv
for column in 2:irradiance_per_radiance 3:relative_point 4:relative_field 5:vignetted_fraction; do lenscalc illumination double-gauss --csv --columns ${column#*:} > one.csv; cut -d, -f${column%%:*} all.csv | cmp - one.csv && echo same ${column#*:}; done
