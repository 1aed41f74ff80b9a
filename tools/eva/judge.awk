# Alarms of the analysis against their explanations: awk -f judge.awk alarms
# RUN.csv... Paragraphs of `alarms` are lines "in: ENTRY...", "at: FUNCTION",
# "what: KIND, EXPRESSION" (one or more) and "why: REASON"; names go without the
# real type. Everything that is not proven is an alarm, a check of an entry too.
# An entry ends in a check of what is false: were it proven, or not looked at,
# then the end would not be reached and nothing behind that point be analysed.
# Counted are proofs alone: not what is admitted, what is dead in this entry or
# what the analyser's own library asks.
BEGIN { FS = "\t" }
FNR == 1 {
  files++
  run = FILENAME
  sub(/.*\//, "", run)
  sub(/-f(64|32)\.csv$/, "", run)
  if (files > 1) ran[run] = 1
}
files == 1 && /^#/ { next }
files == 1 && NF == 0 { at = ins = ""; next }
files == 1 && /^in: / { ins = substr($0, 5); next }
files == 1 && /^at: / { at = substr($0, 5); next }
files == 1 && /^what: / {
  n = split(ins, entry, " ")
  for (i = 1; i <= n; i++)
    open[entry[i] " " at " " substr($0, 7)] = entry[i]
  next
}
files == 1 && /^why: ./ { # all since the last reason have one
  for (key in open) { reason[key] = open[key]; delete open[key] }
  next
}
files == 1 { next } # the reason goes on
FNR == 1 { next }
FNR == 2 { ends[FILENAME] = run }
$5 == "user check" && $7 == "\\false" {
  if ($4 == run && $6 != "Valid" && $6 != "Dead") reached[FILENAME] = 1
  next
}
$6 == "Valid" && $4 !~ /^(Frama_C_|__builtin_)/ { proven++ }
$6 == "Valid" || $6 == "Considered valid" || $6 == "Dead" { next }
$4 ~ /^Frama_C_/ { next } # the analyser's own library
{
  expression = $7
  gsub(/_f(64|32)/, "", $4)
  sub(/_[0-9]+$/, "", $4) # of one static function in several files
  gsub(/_(double|float)/, "", expression)
  gsub(/\((double|float|tf_real_t)\)/, "", expression)
  gsub(/[0-9]f\>/, "&", expression)
  key = run " " $4 " " $5 ", " expression
  if (key in reason) { used[key] = 1; next }
  print run ": " $2 ":" $3 ": not explained"
  print "at: " $4
  print "what: " $5 ", " expression
  bad++
}
END {
  for (key in open) { print "no reason given: " key; bad++ }
  for (key in reason) {
    explained++
    if ((reason[key] in ran) && !(key in used)) {
      print "explained, but no alarm: " key
      bad++
    }
  }
  for (run in ran) entries++
  for (file in ends)
    if (!(file in reached)) {
      print ends[file] ": its end is not reached (" file ")"
      bad++
    }
  printf "%d entries, %d properties proven, %d alarms explained, %d not\n", \
    entries, proven, length(used), bad
  exit bad > 0
}
