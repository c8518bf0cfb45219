# short help, the list of commands, one command, the version
lenscalc help | head -n 4
lenscalc help dof | head -n 3
lenscalc dof --help > one
lenscalc help dof > two
lenscalc help dof > three
cmp one two && cmp one three && echo same
lenscalc --version | sed 's/[0-9][0-9.]*/N/'
lenscalc -V | cut -d ' ' -f 1
lenscalc --help > four
lenscalc help > five
cmp four five && echo same
