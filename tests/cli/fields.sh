# fields as points x, y: options, columns, files, and heights of the real image
lens() {
    printf 'lens Singlet\nwavelength d\n%s\naperture f/8\n' "$1"
    printf 'surface 50 4 1.5168 20 stop\nsurface -50 90 air 20\n'
}
lenscalc trace double-gauss --field 0,10 --field-x 5 --pupil-point 0:0 --digits 6
lenscalc trace double-gauss --height 10 --height-x -3 --pupil-point 0:0 --columns height_x,height,x_out,y_out
lenscalc trace double-gauss --height 10 --real --pupil-point 0:0 --columns height,y_out --digits 9
lenscalc pupil double-gauss --field-x 10 --side entrance
lenscalc pupil double-gauss --height-x 10 --side exit
lenscalc surfaces double-gauss --field-x 5 --columns field_x,surface,chief_y --csv | head -2
lenscalc lens double-gauss --field 3 --field-x 4 --columns lagrange
lens 'field angle 0 3,4:0.5 5' > beside.lens
lenscalc trace beside.lens --pupil-point 0:0
lenscalc trace beside.lens --field 5 --pupil-point 0:0 --csv
lenscalc pupil beside.lens --side exit
lenscalc convert beside.lens --to lens | grep field
lens 'field real 0 3,4' | lenscalc trace - --pupil-point 0:0
lens 'field real 0 3,4' | lenscalc convert - --to len --lossy | grep -E '^(GIH|F )|fields'
for field in 'angle' 'angle 200' 'angle 90,1' 'angle 1,2,3' 'angle 1:-1' 'real x' 'tall 1'; do
    lens "field $field" | lenscalc trace -
done
lenscalc trace double-gauss --field 95 --field-x 5
lenscalc trace double-gauss --height 90 --real --pupil-point 0:0
lenscalc trace double-gauss --real
lenscalc lens double-gauss --field 20 --field-x 95
