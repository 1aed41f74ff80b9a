# The log of tools/mutation/run, in the order of the source, as a table by file,
# a sum and what survived. `all` changes there are, of which `excused` have no
# effect that the contract knows. "same" are those that compile to the same
# bytes, "invalid" those that do not compile.
{
  result[$1]++
  files[$3] = 1
  count[$3, $1]++
  if ($1 == "survived") {
    text = $0
    for (i = 0; i < 6; i++) sub(/^[^ ]* /, "", text)
    survivors = survivors sprintf("%s:%d:%d: %s\n", $3, $5, $6, text)
  }
}


END {
  printf "%-26s %8s %8s %8s %8s\n", "file", "noticed", "survived", "same",
    "invalid"
  in_order = "sort"
  for (file in files)
    printf "%-26s %8d %8d %8d %8d\n", file, count[file, "noticed"],
      count[file, "survived"], count[file, "same"],
      count[file, "invalid"] | in_order
  close(in_order)
  printf "\n%s", survivors
  # Wilson's interval of a share, for 95 %.
  n = result["noticed"] + result["survived"]
  p = n ? result["noticed"] / n : 0
  z2 = n ? 1.96 * 1.96 / n : 0
  middle = (p + z2 / 2) / (1 + z2)
  half = sqrt(n ? p * (1 - p) * z2 + z2 * z2 / 4 : 0) / (1 + z2)
  printf "%d of %d changes noticed: %.1f %% (95 %% interval %.1f to %.1f);",
    result["noticed"], n, 100 * p, 100 * (middle - half),
    100 * (middle + half)
  printf " %d compile to the same, %d not at all\n", result["same"],
    result["invalid"]
  printf "seed %s, of %d changes in all, %d of them excused\n", seed, all,
    excused
}
