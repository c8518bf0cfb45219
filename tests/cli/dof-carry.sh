# depth of field to carry: discs to cut out and a card, in millimetres
lenscalc dof -f 50 -N 8 -s 3 --disc disc.svg --columns near,far
grep -o '^<svg[^>]*viewBox="[^"]*"\|>[^<]*</text>' disc.svg
lenscalc dof -f 24,50 -N 2.8,11 -s 0.02,1,5 --card card.svg --csv --columns near_m,far_m
grep -o '^<svg[^>]*viewBox="[^"]*"\|>[^<]*</text>' card.svg
lenscalc dof --lens double-gauss -N 4..11 -s 2 --disc lens.svg --csv --columns near_m
grep -o '>f/[^<]*</text>\|>[^<]*calculator[^<]*<' lens.svg
lenscalc dof -f 24,50 -N 4 -s 3 --disc two.svg > two.txt
lenscalc dof -f 50 -N 4 -s 3 --disc stack.svg --stack --near 1 --far 2
lenscalc dof -f 10..34 -N 1.4,2,2.8,4 -s 3 --card many.svg > all.txt
lenscalc dof -f 50 -s 3 --na 0.1 --disc na.svg
lenscalc dof -m 1 -N 11 -c 0.015mm --disc alone.svg
lenscalc dof -m 1 -N 11 -c 0.015mm --scale alone.svg
lenscalc dof -m 1 -s 1m -N 11 -c 0.015mm --value focal --disc solved.svg
ls
