# pictures that would take gigabytes are refused by what their heads say, before they are unpacked
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 14000 +X 14000\n' > wide.hdr
truncate -s 12400000 wide.hdr # as many bytes as 14000 rows of runs have at the least
python3 - << END
import struct, zlib
def chunk(kind, data): return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
head = struct.pack('>IIBBBBB', 14000, 14000, 1, 0, 0, 0, 0) # of 1 bit
open('wide.png', 'wb').write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', head) + chunk(b'IDAT', bytes(24000)) + chunk(b'IEND', b''))
END
cat > wide.scene << END
camera at=0,0,5 look=0,0,0
material cloth lambert texture=wide.hdr
rectangle at=0,0,0 size=1,1 material=cloth
END
# sanitizers reserve more than this before anything is read
(ulimit -v 1000000; lenscalc --version || exit 1) > /dev/null 2>&1 && ulimit -v 1000000
small='--lens double-gauss-50 -s 1m --size 6x4 --samples 4 -o lost.png'
for file in wide.hdr wide.png; do
    lenscalc tone $file -o lost.png
    lenscalc render $file $small
done
lenscalc render chart:grid --depth-map wide.png --depth 1..5 $small
lenscalc render wide.scene $small
# what EXPOSURE and COLORCORR may be
for line in EXPOSURE=1e400 EXPOSURE=1e39 EXPOSURE=-1 'COLORCORR=1 2 1e-39' PIXASPECT=0; do
    printf '#?RADIANCE\n%s\n\n-Y 1 +X 1\nabcd' "$line" > odd.hdr
    lenscalc tone odd.hdr -o lost.png
done
printf 'Pf\n1 1\n-inf\nabcd' > odd.pfm
lenscalc tone odd.pfm -o lost.png
printf 'Pf\n1 1\n-1\nabcd' > one.pfm
lenscalc tone one.pfm --times 1,2 -o lost.png
