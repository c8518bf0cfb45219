# What is wrong with a file of defaults, by line and column; help is there all the same.
bad() {
    printf "$1" > config
    shift
    echo "-- $(tr '\n' '|' < config)"
    lenscalc "$@" 2>&1 > out
    echo "status $?"
}
export LENSCALC_CONFIG=config
bad 'sensr = 35mm\n' dof 50mm f/2.8 3m
bad '[dofx]\ncoc = 20um\n' dof 50mm f/2.8 3m
bad '[kit]\ncoc = 20um\n' dof 50mm f/2.8 3m
bad '[kit a,b]\ncoc = 20um\n' dof 50mm f/2.8 3m
bad '[dof\ncoc = 20um\n' dof 50mm f/2.8 3m
bad '[dof]\nshutter = 20um\n' dof 50mm f/2.8 3m
bad '[help]\ntopic = units\n' dof 50mm f/2.8 3m
bad '[dof]\ncoc = 20um\ncoc = 30um\n' dof 50mm f/2.8 3m
bad 'coc 20um\n' dof 50mm f/2.8 3m
bad 'coc =\n' dof 50mm f/2.8 3m
bad 'coc = "20um\n' dof 50mm f/2.8 3m
bad 'coc = "20um" 3\n' dof 50mm f/2.8 3m
bad 'columns = near\n' dof 50mm f/2.8 3m
bad 'output = x\n' dof 50mm f/2.8 3m
bad 'fail_fast = yes\n' dof 50mm f/2.8 3m
bad '[dof]\nN = 4\n' dof 50mm 3m
bad 'coc = 20s\n' dof 50mm f/2.8 3m
bad 'coc = 20nn # wide\n' dof 50mm f/2.8 3m
bad 'aperture = 0\n' dof 50mm 3m
bad 'sensor = Fuji X-T55\n' dof 50mm f/2.8 3m
bad 'nominal = maybe\n' dof 50mm f/2.8 3m
bad 'lens = -\n' dof f/4 3m
HOME=/none bad 'agf = ./no.agf\nlensdb = ~/nothing\n' dof --lens double-gauss -N 4 -s 3m
bad 'sensor = a\000b\n' dof 50mm f/2.8 3m
bad '[kit a]\ncoc = 20um\n[kit b]\ncoc = 30um\n' dof 50mm f/2.8 3m -K a,b
# one that only other commands read wrong is no matter here
bad 'coc = 20s\n' list units --kind angle
# help, and what takes no defaults
bad 'nonsense\n' help dof
bad 'nonsense\n' dof --help
bad 'nonsense\n' dof -h
bad 'nonsense\n' completion words -- dof --mod
bad 'nonsense\n' --version
bad 'nonsense\n' dof --no-config 50mm f/2.8 3m
bad 'nonsense\n' list config
