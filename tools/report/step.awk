# The figures of one Moreau step and of the ensemble step, from what
# tools/bench/run and ensembles have printed; only double has figures to reach.
#   awk -v ensemble=FILE [-v why=1] -f step.awk STEPS
# Rows of the table, or with `why` reasons where a figure is not reached.
/^== / { wide = / double/ }
!wide { next }
function value(text) {
  if (index($0, "  " text) != 1) return ""
  text = substr($0, length(text) + 3)
  sub(/ *target.*/, "", text)
  sub(/^ */, "", text)
  return text
}
function take(name, text, v) {
  v = value(text)
  if (v != "") got[name] = v
}
{
  take("step", "instructions a step, mean over 10 s")
  take("rk4", "the same, smoothed RK4 with libm")
  take("counts", "RK4 / step in instructions")
  take("ns", "ns a step, median")
  take("times", "RK4 / step in time, median (10 %, 90 %)")
  take("stack", "stack of tf_step, worst, B")
  take("state", "state, B")
  if (value("ns a step, median") != "") timed = 1
  if (value("the same, smoothed RK4 with libm") != "")
    got[timed ? "rk4_ns" : "rk4_count"] = value("the same, smoothed RK4 with libm")
  if (value("stick goes on") != "") stick = $5
  if (value("stick goes on") != "") stick_usual = $6
  if (value("slip goes on") != "") slip = $6
}
function judge(measured, target, least) {
  if (measured !~ /^[0-9]/) return "not known: " measured
  if (least ? measured >= target : measured <= target) return "reached"
  return sprintf("not reached: %.3g times too %s", least ? target / measured : \
    measured / target, least ? "small" : "large")
}
function row(text, name, target, least, v) {
  v = (name in got) ? got[name] : "needs valgrind"
  printf "| %s | %s | %s | %s |\n", text, v ~ /^[0-9]/ ? v : "-", target,
    judge(v ~ /^[0-9]/ ? v + 0 : v, target, least)
}
function lanes(line, f, found) {
  while ((getline line <ensemble) > 0) {
    if (line ~ /^#/) missing = substr(line, 3)
    split(line, f, " ")
    if (f[2] != "spread") continue
    found++
    ratio[f[1]] = f[5]
    if (!why)
      printf "| ensemble step in %s: at least 3 times the throughput of single" \
        " steps, with AVX2 on one core | %s (10 %%: %s, 90 %%: %s) | 3 | %s |\n",
        f[1], f[5], f[6], f[7], judge(f[5] + 0, 3, 1)
  }
  close(ensemble)
  if (!found && !why)
    printf "| ensemble step: at least 3 times the throughput of single steps," \
      " with AVX2 on one core | - | 3 | not known: %s |\n", missing
}
END {
  if (ensemble != "") lanes()
  if (!why) {
    row("one Moreau step of `chaos` in double, instructions, mean over 10 s",
        "step", 350, 0)
    row("a step of smoothed-sign RK4 with libm by a Moreau step, in" \
        " instructions", "counts", 4, 1)
    row("the same in time, median (10 %, 90 %)", "times", 4, 1)
    row("stack of `tf_step` in double [B]", "stack", 512, 0)
    row("state in double [B]", "state", 64, 0)
    exit
  }
  if (got["step"] > 350)
    printf "* The Moreau step forms the quadratics h+ and g+ of the force, asks" \
      " every mode for its consistency and measures a residual that does not" \
      " know the answer. Of that a stick takes %d instructions at least (%d in" \
      " the median) and a slip, with two evaluations of T, %d.\n", stick,
      stick_usual, slip
  if (got["counts"] > 0 && got["counts"] < 4)
    printf "* A step of smoothed-sign RK4 takes %d instructions: a quarter of it" \
      " is %d, less than the shortest stick. Its instructions wait longer," \
      " though: %.2f ns each, those of the Moreau step %.2f ns. Nor does it" \
      " find what the Moreau step finds, all futures.\n", got["rk4_count"],
      got["rk4_count"] / 4, got["rk4_ns"] / got["rk4_count"],
      got["ns"] / got["step"]
  if (("double" in ratio) && (ratio["double"] < 3 || ratio["float"] < 3))
    printf "* The ensemble: a vector of AVX2 holds 4 doubles or 8 floats, and" \
      " twice the lanes bring %.2g times as much. Lanes have no branches: each" \
      " goes through all modes and keeps one, where a single step leaves out" \
      " what its phase does not need.\n", ratio["float"] / ratio["double"]
}
