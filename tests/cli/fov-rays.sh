# the angles of a real lens by its chief rays, and what is said of them
lenscalc fov --lens fisheye-16
lenscalc fov --lens fisheye-16 --csv --digits 6
lenscalc fov --lens fisheye-16 --jsonl --digits 6 --projection equisolid
lenscalc fov --lens fisheye-16 --projection auto,chief-rays,rectilinear,equidistant --csv \
    --columns projection,diagonal_deg --digits 6
echo "# close up, with what is seen in the plane of focus"
lenscalc fov --lens double-gauss -s 400mm,1m,inf --digits 6
echo "# an image circle smaller than the sensor"
lenscalc fov --lens cs348b-fisheye-10 --csv --digits 4 --columns horizontal_deg,vertical_deg,image_circle_mm,warning
lenscalc fov --lens cs348b-fisheye-10 --json --digits 4
echo "# the pupils are one's own, or there is no stop: not by rays"
lenscalc fov --lens fisheye-16 -P 1 --columns diagonal
printf 'surface 50 5 1.5 20\nsurface -50 0 air 20\n' | lenscalc fov --lens - -P 1 --columns diagonal
printf 'surface 50 5 1.5 20\nsurface -50 0 air 20\n' | lenscalc fov --lens - --projection chief-rays
lenscalc fov --lens fisheye-16 -P 1 --projection chief-rays
lenscalc fov -f 16 --projection chief-rays
lenscalc fov --lens fisheye-16 --projection fisheye
lenscalc fov --lens fisheye-16 --squeeze 1.33 --columns horizontal,vertical
lenscalc fov --lens fisheye-270 --squeeze 1.33 --columns horizontal,vertical
echo "# rows in, rows out"
printf 'lens,s_m,projection\nfisheye-16,inf,auto\nfisheye-16,0.5,rectilinear\nwide-35,inf,\nnone,1,auto\n' |
    lenscalc fov --batch - --csv --digits 5 --columns projection,horizontal_deg,warning
echo "# by which formula"
lenscalc fov --lens fisheye-16 --explain --columns horizontal
lenscalc fov -f 8mm --projection stereographic --explain --columns horizontal,vertical
