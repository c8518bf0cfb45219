# cameras by the names people and EXIF have for them, sensor modes, and what is near a wrong one
camera() {
    lenscalc fov -f 50 --columns horizontal --digits 4 --csv --sensor "$@" || echo "status $?"
}
camera 'EOS R5'
camera 'Canon R5'
camera ILCE-7M4
camera 'A7R V'
camera 'Fuji X-T5'
camera 'NIKON Z 6_2'
camera DC-GH6
camera E-M1MarkII
camera FC6310
camera L2D-20c
camera 'iPhone 15 Pro Max'
camera 'Galaxy S24 Ultra'
# modes: 28.0 x 19.2, 28.0 x 15.7, 24.9 x 14.0 mm
lenscalc fov -f 25 --sensor 'ALEXA 35 4.6K 3:2' --columns horizontal,vertical --digits 6
lenscalc fov -f 25 --sensor 'ALEXA 35 4.6K 16:9,ALEXA 35 4K 16:9,ARRI ALEXA Mini LF,VENICE 2 8K,KOMODO' --columns horizontal --digits 6
# a wrong one: family and format
camera 'EOS R55'
camera 'iPhone 12 mini'
camera 'Nikon Z10'
camera 'Hasselblad X3D'
camera Nikon
camera supr35
camera zzz
# searched by any words of name, other names and class
lenscalc list cameras canon r5 --columns camera,width,height --csv
lenscalc list cameras drone mavic --columns camera,pitch,confidence --csv
lenscalc list cameras alexa 35 16:9 --columns camera --csv
lenscalc list cameras ilce-7rm5 --columns camera --csv
lenscalc list cameras --kind Google --columns camera,class --csv
# as people shorten them, and what no source covers
for name in 'Canon R6 II' 'canon 5d mark 4' 5D4 'GoPro Hero 12' 'Sony A7R5' 'canon 7d mkII' GR3 QHY600; do
    lenscalc fov -f 50 --sensor "$name" --columns horizontal --json | grep -o '"sensor":"[^"]*"'
done
camera 'GoPro Hero 14'
camera 'canon 5d mark 7'
lenscalc list cameras iphone 15 pro --columns camera,focal_mm,equivalent_mm,fnumber,pitch --csv
lenscalc list cameras --kind Sony imx25 --columns camera,width,height,pixels_wide,pitch --csv
lenscalc list cameras asi533mc --columns camera,width,pixels_wide,pitch --csv
