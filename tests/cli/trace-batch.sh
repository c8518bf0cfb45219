# rays in, rays out: order, errors, columns handed through, wavelengths by row
cat > rays.csv <<'EOF'
id,x_mm,y_mm,z_mm,cos_x,cos_y,cos_z,wavelength_nm
a,0,10,-20,0,0,1,587.5618
b,0,10,-20,0,0,1,486.1327
c,0,40,-20,0,0,1,587.5618
"d,e",0,10,-20,0,0,0.5,587.5618
f,0,10,-20,0,0,x,587.5618
g,0,10,-20,,,,587.5618
h,0,,-20,0,0,1,587.5618
i,0,10,-20,0,0,1,-5
j,0,10,-20,0,0,1,nan
k,0.0,1e1,-2e1,0,0,1,0.4861327um
l,0,10,-20,0,0,1,
m,0,10,-20,0,0
n,0,-10,-20,0,0,1,F
EOF
lenscalc trace double-gauss --batch rays.csv --csv --digits 9
lenscalc trace double-gauss --batch rays.csv --csv --columns y_out_mm --fail-fast
lenscalc trace double-gauss --batch rays.csv --jsonl --columns y_out_mm,status,surface
cut -d, -f2-8 rays.csv | head -4 | lenscalc trace double-gauss --batch - --paraxial --verify --csv --columns wavelength_nm,paraxial_y_mm,status
# one command's output feeds the next
lenscalc trace double-gauss --field 10 --csv > first.csv
lenscalc trace double-gauss --batch first.csv --csv > second.csv
cut -d, -f2,8- first.csv > a; cut -d, -f2,8- second.csv > b; head -2 a b
printf 'lens,x_mm,y_mm,z_mm\ndouble-gauss,0,1,-5\nquestar-35,0,20,-5\nno-such,0,1,-5\n' | lenscalc trace --batch - --csv --columns x_mm,y_out_mm,status
printf 'field_deg,w\n0,d\n10,F\n95,d\n' | lenscalc trace double-gauss --batch - --csv --digits 9 --columns field_deg,ray,wavelength_nm,y_out_mm,status
{ echo x,y,z; sleep 0.2; echo 0,1,-5; sleep 0.3; echo 0,2,-5; } | lenscalc trace double-gauss --batch - --csv --columns y_out_mm | while read -r line; do echo "got $line"; done
