#!/bin/sh
# Scenes as files: what is printed reads back to the same bits, every command
# takes a file, and what is wrong in it is named by line, key and range.
# usage: test_scene_file.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"

# There and back, for the text and for the motion.
for scene in $("$T" scenes | cut -d ' ' -f 1); do
  runs scene "$scene" --out one.scene
  runs scene ./one.scene --out two.scene
  check "$scene: printed again, the same text" cmp one.scene two.scene
  runs run "$scene" --t-end 3 --every 7 --out want
  runs run one.scene --t-end 3 --every 7
  check "$scene: from a file, the same motion" cmp out want
done

# What the command line changes is in the file.
set -- --set kappa=0.3 --set law=smooth --set epsilon=1e-3 --set r=0.2 \
  --set v=0.5 --dt 1e-3 --select slip+
runs scene driven "$@" --out changed.scene
runs run driven "$@" --t-end 2 --out want
runs run changed.scene --t-end 2
check 'settings are kept in the file' cmp out want
runs run changed.scene --set v=0.25 --t-end 0.01 --out one
runs run driven "$@" --t-end 0.01 --out two
check 'settings change a file, too' not cmp -s one two
expectations scene <<'WORDS'
2 chaos --select random:7|a scene has no seed
2 chaos --set phi=1|phi=1&starts with phi = 0
3 chaos --set kappa=-1|kappa must lie in [1e-09, 1e+06] m
2 chaos --set kapa=1|did you mean 'kappa'?
2 |which scene?
WORDS
runs scene chaos --select random
check 'the rule is kept' grep -q '^rule  *random' out

# Every command takes a file.
printf 'name mine\nbased-on chaos\n' >late.scene
printf 'based-on chaos\r\nname mine\r\nkappa\t0.27\r\n' >mine.scene
runs singularities mine.scene
check 'singularities: the name' grep -q '"mine"' out
runs regions mine.scene --r 0:1:2 --omega=-1:1:2
runs design mine.scene --r 0.2 --omega=-1.04
runs atlas mine.scene --r 0.1:0.2:2 --omega=-1.1:-1.05:2
runs diverge ./mine.scene --samples 2
runs run mine.scene --t-end 0.01 --format frames
check 'frames: the name' grep -qa mine out

# What is wrong, where.
wrong_files wrong.scene run wrong.scene <<'WORDS'
2|based-on chaos\nkapa 0.3\n|2: unknown key&did you mean 'kappa'
2|based-on chaos\nkappa 0.3\n# twice\nkappa = 0.2\n|4: kappa was already given
2|based-on chaos\nkappa 0.3m\n|2: kappa: '0.3m' is not a number
3|based-on chaos\nkappa -0.5\n|2: kappa = -0.5 must lie in [1e-09, 1e+06] m
3|based-on chaos\ndt nan\n|2: dt = nan must lie in
3|r 1e10\n|1: r = 10000000000 must lie in [-1e+09, 1e+09] m
3|based-on chaos\nt-end -1\n|2: t-end = -1 must lie in [0, 1e+09] s
3|based-on chaos\nlaw string\n| k is missing, which law string needs
2|m 1\n| law is missing
2|law none\nr 0\nomega 0\nt-end 1\n| v or h is missing
2|law jmp\n|1: law: unknown law&did you mean 'jump'
2|rule random:7\n|1: rule: a seed is not part of a scene
3|based-on driven\nprofile 0:-1 1:1e9\n|2: profile: omega0 = 1e9 must lie in
3|based-on chaos\nsegments 1.5\n|2: segments must be
2|rest bow\n|1: rest: unknown law of rest
2|with-angle 1\n|1: with-angle: '1' must be yes or no
2|based-on chaos\nh 0\nv 1\n|3: v: give h or v
2|m 1\nbased-on chaos\n|2: based-on: must be the first key
2|based-on chaso\n|1: based-on: unknown scene&did you mean 'chaos'
2|profile 1 2\n|1: profile: '1': expected T:OMEGA0
3|profile 0:1 1:2 0.5:3\n|1: profile: 0.5 s is not later
3|profile 0:1 1:2 1:3 1:4\n|1: profile: 1 s is not later
2|profile 0:0 1:0 2:0 3:0 4:0 5:0 6:0 7:0 8:0\n|1: profile: more than 8 knots
2|kappa = # none\n|1: kappa: expected a value
2|m \310\n|1: column 3: byte 200 is not ASCII
2|name a b\n|1: name: 'a b'
2|shows "quoted"\n|1: shows: expected at most 127
2|%600s\n|1: the line has more than 511
WORDS
mv wrong.scene 'no name.scene'
echo 'based-on chaos' >'no name.scene'
expect 2 'is no name of a scene&give' run './no name.scene'
expect 2 'none.scene: No such file' run none.scene
expect 2 'unknown scene&a file has a . or a /' run none
expect 2 'Is a directory' run ./
expect 2 'late.scene:2: based-on: must be the first key' run late.scene
head -c 20000 /dev/zero | tr '\0' '\n' >long.scene
expect 2 'long.scene: longer than 16384 bytes' run long.scene
expect 2 'one scene at a time (mine was given)' run mine.scene chaos
finish
