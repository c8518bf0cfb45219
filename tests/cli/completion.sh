# scripts that their shells accept; what they offer is said by the program
for shell in bash zsh fish; do
    lenscalc completion $shell > script
    echo "$shell $? $(grep -c 'lenscalc completion words --' script)"
done
lenscalc completion bash > script && bash -n script && echo parses
lenscalc completion tcsh
echo "status $?"
lenscalc completion words
echo "status $?"
lenscalc completion bash dof
echo "status $?"
candidates() { echo "[$*]"; lenscalc completion words -- "$@" | cut -f 1 | head -n 4; }
echo "with meanings: $(lenscalc completion words -- d | grep -c "$(printf 'd[a-z]*\t[a-z]')")"
candidates hyp
candidates dof --mod
candidates dof IMG
candidates dof --model e
candidates dof --model=exact,pop
candidates list fo
candidates dof --sensor 35mm-ac
candidates completion z
candidates fit --prescription --go
# names of lenses and glasses, as operands and behind options
candidates lens double-g
candidates lens double-gauss wide
candidates surfaces --lens mirror
candidates draw -l fisheye
candidates conjugate double-gauss --gap
candidates glass N-BK
candidates glass --like N-SF6
candidates conjugate double-gauss --object-medium WATE
# positions of the lens that is named, wherever it stands
candidates draw nikkor-z-14-24 --position ''
candidates draw --position wide,t
candidates draw --lens=nikkor-z-14-24 --position wide,t
candidates draw nowhere.lens --position ''
# light, columns, criteria, planes, topics
candidates exposure --film hp
candidates exposure --scene full
candidates exposure --filter=k
candidates dof --columns near_m,fa
candidates dof -c ''
candidates spot double-gauss --focus t
candidates help st
candidates list columns hyp
candidates dof --color ''
# files are for the shell to find
candidates draw -o my
candidates fit --map=my
candidates convert --check ''
# nothing
candidates nothing ''
candidates dof --csv x
candidates dof --nothing x
