# Worst stack of every function, from what gcc -fcallgraph-info=su wrote:
#   awk -f stack.awk [library] FILE.ci... FILE.s...
# prints "name bytes path" of global functions and of public inline ones. A frame is what gcc says of it,
# return address included. The worst of a function is its frame and the worst of
# what it calls; where the assembly only ever jumps to another function (a tail
# call) the frame is gone by then and does not add. A function of a C
# library counts what the file `library` says ("name bytes", frames.awk), else
# LIBRARY bytes: 32, or with -1 it is refused. So are recursion, calls through
# pointers and frames of unbounded size: exit code 1.
BEGIN { if (LIBRARY == "") LIBRARY = 32 }

FILENAME ~ /library$/ {
  library[$1] = $2
  next
}

# Assembly: a label that is no local one begins a function or its cold part.
FILENAME ~ /\.s$/ {
  if (match($0, /^[A-Za-z_][A-Za-z_0-9.]*:/)) {
    inside = substr($0, 1, RLENGTH - 1)
    sub(/\.cold$/, "", inside)
  } else if ($1 ~ /^(call|bl|j.*|tail|b)$/) {
    target = $2
    sub(/@.*/, "", target)
    if (target !~ /^\./)
      ($1 == "call" || $1 == "bl") ? called[inside, target] = 1 : jumped[inside, target] = 1
  }
  next
}

# node: { title: "name" label: "name\nfile:line:column\n48 bytes (static)..." }
/^node:/ {
  split($0, quoted, "\"")
  name = quoted[2]
  if (match(quoted[4], /[0-9]+ bytes \([a-z,]+\)/)) {
    frame[name] = substr(quoted[4], RSTART) + 0
    if (quoted[4] ~ /bytes \(dynamic\)/) refuse(name ": frame without a bound")
  }
}

/^edge:/ {
  split($0, quoted, "\"")
  calls[quoted[2]] = calls[quoted[2]] SUBSEP quoted[4]
  if (quoted[4] ~ /indirect/) refuse(quoted[2] ": calls through a pointer")
}

function refuse(text) {
  print text >"/dev/stderr"
  bad = 1
}

# Parameters after the first are local variables.
function worst(name, list, n, i, deepest, below, short) {
  if (name in depth) return depth[name]
  if (!(name in frame)) {
    if (name in library) return library[name]
    if (LIBRARY < 0) refuse(name ": in no library")
    return LIBRARY
  }
  if (name in open) {
    refuse(name ": recursion")
    return 0
  }
  open[name] = 1
  n = split(calls[name], list, SUBSEP)
  for (i = 2; i <= n; i++) {
    below = worst(list[i])
    if (!is_tail(name, list[i])) below += frame[name]
    if (below > deepest) {
      deepest = below
      path[name] = " > " ((list[i] in path) ? path[list[i]] : list[i])
    }
  }
  delete open[name]
  short = name
  sub(/.*:/, "", short)
  path[name] = short path[name]
  return depth[name] = deepest > frame[name] ? deepest : frame[name]
}

function is_tail(name, target) {
  sub(/.*:/, "", name)
  sub(/.*:/, "", target)
  return ((name, target) in jumped) && !((name, target) in called)
}

END {
  for (name in frame) {
    short = name
    sub(/.*:/, "", short)
    if (name == short || short ~ /^tf_/) print short, worst(name), path[name]
  }
  for (name in frame) worst(name) # also those that are called by nobody
  exit bad
}
