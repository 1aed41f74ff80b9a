#!/bin/sh
# There is help on every word that the command line itself uses: parameters,
# columns, modes, laws, rules, schemes, formats, options, keys, scenes. Its
# options are of one table (tools/cli/table.c), from which come the reading of
# command lines, help, manual page, suggestions and completions: an option of
# any command is in all of them.
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
# members ARGS...: the names in the JSON that a command prints.
members() {
  "$T" "$@" 2>&1 | grep -o '"[^"]*":' | tr -d '":' | sort -u
}
parameters=$(sed -n '/^names of --set/,$s/^  \([a-z0-9]*\) *\[.*/\1/p' pages |
  sort -u)
check 'parameters were found' [ "$(echo "$parameters" | wc -l)" -gt 24 ]
options=$(grep -o '"--[a-z][a-z0-9-]*", [N"]' "$root/tools/cli/table.c" |
  cut -d '"' -f 2 | sort -u)
check 'options were found' [ "$(echo "$options" | wc -l)" -gt 50 ]
"$T" run chaos --t-end 0.01 --format frames --out frames 2>err
# shellcheck disable=SC2046,SC2086  # lists of words
{
  words parameter $parameters law rest
  words option $options
  words column $("$T" run chaos --t-end 0 2>err | head -n 1 | tr , ' ')
  words scene $("$T" scenes | cut -d ' ' -f 1)
  words key $("$T" scene driven | sed 's/#.*//' | cut -d ' ' -f 1)
  words 'column of regions' $("$T" regions chaos --r 0:1:2 --omega=0:1:2 2>err |
    head -n 1 | tr , ' ')
  words 'column of sweep' $("$T" sweep chaos --over mu=1:1:1 --t-end 0 2>err |
    head -n 1 | tr , ' ')
  words outcome $("$T" help sweep | sed '1,/^outcomes:/d' | sed 's/^  //' |
    cut -d ' ' -f 1)
  words 'member of singularities' $(members singularities chaos |
    grep -v -e count -e two_folds -e rest -e directions -e 'eigenvalue$' \
      -e velocity -e sticks)
  words 'member of --summary json' \
    $(members run driven --t-end 0.1 --summary json --out rows --save at) \
    $(members sweep chaos --over mu=1:1:1 --summary json --out rows) \
    $(members diverge chaos --samples 1 --summary json --returns rows) \
    $(members monitor frames --summary json)
}
words mode slip+ slip- stick+ stick- pinned
laws=$(sed -n '/^  law  /{s///p;q}' pages | tr -d ,)
check 'laws were found' [ "$(echo "$laws" | wc -w)" -gt 5 ]
"$T" help law >laws
for law in $laws; do
  words law "$law"
  check "help law tells of $law" grep -q "^  $law  *[a-z]" laws
done
words rule persist slip+ slip- random
words rest hull square bow_tie
words scheme moreau located compensated
words format csv frames json plotter teleplot
"$T" run chaos --t-end 3 2>words >/dev/null
# shellcheck disable=SC2046  # one word each
words 'the summary' $(grep -oE '[a-z_]{4,}' words | sort -u |
  grep -vxE 'most|output|real|several|first|after|reached|fold')
words status 'done' flagged stopped refused
words 'what make makes' bench stability page fmu firmware
words others version exit inputs summary json provenance profile based-on

# tells WORD TEXT: what help on a word says.
tells() {
  run help "$1"
  check "help $1 tells: $2" grep -qF -e "$2" out
}
tells slip- '--select RULE of'
tells chaos "'twofold scene chaos' prints it"
expect 2 "no help on 'kapa'; did you mean 'kappa'?" help kapa
expect 2 "no help on 'xyzzy1234'; try" help xyzzy1234
expect 2 'help: one word at a time' help run chaos

# Options in what is made of their table.
"$root/tools/package/dist/manual" "$T" 1.0 | sed 's/\\-/-/g' >manual
for shell in bash zsh fish; do
  runs completions $shell
  mv out script.$shell
  if command -v $shell >/dev/null; then
    check "$shell accepts its completions" $shell -n script.$shell
  else
    lacks "$shell accepts its completions" $shell
  fi
done
for option in $options; do
  for file in pages manual script.bash script.zsh script.fish; do
    word=$option
    [ $file != script.fish ] || word="-l ${option#--}"
    grep -qE -e "(^|[^a-z-])$word([^a-z-]|\$)" $file ||
      result 1 "$file has $option"
  done
done
for command in $("$T" help | sed -n 's/^  \([a-z]*\) .*/\1/p' | sort -u |
  grep -v -e help -e scenes); do
  option=$("$T" help "$command" | sed -n 's/^  \(--[a-z0-9-]*\).*/\1/p' |
    sed -n '$p')
  [ -z "$option" ] ||
    expect 2 "did you mean '$option" "$command" "${option}q"
done

# Any word but those of the table is refused, and they are told; --send, whose
# words have payloads, names the help.
sed -n "s/^  \([a-z]*\):\(--[a-z0-9-]*\)) words='\([^ ]*\) .*/\1 \2 \3/p" \
  script.bash | grep -v -e --send >chosen
check 'options with words were found' [ "$(wc -l <chosen)" -gt 12 ]
while read -r command option first; do
  expect 2 "$option xyzzy&$first" "$command" chaos "$option" xyzzy
done <chosen

# completes WORDS EXPECTED: what bash offers behind them.
completes() {
  # shellcheck disable=SC2016  # the other shell's
  offered=$(bash -c '. ./script.bash; compopt() { :; }; COMP_WORDS=($0 "")
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _twofold
    echo "${COMPREPLY[*]}"' "$1")
  case " $offered " in *" $2 "*) ;; *) false ;; esac
  result $? "bash completes: $1 $2" "$offered"
}
if command -v bash >/dev/null; then
  completes twofold sweep
  completes 'twofold run' chaos
  completes 'twofold run chaos' --scheme
  completes 'twofold run chaos --scheme' located
  completes 'twofold completions' fish
else
  lacks 'what bash completes' bash
fi
expect 2 'of which shell? (bash zsh fish)' completions tcsh
finish
