#!/bin/sh
# The table of options (tools/cli/table.c) is what the reading of command lines,
# the help, the manual page, the suggestions and the completions are made of: an
# option of any command is in all of them.
# usage: test_options.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"

rows=$(grep -o '"--[a-z][a-z0-9-]*", [N"]' "$root/tools/cli/table.c" |
  cut -d '"' -f 2 | sort -u)
check 'the table was read' [ "$(echo "$rows" | wc -l)" -gt 50 ]
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

# has OPTION FILE: it is there as a word.
has() { grep -qE -e "(^|[^a-z-])$1([^a-z-]|\$)" "$2"; }
commands=$("$T" help | sed -n 's/^  \([a-z]*\) .*/\1/p' |
  grep -v -e help -e scenes | sort -u)
: >helped
for command in $commands; do
  runs help "$command"
  # shellcheck disable=SC2013  # words
  for option in $(sed -n 's/^  \(--[a-z0-9-]*\).*/\1/p' out); do
    echo "$option" >>helped
    run "$command" "${option}q"
    says "did you mean '$option" || result 1 "suggested by $command: $option"
    grep -qF -e "$command:$option)" script.bash ||
      grep -E "^  $command:\*\)" script.bash | grep -qF -e " $option " ||
      result 1 "bash completes $command $option"
    sed -n "/^  $command) /,/;;/p" script.zsh >part
    has "$option" part || result 1 "zsh completes $command $option"
    grep -F "from $command' -l ${option#--} " script.fish >part ||
      result 1 "fish completes $command $option"
  done
done
for option in $rows; do
  has "$option" helped || result 1 "help has $option"
  has "$option" manual || result 1 "the manual has $option"
done
run --version
check 'every option is in the help, the manual and the completions' \
  [ "$failed" -eq 0 ]

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
expect 2 'of which shell? (bash zsh fish)' completions
expect 2 'of which shell?' completions tcsh
finish
