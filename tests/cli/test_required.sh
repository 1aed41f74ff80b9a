#!/bin/sh
# What a check needs and does not find: where a list requires it that is a
# failure, elsewhere it is skipped by name; never does it vanish.
# usage: test_required.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
unset MAKEFLAGS MAKELEVEL MFLAGS MAKEOVERRIDES REQUIRED DRIVEN

# A make that knows two boards, of which one has no compiler.
cat >known <<'END'
#!/bin/sh
case "$*" in
*BOARD=alpha*board-CC) echo no-such-compiler ;;
*board-CC) echo sh ;;
*board-PACKAGES) echo no-such-package ;;
*boards-list*) echo alpha beta ;;
esac
END
chmod +x known
MAKE=$D/known
export MAKE
last() { tail -n 1 out; }

# boards REQUIRED NAME COUNT LINE: of a run of board alpha.
boards() {
  BUILD=$D/build REQUIRED=$1 "$root/tests/target/run" alpha >out 2>err
  equal "$2: the run fails" $? 1
  equal "$2: the count" "$(last)" "$3"
  check "$2: it is named" grep -q "^$4 alpha: no-such-compiler is missing" out
}
mkdir -p build
echo 'board alpha' >list
if [ -x /usr/bin/python3 ]; then
  boards "$D/list" 'a board that is required' '0 passed, 1 failed' FAILED
  boards '' 'a board that is not' '0 passed, 0 failed' skipped
  check 'a board that is not: it is counted' \
    grep -q '^1 boards skipped' out
else
  lacks 'boards without their compilers' python3
fi

# required LIST LAST TEXT...: what tools/verify/check/required says.
required() {
  REQUIRED=$D/$1 "$root/tools/verify/check/required" >out 2>err
  code=$?
  equal "$1: the count" "$(last)" "$2"
  equal "$1: the code" "$code" "$([ "${2#*passed, }" = '0 failed' ]; echo $?)"
  name=$1
  shift 2
  for text; do check "$name: $text" grep -qF "$text" out; done
}
printf '# all\n\ntool sh dash\nboard beta\nboard alpha\n' >with-a-board
printf 'tool sh dash\nboard beta\n' >unlisted
printf 'board beta\nboard alpha\ntool no-such-tool some-package
python no_such_module other\nsanitizers no-such-compiler third
else sh dash\n' >tools
required with-a-board '2 passed, 1 failed' \
  'missing: board alpha (apt-get install no-such-package)'
required unlisted '2 passed, 1 failed' 'not listed: board alpha'
required tools '1 passed, 5 failed' 'tool no-such-tool (apt-get install some' \
  'python no_such_module' 'sanitizers no-such-compiler' 'else sh'
equal 'packages to install' "$(
  REQUIRED=$D/tools "$root/tools/verify/check/required" packages |
    tr '\n' ' ')" \
  'dash other some-package third '
: >empty
REQUIRED=$D/empty "$root/tools/verify/check/required" >out 2>err
check 'an empty list is a failure' [ $? -ne 0 ]
unset MAKE
for board in $(make -s -C "$root" boards-list); do
  check "$board is on the list" grep -qx "board $board" "$root/.ci/required"
done

# A test that lacks a package.
cat >lacking.sh <<END
. "$root/tests/support/tap.sh"
lacks 'a picture' some-package
check 'all else' true
finish
END
TWOFOLD=$T "$root/tests/run" ./lacking.sh >out 2>err
check 'elsewhere it is skipped by name' \
  grep -q 'skipped: a picture: missing: some-package' out
equal 'elsewhere it is not counted' "$(last)" '1 passed, 0 failed'
REQUIRED=$D/tools TWOFOLD=$T "$root/tests/run" ./lacking.sh >out 2>err
equal 'where it is required it fails' "$(last)" '1 passed, 1 failed'
finish
