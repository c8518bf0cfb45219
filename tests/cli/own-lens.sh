# the lens of a phone or compact camera, where only the camera is named
lenscalc dof --sensor "iPhone 15 Pro main" -s 2m
lenscalc dof --sensor "iPhone 15 Pro,iPhone 14 Pro" -s 2m --csv --columns sensor,focal,fnumber,near
lenscalc fov --sensor "iPhone 15 Pro" --json --columns focal,diagonal
lenscalc fov --sensor "iPhone 15 Pro" -f 24mm-eq
lenscalc fov --sensor "iPhone 15 Pro" --horizontal 40deg
lenscalc dof --sensor "iPhone 15 Pro" -f 7 -N 2 -s 2
printf 'f,sensor\n,iPhone 15 Pro\n7,iPhone 15 Pro\n,iPhone 14 Pro\n,35mm\n' |
    lenscalc dof -s 2 --batch - --csv --columns focal,fnumber,sensor,near
echo "status $?"
lenscalc dof -s 2 --sensor "Nikon D850"
echo "status $?"
