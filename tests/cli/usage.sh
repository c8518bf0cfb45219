# command lines that are wrong
for words in '-f 50 -f 60' '-f 50 -N 4 -s 3 extra' '-f 50 -N 4 -s' '--csv=1' '--model foo' \
    '--units yards' '--digits x'; do
    lenscalc dof $words
    echo "[$words] status $?"
done
lenscalc help nothing
echo "status $?"
lenscalc 2> short
echo "status $?"
head -n 1 short
# a number without its option
lenscalc dof 50
echo "status $?"
# words that mean something else
lenscalc version; lenscalc lenses; lenscalc ranges
lenscalc help topics | head -n 5
# an option is no value of the one before it
lenscalc optimize double-gauss --global --seconds 3
lenscalc optimize double-gauss --global --seconds=3
