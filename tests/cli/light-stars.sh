# longest exposures of stars by exact trail and by rules, and trails of an exposure
lenscalc stars -f 24mm -N 2.8 --pitch 4.35um
lenscalc stars -f 14..50:6 -N 2.8 --pitch 5um --trail 2px
lenscalc stars -f 50 --declination 60deg -t 20s --csv --digits 6
lenscalc stars -t 15s --declination 45deg --columns focal,star_trail
lenscalc stars -f 24 --sensor aps-c --rule 400 --columns rule_of_thumb,four_minus_crop,crop_factor
lenscalc stars -f 5 --declination 89.99deg --trail 1mm --json --digits 6 --columns exact,linear
# a rule that has no constant
lenscalc stars -f 24 --rule npf
