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
