#!/bin/sh
# What the command line writes is whole, or does not have the name of a whole
# file: killed, interrupted and full, with a second writer, through links and
# into what is not a file. usage: test_outputs.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
# there FILE...: those that are there.
there() { for file; do [ ! -e "$file" ] || echo "$file"; done; }

# begin FILE ARGS...: in the background, until FILE.part has rows.
begin() {
  file=$1
  shift
  rm -f "$file.part"
  "$T" "$@" >out 2>err &
  pid=$!
  poll has_lines "$file.part" 2
}
# finish_with SIGNAL: its exit code, in $code.
finish_with() {
  kill -s "$1" $pid
  wait $pid 2>/dev/null
  code=$?
}

# What is whole has its name, and nothing is beside it.
umask 022
echo old >private
chmod 600 private
for file in new private; do
  runs run chaos --t-end 0.01 --out $file
  equal "$file: no part is left" "$(there $file.part)" ''
done
check 'the same rows' cmp -s new private
equal 'a file keeps its permissions' "$(find private -perm 600)" private
equal 'a new one has the usual' "$(find new -perm 644)" new
expect 4 'step 2 was refused&its rows so far are in stop.part' \
  run frictionless --set k2=0 --set v=4e8 --set omega=0 --set c1=0 --set c2=0 \
  --dt 1 --t-end 10 --every 5 --out stop
equal 'a run that is refused a step: all rows before' "$(row 3 1 stop.part)" 1
check 'a run that is refused a step: no file' [ ! -e stop ]

# Links stay links; what they name is written, also where it is not there yet.
mkdir room
ln -s room/target link
runs run chaos --t-end 0.01 --out link
check 'a link to nothing: it names the rows' cmp -s room/target new
runs run chaos --t-end 0.01 --out link
check 'a link to a file: still a link' [ -L link ]
ln -s again again
expect 4 'symbolic links' run chaos --t-end 0 --out again
: >victim
ln -s victim trap.part
expect 4 '--out trap' run chaos --t-end 0 --out trap
check 'a part that is a link is not followed' [ ! -s victim ]
echo precious >victim
ln victim hard.part
expect 4 'hard link to another file' run chaos --t-end 0 --out hard
equal 'nor is a hard link' "$(cat victim)" precious

# What is not a regular file is written as it is.
mkfifo pipe
cat pipe >got &
reader=$!
runs run chaos --t-end 0.01 --out pipe
wait $reader
check 'a named pipe' cmp -s got new
runs run chaos --t-end 0.01 --out /dev/null
"$T" run chaos --t-end 0.01 --out /dev/stdout 2>err | cat >got
check '/dev/stdout, a pipe' cmp -s got new
{
  echo before
  "$T" run chaos --t-end 0.01 --out /dev/stdout 2>err
  echo after
} >got
equal '/dev/stdout, a file: nothing is lost around the rows' \
  "$(sed -n '1p;2p;$p' got | cut -d , -f 1 | tr '\n' ' ')" 'before t after '
echo before >got
"$T" run chaos --t-end 0.01 --out /dev/fd/3 3>>got 2>err
check '/dev/fd/3' cmp -s got - <<END
before
$(cat new)
END
equal 'none of them has a part' "$(there pipe.part got.part)" ''

set -- chaos --t-end 1e9 --every 100000
# One writer a file, under whatever name.
begin x run "$@" --out x
ln -s x other
for name in x ./x "$D/x" other; do
  expect 4 "--out $name: another program writes this file" \
    run chaos --t-end 0 --out "$name"
done
"$T" run chaos --t-end 0.01 --format frames --out stream 2>err
expect 4 'another program writes this file' monitor stream --format csv --out x
expect 4 'another program writes this file' \
  diverge chaos --samples 1 --patience 0.01 --exits y --returns x
equal 'and it leaves no file' "$(there y y.part)" ''
finish_with TERM
check 'the first writer did not notice' whole_rows x.part 10 '[0-9]'
begin x run "$@" --out x
mv x.part moved
finish_with TERM
equal 'a part that was moved away: code' "$code" 4
equal 'a part that was moved away: no file' "$(there x x.part)" ''
rm -f moved other

# nohup works, and without it SIGHUP stops a run as SIGTERM does.
(
  trap '' HUP
  exec "$T" run "$@" --out x 2>err
) &
pid=$!
poll has_lines x.part 2
kill -s HUP $pid
kill -s TERM $pid
wait $pid
equal 'nohup: only SIGTERM stops it' $? 4
check 'nohup: it is reported' says interrupted

finish
