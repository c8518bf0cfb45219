# Defaults and kits of the user's own, from a file.
show() {
    echo "$*"
    lenscalc "$@" 2>&1
    status=$?
    [ $status = 0 ] || echo "status $status"
}
export LENSCALC_CONFIG=config
cat > config <<'END'
# what I have
sensor = "Fuji X-T5"    # in the bag
digits = 5

[dof]
coc = 20um
columns = near_m, far_m

[kit walk]
lens = double-gauss
aperture = 4

[kit "night"]
[kit night walk]
iso = 6400
nominal = yes
END
# what took part stands among the assumptions, with its line
show dof 50mm f/2.8 3m
show dof 50mm f/2.8 3m --json
show dof 50mm f/2.8 3m --format markdown
# and beside formats without a place for it
show dof 50mm f/2.8 3m --csv
show dof 50mm f/2.8 3m --jsonl
show dof 50mm f/2.8 3m --value near
# what is typed comes first
show dof 50mm f/2.8 3m --sensor 35mm -c 30um --digits 4 --columns dof
show dof 50mm f/2.8 3m --no-config --columns near
# what has nothing to say beside it gives way
show dof 50mm f/2.8 3m --print A2 --columns coc
show dof 50mm f/2.8,4 2m,3m --table f/2.8,s
show dof 50mm f/2.8,4 2m,3m --table N,s
# a kit says what the command has an option for
show dof -K walk 3m
show dof -K walk 3m -f 50mm --columns near
show exposure --kit "night walk" f/8 1/125 --columns ev100
show dof -K walk,night_walk 3m --columns near
show fov -K night,walk
show focus -K "night walk" -f 50mm -s 1m
show dof -K wlak 3m
show dof -K walk --no-config 3m
# rows of a batch: a column comes first, and takes the place of a lens
printf 'f,N,s,sensor\n50,2.8,3,\n50,2.8,3,35mm\n' > rows.csv
show dof --batch rows.csv --csv
show dof --batch rows.csv --csv -K walk
show list config
show list config --kind walk --csv
# without a file; an empty name is none
LENSCALC_CONFIG= show list config
LENSCALC_CONFIG= show dof -K walk 3m
LENSCALC_CONFIG=nowhere show dof 50mm f/2.8 3m
unset LENSCALC_CONFIG
show list config
show dof -K walk 3m
mkdir -p .config/lenscalc etc/lenscalc
echo 'sensor = aps-c' > .config/lenscalc/config
echo 'sensor = 4/3' > etc/lenscalc/config
show dof 50mm f/2.8 3m --columns near
XDG_CONFIG_HOME=$PWD/etc lenscalc dof 50mm f/2.8 3m --json --columns near | sed "s,$PWD,HERE,"
