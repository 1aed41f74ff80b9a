#!/bin/sh
# A firmware that is made from the file of a scene has the motion of `run` with
# the same file. `make test` has made the firmware.
# usage: test_own_scene.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
chaos=${FIRMWARE:-build/boards/host/chaos}
firmware=${chaos%/chaos}/own.scene-$real/firmware-own.elf
case $firmware in /*) ;; *) firmware=$root/$firmware ;; esac

"$firmware" >frames 2>err
equal 'the firmware runs' $? 0
# 5: at this dt some steps miss their tolerance.
expect 5 'scene own' monitor frames --csv --out got
expect 5 'scene      own' run "$root/tests/data/own.scene" --dt 1e-3 --t-end 2 \
  --out want
check 'and has the rows of run' cmp got want
finish
