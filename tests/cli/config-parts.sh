# Parts of a divided run carry the defaults that they were made with; merge takes none.
export LENSCALC_CONFIG=config
printf "[tolerance]\ngrade = precision\n[kit few]\ntrials = 30\n" > config
lenscalc tolerance double-gauss -K few --part 1/2 -o 1.part > /dev/null
# the same, typed
lenscalc tolerance double-gauss --part 2/2 --grade precision --trials 30 --no-config -o 2.part > /dev/null
printf '[tolerance]\ntrials = 99\n' > config
lenscalc merge 1.part 2.part > merged
lenscalc tolerance double-gauss --grade precision --trials 30 | cmp - merged && echo same
lenscalc merge 1.part 2.part --no-config
# and a picture
printf '[render]\nlens = double-gauss-50\ndistance = 3m\nsize = 24x16\nsamples = 2\n' > config
lenscalc render chart:star --part 1/2 -o 3.part 2> /dev/null
lenscalc render chart:star --part 2/2 -o 4.part
lenscalc merge 3.part 4.part -o merged.png 2> /dev/null
lenscalc render chart:star -o whole.png 2> /dev/null
cmp merged.png whole.png && echo same
