# The figures that the report should reach, each judged by what was measured.
#   awk -f figures.awk -v peers=0|1 -v step_rows=F -v step_why=F \
#     sweep.csv costs.csv digits.csv [peers.csv]
FNR == 1 { file++; next }
file == 1 {
  split($0, f, ",")
  if (f[3] != "double") next
  if (f[1] != "codim2" && f[1] != "crossings") next
  s = (f[1] == "codim2" ? "chaos" : "crossings") "," f[2] "," f[4]
  if (f[4] == "order") s = (f[1] == "codim2" ? "chaos" : "crossings") \
    ",located,coarse tolerance"
  add(s, f[12], f[8])
  next
}
file == 2 {
  split($0, f, ",")
  if (f[2] != "double" || f[3] != "located" || f[4] != "generic") next
  w = f[5] "," f[6] "," f[1]
  worst_of[++steps] = w
  worst[w] = f[10] / f[8]
  longest[w] = f[10]
  usual[w] = f[8]
  next
}
file == 3 {
  split($0, f, ",")
  k = f[1]
  if (index(k, "/")) { # a scene, and how many steps
    sub(/.*\//, "", k)
    if (!(k in runs)) lengths[++long_runs] = k
    runs[k]++
    within[k] += f[9] == "within 3"
    below[k] += f[9] ~ /ulp/
    scene = f[1]
    sub(/\/.*/, "", scene)
    if (f[9] == "not reached")
      missed = missed sprintf("* Compensated float on `%s` is %s off, %s times" \
        " the scheme's error.%s\n", f[1], f[6], f[7], (scene in own_error) ? \
        sprintf(" The motion spreads what rounding F and M to floats begins:" \
          " since `%s` that error has grown %.2g times and the scheme's own" \
          " %.2g times.", shorter[scene], f[6] / float_error[scene],
          f[3] / own_error[scene]) : "")
    own_error[scene] = f[3]
    float_error[scene] = f[6]
    shorter[scene] = f[1]
    next
  }
  if (!(k in last)) digits[++problems] = k
  if (f[7] > ratio[k]) { ratio[k] = f[7]; at[k] = f[2] }
  last[k] = f[7]
  finest[k] = f[2]
  next
}
file == 4 {
  split($0, f, ",")
  if (f[1] == "problem" || f[2] ~ /^twofold/) next
  setting = f[3]
  s = f[1] "," f[2]
  if (split(setting, word, " ") > 1) s = s " " word[1]
  add("peer " s, f[6], f[5])
}
function add(s, time, error) {
  if (!(s in n)) { list[++lists] = s; n[s] = 0 }
  n[s]++
  t[s, n[s]] = time + 0
  e[s, n[s]] = error ~ /inf/ ? 1e99 : error + 0
}
# The least time of a setting of a series that keeps an error, as do the next
# two finer ones; the best series of a group by its first words.
function least(head, error, i, j, k, s, good, best) {
  best = 1e99
  who = ""
  for (k = 1; k <= lists; k++) {
    s = list[k]
    if (index(s, head) != 1) continue
    for (i = 1; i < n[s]; i++) {
      good = 1
      for (j = i; j <= i + 2 && j <= n[s]; j++) if (e[s, j] > error) good = 0
      if (good && t[s, i] < best) { best = t[s, i]; who = s }
    }
  }
  return best
}
function us(time) { return time >= 1e99 ? "never" : sprintf("%.3g us", time / 1e3) }
# Where the time goes, for what is not reached.
function why(run, own) {
  print "\nWhy, where a figure is not reached:\n"
  run = "cycle,100,ns"
  own = least("chaos,located,", 1e-6)
  if (run in longest && own < 1e99)
    printf "* `located` on `chaos`: the way through h = g = 0 costs most. At the" \
      " tolerance 1e-8 and steps of 20 ms it is one step of %.2g us, where a" \
      " usual step takes %.2g us; that step is also what is longer than 8 times" \
      " the median. The run to 1e-6, in a longer step, takes %.2g us in all.\n",
      longest[run] / 1e3, usual[run] / 1e3, own / 1e3
  run = "crossings,100,ns"
  own = least("crossings,located,", 1e-6)
  if (run in longest && own < 1e99)
    printf "* `located` on `crossings`: a step of 20 ms takes %.2g us in the" \
      " median and %.2g us at most; the run to 1e-6 takes %.3g us, of which" \
      " preparation is less than 1 us. It is the series, not the switches," \
      " that costs.\n", usual[run] / 1e3, longest[run] / 1e3, own / 1e3
  print "* `moreau` on `crossings`: across a switch its error falls with the" \
    " first power of dt, while a peer that locates switches has its order."
  if (peers)
    print "* The best peer, `events-dp5`, is written by hand for this law alone," \
      " without solution set, rule or report, and compiled for this processor" \
      " with contracted operations; the core is not, to keep its bits."
}
function verdict(yes, text) { return yes ? "reached" : text }
function versus(problem, scheme, error, factor, own, peer, own_who) {
  own = least(problem "," scheme ",", error)
  own_who = who
  sub(/^[^,]*,/, "", own_who)
  peer = least("peer " problem ",", error)
  sub(/^peer [^,]*,/, "", who)
  printf "| `%s` at %.0e on `%s`, at most %s of the best peer's time |", scheme,
    error, problem, factor == 1 ? "all" : "a third"
  printf " %s (%s) | %s (%s) |", us(own), own_who, us(peer), who
  if (own >= 1e99) print " not reached: no setting keeps this error |"
  else if (peer >= 1e99) print " reached: no peer keeps this error |"
  else printf " %s |\n", verdict(own <= peer * factor, sprintf(\
    "not reached: %.2g of the best peer's time, %.3g times too slow", \
    own / peer, own / (peer * factor)))
}
function cat(name, line) {
  while (name != "" && (getline line <name) > 0) print line
}
# Least time of each peer.
function peers_table(i, s, seen, f, d, head) {
  print "| problem | peer | 1e-3 | 1e-6 | 1e-9 | settings |"
  print "|---|---|---|---|---|---|"
  for (i = 1; i <= lists; i++) {
    s = list[i]
    if (s !~ /^peer/) continue
    split(s, f, " ")
    head = f[1] " " f[2]
    split(f[2], f, ",")
    printf "| `%s` | %s%s |", f[1], f[2], substr(s, length(head) + 1)
    for (d = 3; d <= 9; d += 3) printf " %s |", us(least(s, 10 ^ -d))
    printf " %d |\n", n[s]
  }
}
END {
  if (table) {
    peers_table()
    exit
  }
  print "| figure | measured | against | verdict |"
  print "|---|---|---|---|"
  if (peers) {
    for (p = 1; p <= 2; p++) {
      name = p == 1 ? "chaos" : "crossings"
      for (d = 3; d <= 9; d += 3) versus(name, "located", 10 ^ -d, 1 / 3)
      versus(name, "moreau", 1e-3, 1)
    }
  } else {
    for (p = 1; p <= 2; p++) {
      name = p == 1 ? "chaos" : "crossings"
      for (d = 3; d <= 9; d += 3)
        printf "| `located` at 1e-%02d on `%s`, a third of the best peer's time" \
          " | %s | - | not known: no peers of this commit; `make report` |\n",
          d, name, us(least(name ",located,", 10 ^ -d))
      printf "| `moreau` at 1e-03 on `%s`, faster than any peer | %s | - |" \
        " not known: no peers of this commit |\n", name, us(least(name ",moreau,", 1e-3))
    }
  }
  for (i = 1; i <= problems; i++) {
    k = digits[i]
    printf "| compensated float on `%s` ends within 3 times the scheme's error" \
      " in double | %.2f at dt = %.3g s; largest %.2f at %.3g s | 3 | %s |\n",
      k, last[k], finest[k], ratio[k], at[k],
      verdict(ratio[k] <= 3, sprintf("not reached: %.2g times too far",
                                     ratio[k] / 3))
  }
  for (i = 1; i <= long_runs; i++) {
    k = lengths[i]
    printf "| compensated float over %s steps of 1 us, %d scenes, ends within 3" \
      " times the scheme's error in double | so in %d, else below one ulp of a" \
      " float in %d | 3 | %s |\n", k, runs[k], within[k], below[k],
      verdict(within[k] == runs[k], sprintf("not reached in %d; in %d of these" \
        " both errors are less than a float resolves (table below)",
        runs[k] - within[k], below[k]))
  }
  for (i = 1; i <= steps; i++) {
    w = worst_of[i]
    split(w, f, ",")
    printf "| located's worst step at most 8 times its median (`%s` in %s" \
      " steps, in %s) | %.1f | 8 | %s |\n", f[1], f[2], f[3], worst[w],
      verdict(worst[w] <= 8, sprintf("not reached: %.2g times too long",
                                     worst[w] / 8))
  }
  cat(step_rows)
  why()
  printf "%s", missed
  cat(step_why)
}
