#!/bin/sh
# The columns of every file that the command line writes, and who reads them:
# whoever changes a header learns which readers to look at. (That each of them
# fails where a column that it reads is gone is tested by check `figures`.)
# usage: test_columns.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"

# header NAME ARGS...: the first line of what a command writes.
header() { "$T" "$@" 2>err | head -n 1; }

# columns NAME HEADER READERS: of the file in `got`.
columns() {
  [ "$got" = "$2" ]
  result $? "columns of $1" "got '$got', want '$2'; it is read by: $3"
  for reader in $3; do
    check "columns of $1: there is $reader" [ -s "$root/$reader" ]
  done
}

figures=tools/study/figures
study=tools/study
got=$(header run chaos --t-end 0)
columns 'run' 't,r,v,omega,h,g,F,M,mode,choices' "$figures/curves.py
  $figures/chaos.gp tools/cli/monitor/receiver.c tests/cli/test_cli.sh"
"$T" run chaos --t-end 0.01 --format frames --out frames 2>err
got=$(header monitor frames --csv)
columns 'monitor' 't,r,v,omega,h,g,F,M,mode,choices' \
  'tests/cli/test_monitor.sh tests/target/run'
set -- diverge chaos --samples 1 --patience 0.01
got=$(header "$@" --exits -)
columns 'diverge --exits' \
  'sample,cycle,time,r,omega,g,side,phase,how,section_time' \
  "$figures/curves.py $study/cycles.py $study/exits.py"
got=$(header "$@")
columns 'diverge --returns' "sample,cycle,outcome,time,arrived,exit_r,$(
  )landing_time,landing_r,landings,windings" \
  "$figures/curves.py $figures/perturbations.gp $study/cycles.py
  $study/exits.py $study/recurrence.py"
got=$(header diverge chaos --exhaustive --depth 1 --grid 0.1 --patience 0.1)
columns 'diverge --branches' "node,depth,kind,r,omega,mode,stick_time,exit_r,$(
  )exit_omega,end,to,time,end_r,landing_r,windings" \
  "$figures/curves.py"
set -- chaos --r 0.1:0.2:2 --omega=-1:-0.9:2
got=$(header regions "$@")
columns 'regions' 'r,omega,region,lambda,delassus' "$figures/regions.gp"
got=$(header atlas "$@")
columns 'atlas' "r,omega,v,g,kappa,k2,K++,K+-,K-+,K--,J1,J2,K--_positive,$(
  )K++_negative,J1_negative,J2_negative,J1J2_above_1,kappa_positive,$(
  )k2_positive,overlap" "$figures/atlas.gp"
finish
