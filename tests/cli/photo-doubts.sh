# what is odd about a question is said beside the answer, in every format
lenscalc dof -f 50 -N T2.1 -s 3m --columns near,far
lenscalc dof -f 50 -N T2.1 -s 3m --csv --columns near_m
lenscalc dof -f 50 -N T2.1 -s 3m --json --columns near_m
lenscalc dof -f 50 -N 0.3,T2.1,0.3,2 -s 3m --jsonl --columns fnumber,near_m --digits 4
lenscalc dof -f 50 -N 2,T2.1 -s 3m,4m --table s,N
lenscalc exposure --t-stop T2.1 --ev 12 --columns time
lenscalc focus -f 100mm --close-up 500D --columns magnification
lenscalc focus -f 100mm --close-up 2 --columns magnification
lenscalc dof -f 50 -N 8 -s 2m -c 2px --pitch 4mm,4um,0.1um --csv --columns coc_mm
lenscalc stars -f 24 --columns exact,npf
lenscalc stars -f 24 -N 2.8 --columns exact,npf
lenscalc stars -f 24 -N 2.8 --sensor "Nikon D1" --columns exact,npf
echo "# estimated pixels"
lenscalc dof -f 50 -N 8 -s 2m -c 2px --sensor "Leica M9-P" --columns coc
lenscalc dof -f 50 -N 8 -s 2m -c 2px --sensor "Nikon D1" --columns coc
lenscalc dof -f 50 -N 8 -s 2m --sensor "Leica M9-P" --columns coc
lenscalc hyperfocal -f 50 -N 8 -c 2px --sensor "Leica M9-P,Kodak DCS760" --csv --columns sensor,coc_mm
lenscalc diffraction -N 8 --sensor "Leica M9-P" --columns nyquist --json
lenscalc motion -f 50 -s 10m --speed 5km/h -t 1/60 --sensor "Leica M9-P" --csv --columns blur_pixels
lenscalc stars -f 24 -N 2.8 --sensor "Leica M9-P" --columns npf
echo "# many rows, few words"
printf 'N,s_m\n0.3,2\n0.31,3\n2,3\n0.3,4\n' | lenscalc dof -f 50 --batch - --csv --columns near_m --digits 4
printf 'N,s_m\nT2,2\n' | lenscalc dof -f 50 --batch - --json --columns near_m --digits 4
lenscalc dof -f 50 -N 0.1..0.4:0.01 -s 3m --csv --columns near_m --digits 3
echo "# a print or pixels make the criterion"
lenscalc dof -f 50 -N 8 -s 2m --print 30in --viewing 1m --columns coc,near,far
lenscalc hyperfocal -f 50 -N 8 --pitch 4um --csv --columns coc_mm,coc_criterion,hyperfocal_m --digits 5
lenscalc dof -f 50 -N 8 -s 2m --print 30in --pitch 4um
lenscalc dof -f 50 -N 8 -s 2m --print 30in -c d/1500
lenscalc dof -f 50 -N 8 -s 2m --pitch 4um -c 0.03
lenscalc tilt -f 90 -N 8 --tilt 5deg --image 92mm --print 16in --pitch 4um
lenscalc equivalent -f 50 -N 8 --to mft --pitch 4um --viewing 1m
printf 'print_mm,coc_mm\n300,\n300,0.03\n,0.03\n' | lenscalc dof -f 50 -N 8 -s 2m --batch - --csv --columns coc_mm,coc_criterion --digits 4
lenscalc dof -f 50 -N 8 -c airy --near 1m --far 1.1m --stack
lenscalc dof -f 50 -c airy --near 1m --far 1.1m
echo "# fractions run in stops"
lenscalc flash -g 36 -N 8 --power 1/16..1 --csv --columns power,distance_m
lenscalc flash -g 36 -N 8 --power 1..1/4 --csv --columns power
lenscalc flash -g 36 -N 8 --power 1/16..1:1/4 --csv --columns power
lenscalc flash -g 36 -N 8 --power 1/10..1
lenscalc flash -g 36 -N 8 --power 0/16..1
lenscalc focus -f 100 -m 1:8..1:1 --csv --columns magnification
lenscalc focus -f 100 -m 1:4..1:1:0.25 --csv --columns magnification
lenscalc exposure -N 8 -t 1/30000..1/7500 --csv --columns time_s --digits 5
lenscalc exposure -N 8 -t 1/500..1/60 --csv --columns time_s --digits 5
echo "# feet stay feet beside infinity"
lenscalc dof -f 50 -N 2.8,4 -s 6ft,10ft,inf --table s,N --units imperial
lenscalc dof -f 50 -N 2.8,4 -s inf,6ft --table s,N --csv --digits 4
lenscalc dof -f 50 -N 2.8,4 -s 6ft,2m,inf --table s,N
echo "# films"
lenscalc exposure --film "HP5 Plus" -N 22 --ev 5 --columns iso,time
lenscalc exposure --film "HP5 Plus" -N 22 --ev 5 --json --columns iso,time_s
lenscalc exposure --film "Portra 400" -N 4 --ev 10 --columns iso,time
lenscalc exposure --film "Tri-X" -N 22 --ev 5
lenscalc exposure --film "Tri-X" -t 10s --columns corrected_time
lenscalc exposure --film "HP5 Plus" -N 22 --ev 5 -t 10s --columns iso
lenscalc exposure -N 8 -t 1/125 --iso 400 --focal-plane --ev 12 --columns lens_q,glass_transmittance,vignetting,off_axis
lenscalc exposure -N 8 -t 1/125 --iso 400 --focal-plane --ev 12 --explain --columns lens_q
lenscalc list cameras mavic
