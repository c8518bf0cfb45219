# Defaults of what is solved for: a question that is whole without them is answered without them.
show() {
    echo "$*"
    lenscalc "$@" 2>&1
    status=$?
    [ $status = 0 ] || echo "status $status"
}
export LENSCALC_CONFIG=config
printf 'aperture = 8\ndistance = 5m\n[exposure]\niso = 400\n' > config
show dof 50mm --columns fnumber,distance,near
show dof 50mm --near 4m --columns fnumber,distance,near
show dof 35mm --near 2m --far 10m --columns fnumber,distance
show hyperfocal 35mm --hyperfocal 5m --columns fnumber,hyperfocal
show focus 100mm -m 1:1 --columns distance,fnumber
show exposure f/8 1/125 --columns ev100
show exposure f/8 1/125 --ev 12 --columns iso,deviation
# columns that say what is wanted
printf 'f,near,far\n35,2,10\n' > rows.csv
show dof --batch rows.csv --csv --columns f,N,s
# nothing helps: the message is that of the whole question
show dof 50mm --near 4m --far 3m
# of the lens and the focal length one is typed
printf 'lens = double-gauss\n' > config
show dof 50mm f/4 3m --columns near
show dof f/4 3m --columns near
printf 'f,N,s\n50,4,3\n' | show dof --batch - --csv --columns near
printf 'lens = double-gauss\nfocal-length = 50mm\n' > config
show dof f/4 -s 3m --columns near
# an option of the same name that is something else
printf 'from = sensor\n' > config
show dof 50mm f/4 3m --columns near,from
show bracket -t 1/60 --shots 5 --columns time
