# how blurred what is not in focus is: in mm, of the picture, in pixels
lenscalc dof -f 85 -N 1.8 -s 2 --blur-at 10m
lenscalc dof -f 85,50 -N 1.8 -s 2 --blur-at 1m,10m,inf
lenscalc dof -f 50 -N 1.2 -s 2 --blur-behind 10m --sensor "Nikon D850" --csv \
    --columns background,background_blur,background_blur_pixels
lenscalc dof -f 85 -N 1.8 -s 2 --blur-at inf --jsonl --columns background,background_blur
lenscalc dof --lens double-gauss -N 2 -s 2 --from sensor --blur-at 2,3 --columns background,background_blur
lenscalc dof -f 85 -N 1.8 -s 2 --blur-at 10m --columns background_blur --explain
lenscalc dof -f 100 -N 8 --near 30cm --far 31cm --stack --blur-at 1m --columns shot,background_blur
for wrong in "--blur-at 0" "--blur-at 10m --blur-behind 3m" "--blur-at 10s" "--blur-behind -1m"; do
    lenscalc dof -f 85 -N 1.8 -s 2 $wrong
    echo "status $?"
done
lenscalc dof --lens double-gauss -N 2 -s 2 --exact --blur-at 10
echo "status $?"
lenscalc dof --lens double-gauss -N 2 -s 2 --from sensor --blur-at 1cm
echo "status $?"
