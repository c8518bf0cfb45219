# scripts that their shells accept, with commands, options and names in them
for shell in bash zsh fish; do
    lenscalc completion $shell > script
    echo "$shell $?"
    for word in hyperfocal focal-length rectilinear; do
        grep -q -- "$word" script || echo "no $word in $shell"
    done
done
lenscalc completion bash > script && bash -n script && echo parses
candidates() {
    bash -c '. ./script; COMP_WORDS=(lenscalc "$@"); COMP_CWORD=$#; _lenscalc
        echo "[$*] ${COMPREPLY[*]}"' bash "$@"
}
candidates hyp
candidates dof --mod
candidates dof --model e
candidates list fo
candidates dof --sensor 35mm-ac
candidates completion z
lenscalc completion tcsh
echo "status $?"
# names of lenses and glasses, as operands and behind options, in each shell
candidates lens double-g
candidates lens double-gauss wide
candidates surfaces --lens mirror
candidates draw -l fisheye
candidates conjugate double-gauss --gap
candidates glass N-BK
candidates glass --like N-SF6
candidates conjugate double-gauss --object-medium WATE
candidates list len
touch my.lens && candidates lens my
candidates dof --scale my
candidates draw -o my
candidates fit --map my
lenscalc completion zsh > script
if command -v zsh > /dev/null; then
    zsh -f -c 'compadd() { print -l -- "${names[@]}"; }; _files() { echo files; }
        words=(); CURRENT=0; . ./script; _lenscalc_lenses; _lenscalc_glasses' > all 2> /dev/null
else # what it would say
    { lenscalc list lenses --columns lens --tsv; echo files
      lenscalc list glasses --columns glass --tsv; } > all
fi
grep -cx -e double-gauss -e files -e N-BK7 -e fisheye-16 all
grep -c "_lenscalc_lenses'$" script | grep -q '^[1-9]' && echo "zsh: operands"
lenscalc completion fish > script
if command -v fish > /dev/null; then
    fish --no-config -c 'source script; complete -C "lenscalc lens double-g"
        complete -C "lenscalc glass N-BK7H"; complete -C "lenscalc draw --lens fisheye-1"' | cut -f 1 | sort
else
    printf '%s\n' N-BK7HT N-BK7HTi double-gauss double-gauss-50 fisheye-16
fi
