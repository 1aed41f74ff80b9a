#!/bin/sh
# Every figure, drawn on small data: each panel has its marks.
. "$(dirname "$0")/lib.sh"
need gnuplot gnuplot-nox
/usr/bin/python3 -c 'import matplotlib' 2>/dev/null || {
  echo 'missing: matplotlib (apt-get install python3-matplotlib)'
  exit 3
}
setting gcc -O3
figures=$place/figures
rm -rf "$figures"
pictures=
count=0
for script in tools/study/figures/*.gp; do
  name=$(basename "$script" .gp)
  case $name in style | chaos) continue ;; esac # shared, and not of FIGURES
  pictures="$pictures $figures/$name.svg"
  count=$((count + 1))
done
# shellcheck disable=SC2086  # a list
in_common $pictures SAMPLES_random=400 SAMPLES_noise=6 SAMPLES_smoothing=4 \
  SAMPLES_hysteresis=3 SAMPLES_delay=3 \
  WINDOW='--r 0.1:0.28:37 --omega=-1.16:-0.88:29' \
  ATLAS='--r 0.0025:0.5:200 --omega=-1.4975:-0.5:20' ||
  wrong 'a figure cannot be drawn'
"$place/double/twofold" run chaos --t-end 10 --dt 1e-4 --every 10 \
  --out "$figures/chaos.csv" 2>"$BUILD/figures.said" || wrong 'no motion'
gnuplot -e "csv='$figures/chaos.csv'; out='$figures/chaos.svg'" \
  tools/study/figures/chaos.gp 2>"$BUILD/figures.said" || wrong 'no picture'
tools/study/figures/futures.py "$place/double/twofold" "$figures/futures.made"
cmp "$figures/futures.made" docs/futures.svg ||
  wrong 'docs/futures.svg is of another core: make keep-futures'
tests/study/panels.py "$figures"/*.svg >"$BUILD/figures.said" ||
  wrong 'a panel has no marks'
[ "$BAD" -eq 0 ] || cat "$BUILD/figures.said"
checked "$((count + 1)) figures on small data, every panel has its marks"
