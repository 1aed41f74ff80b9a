#!/bin/sh
# There is help on every word that the command line itself uses: parameters,
# columns, modes, laws, rules, schemes, formats, options, keys, scenes.
# usage: test_help.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"

"$T" help >pages
commands=$(sed -n 's/^  \([a-z]*\) .*/\1/p' pages | sort -u)
for command in $commands; do
  runs help "$command"
  cat out >>pages
done
check 'commands were found' [ "$(echo "$commands" | wc -l)" -gt 8 ]

# words NAME WORD...: help on each, with nothing missing in it.
words() {
  name=$1
  shift
  for word; do
    run help "$word"
    [ "$code" -eq 0 ] && [ -s out ] && ! grep -qF '(null)' out
    result $? "$name: help $word" "code $code"
  done
}
parameters=$(sed -n '/^names of --set/,$s/^  \([a-z0-9]*\) *\[.*/\1/p' pages |
  sort -u)
check 'parameters were found' [ "$(echo "$parameters" | wc -l)" -gt 24 ]
options=$(grep -o -e '--[a-z][a-z0-9-]*' pages | grep -v -e '--version' |
  sort -u)
check 'options were found' [ "$(echo "$options" | wc -l)" -gt 30 ]
# shellcheck disable=SC2046,SC2086  # lists of words
{
  words parameter $parameters law rest
  words option $options
  words column $("$T" run chaos --t-end 0 2>err | head -n 1 | tr , ' ')
  words scene $("$T" scenes | cut -d ' ' -f 1)
  words key $("$T" scene driven | sed 's/#.*//' | cut -d ' ' -f 1)
}
words mode slip+ slip- stick+ stick- pinned
words law jump coulomb two_piece string smooth none
words rule persist slip+ slip- random
words rest hull square bow_tie
words scheme moreau located compensated
words format csv frames plotter
# shellcheck disable=SC2046  # lists of words
{
  words 'column of regions' $("$T" regions chaos --r 0:1:2 --omega=0:1:2 2>err |
    head -n 1 | tr , ' ')
  words 'column of sweep' $("$T" sweep chaos --over mu=1:1:1 --t-end 0 2>err |
    head -n 1 | tr , ' ')
  words outcome $("$T" help sweep | sed '1,/^outcomes:/d' | sed 's/^  //' |
    cut -d ' ' -f 1)
  words 'member of singularities' $("$T" singularities chaos |
    grep -o '"[^"]*":' | tr -d '":' | grep -v -e count -e two_folds -e rest |
    sort -u | grep -v -e directions -e eigenvalue$ -e velocity -e sticks)
}
# shellcheck disable=SC2046
words 'member of --summary json' $({
  "$T" run driven --t-end 0.1 --summary json --out rows --save at
  "$T" sweep chaos --over mu=1:1:1 --t-end 0 --summary json --out rows
  "$T" diverge chaos --samples 1 --summary json --returns rows
  "$T" run chaos --t-end 0.01 --format frames --out frames
  "$T" monitor frames --summary json
} 2>&1 | grep -o '"[^"]*":' | tr -d '":' | sort -u)
words status 'done' flagged stopped refused
words 'what make makes' bench stability page fmu firmware
words others version exit inputs summary json provenance profile based-on

# tells WORD TEXT: what help on a word says.
tells() {
  run help "$1"
  check "help $1 tells: $2" grep -qF -e "$2" out
}
tells kappa 'moment per force in stick'
tells segments 'how many segments a step may take'
tells kappa '[1e-09, 1e+06] m, only in law'
tells c1 'damping of the disc'
tells theta '[0.5, 1]'
tells string 'Scene string'
tells string 'stretched string with partial slip'
tells exit '5 done, but'
tells chaos "'twofold scene chaos' prints it"
expect 2 "no help on 'kapa'; did you mean 'kappa'?" help kapa
expect 2 "no help on 'inpts'; did you mean 'inputs'?" help inpts
expect 2 "no help on 'sumary'; did you mean 'summary'?" help sumary
expect 2 "no help on 'xyzzy1234'; try" help xyzzy1234
expect 2 'help: one word at a time' help run chaos
finish
