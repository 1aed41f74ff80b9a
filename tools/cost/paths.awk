# The longest way through the code of each function, whatever its inputs, in
# instructions, from the assembly of x86-64 (gcc -S):
#   awk -v trips='FILE/NAME=N:M,...' -f paths.awk FILE.s...
# prints "name instructions". What is called and what is jumped to is a part
# of the way. The longest way through a loop counts N times, through a loop in
# it M times; where trips says nothing of them, and where a jump goes through a
# table or a pointer, the function and its callers have no bound: "name -".
BEGIN {
  n = split(trips, list, /[=,]/)
  for (i = 1; i < n; i += 2) trips_of[list[i]] = list[i + 1]
}

FNR == 1 {
  file_name[++file] = FILENAME
  sub(/.*\//, "", file_name[file])
  sub(/\..*/, "", file_name[file])
  here = 0
}

function begin_block(key) {
  blocks++
  if (here && !ended) goes[here] = goes[here] " #" blocks
  if (key != "") block_of[key] = blocks
  here = blocks
  ended = 0
}

/^[A-Za-z_.][A-Za-z_0-9.$]*:/ {
  label = substr($1, 1, index($1, ":") - 1)
  if (label !~ /^\.L|\.cold$/) {
    function_of[file ":" label] = label
    ended = 1
  }
  begin_block(file ":" label)
  next
}
$1 == ".globl" {
  place_of[$2] = file ":" $2
  next
}

/^[ \t]+[a-z]/ {
  if (!here || ended) begin_block("")
  size[here]++
  target = $NF
  sub(/@.*/, "", target)
  if ($1 == "call") {
    if (target ~ /^\*/) has_table[here] = 1
    else calls[here] = calls[here] " " file ":" target
  } else if ($1 == "jmp" || $1 == "notrack") {
    if (target ~ /^\*/) has_table[here] = 1
    else goes[here] = goes[here] " " file ":" target
    ended = 1
  } else if ($1 ~ /^j/) {
    goes[here] = goes[here] " " file ":" target
    begin_block("")
  } else if ($1 ~ /^(ret|ud2)/) ended = 1
}

# The function that a name in a file means, "" for a place inside one.
function called(name, short) {
  if (name in function_of) return name
  if (name in block_of) return ""
  short = name
  sub(/^[0-9]+:/, "", short)
  return short in place_of ? place_of[short] : "unknown"
}

# The edges of a block: places inside the function, and the functions that it
# ends in.
function resolve(b, list, n, i, f) {
  if (b in resolved) return
  resolved[b] = 1
  n = split(goes[b], list, " ")
  for (i = 1; i <= n; i++) {
    if (list[i] ~ /^#/) next_of[b] = next_of[b] " " substr(list[i], 2)
    else if ((f = called(list[i])) != "") tails[b] = tails[b] " " f
    else next_of[b] = next_of[b] " " block_of[list[i]]
  }
}

# Blocks of a region that can be reached from its entry, in the order in which
# they are left (left[region, 1...]). An edge back to the entry is not followed.
# Returns: how many they are.
function visit(region, entry, top, stack, at, list, n, b, to, orders) {
  stack[top = 1] = entry
  seen[region, entry] = 1
  while (top > 0) {
    b = stack[top]
    resolve(b)
    n = split(next_of[b], list, " ")
    if (++at[b] > n) {
      left[region, ++orders] = b
      top--
      continue
    }
    to = list[at[b]]
    if (to == entry || (region > 0 && in_region[to] != region)) continue
    before[region, to] = before[region, to] " " b
    if (!((region, to) in seen)) {
      seen[region, to] = 1
      stack[++top] = to
    }
  }
  return orders
}

# Numbers the blocks of a region by the loops that they lie in (Kosaraju), in
# the order of the way: knot[region, block]. Returns: how many.
function knot_all(region, orders, i, top, stack, list, n, b, knots) {
  for (i = orders; i > 0; i--) {
    if ((region, left[region, i]) in knot) continue
    entry_of[region, ++knots] = left[region, i]
    knot[region, left[region, i]] = knots
    stack[top = 1] = left[region, i]
    while (top > 0) {
      b = stack[top--]
      for (n = split(before[region, b], list, " "); n > 0; n--)
        if (!((region, list[n]) in knot)) {
          knot[region, list[n]] = knots
          stack[++top] = list[n]
        }
    }
  }
  return knots
}

# Instructions of a block and what it calls or ends in; -1: no bound.
function cost_of(b, list, n, one, most, sum) {
  if (b in has_table) return -1
  sum = size[b]
  for (n = split(calls[b], list, " "); n > 0; n--) {
    one = longest(called(list[n]))
    if (one < 0) return -1
    sum += one
  }
  for (n = split(tails[b], list, " "); n > 0; n--) {
    one = longest(list[n])
    if (one < 0) return -1
    if (one > most) most = one
  }
  return sum + most
}

# The longest way from the entry of a region; -1: no bound. depth: how many
# loops are around it.
function way(f, region, entry, depth, orders, i, k, n, list, b, sum, far, \
             many, loop, inner, one, turns) {
  orders = visit(region, entry)
  k = knot_all(region, orders)
  for (i = 1; i <= orders; i++) {
    b = left[region, i]
    many[knot[region, b]]++
    for (n = split(next_of[b], list, " "); n > 0; n--)
      if (list[n] == b && b != entry) loop[knot[region, b]] = 1
  }
  for (; k > 0; k--) { # from the last on
    sum = 0
    if (many[k] > 1 || k in loop) {
      if (split(trips_of[file_name[f + 0] "/" plain(f)], turns, ":") <= depth) return -1
      inner = ++regions
      for (i = 1; i <= orders; i++)
        if (knot[region, left[region, i]] == k)
          in_region[left[region, i]] = inner
      sum = way(f, inner, entry_of[region, k], depth + 1)
      if (sum < 0) return -1
      sum *= turns[depth + 1]
    } else if ((sum = cost_of(entry_of[region, k])) < 0) return -1
    far = 0
    for (i = 1; i <= orders; i++) {
      b = left[region, i]
      if (knot[region, b] != k) continue
      for (n = split(next_of[b], list, " "); n > 0; n--) {
        one = knot[region, list[n]]
        if (list[n] != entry && one > k && best[region, one] > far)
          far = best[region, one]
      }
    }
    best[region, k] = sum + far
  }
  return best[region, 1]
}

function plain(f) {
  f = function_of[f]
  sub(/_f(32|64)$/, "", f)
  return f
}

# A whole function is a region below 0.
function longest(f) {
  if (f in found) return found[f]
  if (!(f in function_of)) return -1
  found[f] = -1 # one that calls itself has no bound
  return found[f] = way(f, -++wholes, block_of[f], 0)
}

END {
  for (f in function_of) {
    name = function_of[f]
    if (name !~ /^tf_.*_f(32|64)$/) continue
    most = longest(f)
    name = plain(f)
    print name, most < 0 ? "-" : most
  }
}
