# scripts that their shells accept, with commands, options and names in them
for shell in bash zsh fish; do
    lenscalc completion $shell > script
    echo "$shell $?"
    for word in hyperfocal focal-length rectilinear full-frame; do
        grep -q -- "$word" script || echo "no $word in $shell"
    done
done
lenscalc completion bash > script && bash -n script && echo parses
lenscalc completion tcsh
echo "status $?"
