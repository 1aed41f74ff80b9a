# Writes STABILITY.md from the list of sweeps and from all cells. Exit code 1
# where a promise of the core is broken.
#   awk -f report.awk -v seconds=S LIST CELLS

function stable(verdict) { return verdict == "ok" || verdict == "degraded" }

# A table's first lines.
function head(text, i, n, column) {
  print text
  n = split(text, column, "|") - 2
  printf "|"
  for (i = 1; i <= n; i++) printf "---|"
  print ""
}
function columns(i, text) {
  text = ""
  for (i = 1; i <= combos; i++) text = text " " combo[i] " |"
  return text
}
function max(a, b) { return a > b ? a : b }
function or_dash(x) { return x == "" ? "-" : x }

FILENAME != last { file++; last = FILENAME }
file == 1 {
  split($0, part, "|")
  name[++names] = part[1]
  axis[part[1]] = part[2] (part[3] == "" ? "" : " [" part[3] "]")
  where[part[1]] = part[4]
  next
}
{
  split($0, f, ",")
  sweep = f[1]
  value = f[3]
  c = f[4] " " f[5]
  dt = f[6]
  verdict = f[7]
  if (!(c in have)) { have[c] = 1; combo[++combos] = c }
  if (!((sweep, f[2]) in label)) values[sweep] = max(values[sweep], f[2] + 1)
  label[sweep, f[2]] = value
  if (!(dt in dts)) { dts[dt] = 1; size[++sizes] = dt }
  cells++
  steps += f[10]
  count[c, verdict]++
  all[c]++
  cells_of[sweep, c]++
  if (stable(verdict)) good[sweep, c]++
  if (verdict == "physics") physics[sweep, c]++
  if (verdict == "bad_parameter") taken_not[sweep, c]++
  broken += verdict == "non_finite" || verdict == "touched"
  non_finite += verdict == "non_finite"
  touched += verdict == "touched"
  if (f[8] != "") {
    refused[c, f[8]]++
    refusals++
    if (f[9] == "") goes_on[c, f[8]]++
  }
  steps_of[c] += f[10]
  degraded[c] += f[11]
  fell_back[c] += f[12]
  coarse[c] += f[22]
  if (f[11] > 0) degraded_in[sweep, c] += f[11]
  if (f[12] > 0) fell_back_in[sweep, c] += f[12]
  if (f[22] > 0) coarse_in[sweep, c] += f[22]
  sticks[sweep, c] += f[13]
  drift[sweep, c] = max(drift[sweep, c], f[14] + 0)
  # Sizes come in rising order: the first that fails ends the stable ones.
  i = f[2]
  if (stable(verdict) || verdict == "physics") {
    if (!((sweep, i, c) in failed)) largest[sweep, i, c] = dt
    else again[sweep, i, c] = 1
    if (verdict == "physics") ends[sweep, i, c] = 1
  } else {
    failed[sweep, i, c] = 1
    if (!((sweep, i, c) in why)) why[sweep, i, c] = verdict
  }
  if (f[17] == 1) {
    first[sweep, i, c, dt] = f[18]
    second[sweep, i, c, dt] = f[19]
    end_of[sweep, i, c, dt] = f[20]
    judged[sweep, i, c, dt] = verdict
  }
  if (f[16] == 1) grows[sweep, i] = 1
}

# The largest stable step of one row.
function largest_text(s, i, c) {
  if (why[s, i, c] == "bad_parameter") return "n/a"
  if (!((s, i, c) in largest)) return "none: " why[s, i, c]
  return largest[s, i, c] (ends[s, i, c] ? "*" : "") \
    ((s, i, c) in failed ? " " why[s, i, c] : "") (again[s, i, c] ? "+" : "")
}

function promises() {
  print "## Promises\n"
  printf "%d cells, %d accepted steps, %d runs that ended in a refusal, %d s.\n\n", \
    cells, steps, refusals, seconds
  head("| what must never happen | how often |")
  print "| an accepted step leaves a number that is not finite, in the state or" \
    " in the report | " non_finite " |"
  print "| a refused step changes a bit of the state, or returned and reported" \
    " status differ | " touched " |\n"
}

function verdicts(i, j, n, v) {
  print "## Verdicts\n"
  n = split("ok degraded physics too_long diverged created bad_parameter", v, " ")
  head("| real, scheme | cells | ok | degraded | physics | too_long | diverged" \
    " | created | bad_parameter |")
  for (i = 1; i <= combos; i++) {
    printf "| %s | %d |", combo[i], all[combo[i]]
    for (j = 1; j <= n; j++) printf " %d |", count[combo[i], v[j]]
    print ""
  }
  print ""
}

function sweeps_table(i, s, j, c) {
  print "## Stable cells of each sweep\n"
  print "Stable (and, after a plus sign, ended by the motion itself) of all.\n"
  head("| sweep | axis | differs from scene chaos |" columns())
  for (i = 1; i <= names; i++) {
    s = name[i]
    printf "| %s | %s | %s |", s, axis[s], or_dash(where[s])
    for (j = 1; j <= combos; j++) {
      c = combo[j]
      if (taken_not[s, c] == cells_of[s, c]) printf " n/a |"
      else
        printf " %d%s/%d |", good[s, c], \
          physics[s, c] ? "+" physics[s, c] : "", \
          cells_of[s, c] - taken_not[s, c]
    }
    print ""
  }
  print ""
}

function refusals_table(i, j, n, code) {
  print "## Refusals\n"
  print "Runs that ended in a refusal, by reason; in brackets how many of them" \
    "\nthe same scheme carries on with 1024 steps of dt/1024 (not below 1e-9 s)." \
    "\nTF_BAD_PARAMETER stands for cases that the scheme does not take at all.\n"
  n = split("TF_STEP_TOO_LONG TF_DIVERGED TF_BAD_STATE TF_BAD_PARAMETER", code, " ")
  head("| real, scheme | TF_STEP_TOO_LONG | TF_DIVERGED | TF_BAD_STATE |" \
    " TF_BAD_PARAMETER |")
  for (i = 1; i <= combos; i++) {
    printf "| %s |", combo[i]
    for (j = 1; j < n; j++)
      printf " %d (%d) |", refused[combo[i], code[j]], \
        goes_on[combo[i], code[j]]
    printf " %d |\n", refused[combo[i], code[n]]
  }
  print ""
}

function degraded_table(i, j, s, any, text) {
  print "## Degraded steps\n"
  print "Accepted steps in which no mode was consistent (TF_DEGRADED), and" \
    "\nsteps that tf_step_located left to tf_step (TF_FELL_BACK) or took with a" \
    "\ncoarser tolerance than asked for (TF_COARSE).\n"
  head("| real, scheme | accepted steps | degraded | fell back | coarse |")
  for (i = 1; i <= combos; i++)
    printf "| %s | %d | %d | %d | %d |\n", combo[i], steps_of[combo[i]], \
      degraded[combo[i]], fell_back[combo[i]], coarse[combo[i]]
  print "\nWhere they are (degraded / fell back / coarse):\n"
  head("| sweep |" columns())
  for (i = 1; i <= names; i++) {
    s = name[i]
    any = 0
    text = "| " s " |"
    for (j = 1; j <= combos; j++) {
      any += degraded_in[s, combo[j]] + fell_back_in[s, combo[j]] + \
        coarse_in[s, combo[j]]
      text = text " " degraded_in[s, combo[j]] + 0 " / " \
        fell_back_in[s, combo[j]] + 0 " / " coarse_in[s, combo[j]] + 0 " |"
    }
    if (any) print text
  }
  print ""
}

function stick_table(i, j, s) {
  print "## Stick\n"
  print "Largest |h| in stick, in units of the rounding of its terms," \
    "\nepsilon (|v| + (|d| + |r|)(|w| + |omega0|)), summed over both ends of the" \
    "\nstep; a dash where the wheel never sticks. Below 1 nothing drifts: h is 0" \
    "\nas far as the real type can tell.\n"
  head("| sweep |" columns())
  for (i = 1; i <= names; i++) {
    s = name[i]
    printf "| %s |", s
    for (j = 1; j <= combos; j++) {
      if (sticks[s, combo[j]]) printf " %.3g |", drift[s, combo[j]]
      else printf " - |"
    }
    print ""
  }
  print ""
}

# One conservative sweep in one real type and scheme: rows values, columns dt.
function drift_table(s, c, i, n, text) {
  print "`" s "`, " c ":\n"
  text = "| " axis[s] " |"
  for (n = 1; n <= sizes; n += 2) text = text " dt = " size[n] " |"
  head(text)
  for (i = 0; i < values[s]; i++) {
    printf "| %s |", label[s, i]
    for (n = 1; n <= sizes; n += 2) {
      printf " %s", first[s, i, c, size[n]]
      if (stable(judged[s, i, c, size[n]]))
        printf " / %s", second[s, i, c, size[n]]
      else printf ", %s", judged[s, i, c, size[n]]
      printf " |"
    }
    print ""
  }
  print ""
}

function energy_tables(j) {
  print "## Energy without friction and damping\n"
  print "Largest |E - E0| / E0 in the first and in the second half of the run." \
    "\nTwo equal figures are an oscillation about the true energy; a second" \
    "\ntwice the first is a drift. theta = 1 takes energy out of what it does" \
    "\nnot resolve (its figure tends to 1), theta = 1/2 does not.\n"
  for (j = 1; j <= combos; j++) {
    drift_table("conservative", combo[j])
    drift_table("spinning", combo[j])
  }
}

function centrifugal_table(i, j, n, s, c) {
  s = "centrifugal"
  print "## Centrifugal instability\n"
  print "Below k2 = m w^2 the motion itself grows as exp(sqrt(w^2 - k2/m) t):" \
    "\nthat is told from the parameters (column `motion`), before any scheme is" \
    "\nblamed. The figure is |E - E0| / E0 at the end for dt = " size[sizes - 4] \
    ".\n"
  head("| k2 / (m w^2) | motion |" columns())
  for (i = 0; i < values[s]; i++) {
    printf "| %s | %s |", label[s, i], grows[s, i] ? "grows" : "oscillates"
    for (j = 1; j <= combos; j++)
      printf " %s %s |", judged[s, i, combo[j], size[sizes - 4]], \
        end_of[s, i, combo[j], size[sizes - 4]]
    print ""
  }
  print ""
}

function largest_tables(i, s, k, j) {
  print "## Largest stable step\n"
  print "dt in s, of " size[1] " to " size[sizes] ": it and all smaller ones are" \
    "\nstable. The word says how the next larger one fails; no word: none fails." \
    "\nA star: the motion itself left the range of states in some of them. A" \
    "\nplus sign: some larger step is stable again.\n"
  for (i = 1; i <= names; i++) {
    s = name[i]
    print "### " s (where[s] == "" ? "" : ": " where[s]) "\n"
    head("| " axis[s] " |" columns())
    for (k = 0; k < values[s]; k++) {
      printf "| %s%s |", label[s, k], grows[s, k] ? " (k2 < m w^2)" : ""
      for (j = 1; j <= combos; j++) printf " %s |", largest_text(s, k, combo[j])
      print ""
    }
    print ""
  }
}

END {
  while ((getline line <"tools/stability/preface.md") > 0) print line
  print ""
  promises()
  verdicts()
  sweeps_table()
  refusals_table()
  degraded_table()
  stick_table()
  centrifugal_table()
  energy_tables()
  largest_tables()
  exit broken > 0
}
