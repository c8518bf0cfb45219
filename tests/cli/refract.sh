# one surface: conjugates, a ray, solved unknowns, and what is refused
lenscalc refract --after 1.5 -R 50 -z -200
lenscalc refract --after 1.5 -R 50 -z -200 -y 10
lenscalc refract --mirror -R -100 -y 60 --csv --digits 9 --columns image,crossing,difference
lenscalc refract --after 1.5 -R 50 -y 10,49,51
lenscalc refract --after 1.5 -R 50 -z -100 -y 5 --json --digits 9
echo "solved:"
lenscalc refract --after 1.5 -z -200 --image 300 --csv --columns radius
lenscalc refract --before 1 -R 50 -z -200 --image 300 --csv --columns index_after
lenscalc refract --after 1.5 -R 50 --image 300 --csv --columns object,object_kind
lenscalc refract --after 1.336 --image 24mm --csv --digits 9 --columns radius,object
echo "by height and angle, by object and angle, in the vertex plane:"
lenscalc refract --after 1.5 -R 50 -y 10 -u 5deg --csv --digits 9 --columns object,crossing
lenscalc refract --after 1.5 -R 50 -z -100 -u 5deg --csv --digits 9 --columns height,crossing
lenscalc refract --after 1.5 -R 50 -z -100 -y 10 --height-at vertex --csv --digits 9 --columns height,sag
echo "its own rows again:"
lenscalc refract --after 1.5 -R 50 -z -100,-200 -y 0,10 --csv > rows.csv
lenscalc refract --batch rows.csv --csv | cmp - rows.csv && echo the same
exec 2>&1
lenscalc refract --before 1.5 --after 1 -R inf -z -30 -u 45
lenscalc refract --after 1.5 -R 20 -y 21
lenscalc refract --after 1.5 -R 20 -z -10 -y 19.9
lenscalc refract --after 1.5 -R 0
lenscalc refract --after -1 -R 50
lenscalc refract -R 50
lenscalc refract --after 1.5
lenscalc refract
lenscalc refract --before 1 --after 1.5 -R 50 -z -200 --image 300
lenscalc refract --mirror --after 1.5 -R 50
lenscalc refract --after 1.5 -R 50 -u 5
lenscalc refract --after 1.5 -R 50 -z inf -u 5
lenscalc refract --after 1.5 -R 50 -z -100 -y 1 -u 5
lenscalc refract --after 1 -z -100 --image 50
# a plane, by an angle alone; what is not said
lenscalc refract --angle 30 --after 1.5
lenscalc refract --angle 0..60:30 --after 1.5
lenscalc refract --angle 30 --refracted 22 --csv --columns index_after,deviation
lenscalc refract --before 1.33 --after 1 -z -2m --explain
lenscalc refract --before 1.5 --after 1 --json
lenscalc refract --mirror --angle 30 --csv --columns incidence,refraction,deviation,brewster_angle
for words in '--angle 30' '--angle 30 -R 5 --after 1.5' '--angle 30 --after water' '--angle 30 --refracted -22' \
    '--angle 30 --refracted 22 --after 1.5' '--refracted 22 --after 1.5' '--angle 60 --before 1.5 --after 1'; do
    lenscalc refract $words 2>&1
    echo "status $?"
done
