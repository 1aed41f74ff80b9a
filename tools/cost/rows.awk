# Puts figures into the rows of a header:
#   awk -f rows.awk FIGURES HEADER >NEW
# Lines of FIGURES: "name Stack BYTES" or "name Cost A B W", for rows
# "Stack: N B" and "Cost: at most A instructions [and B a UNIT]" and "more than
# W". Words around the numbers stay, and so does what FIGURES does not name.
FNR == NR {
  first[$1, $2] = $3
  second[$1, $2] = $4
  third[$1, $2] = $5
  next
}

function put(pattern, text) {
  for (i = 1; i <= lines; i++) sub(pattern, text, line[i])
}

{ line[++lines] = $0 }
/^\/\/\// { next }
/^#define tf_[a-z_0-9]+ TF_LINK/ {
  name = $2
  next
}
{
  if (/^(TF_API|static inline) / && match($0, /tf_[a-z_0-9]+\(/)) {
    if (name == "") name = substr($0, RSTART, RLENGTH - 1)
    if ((name, "Stack") in first)
      put("Stack: [0-9]+ B", "Stack: " first[name, "Stack"] " B")
    if ((name, "Cost") in first) {
      put("at most [0-9]+ instructions", \
        "at most " first[name, "Cost"] " instructions")
      put("and [0-9]+ a", "and " second[name, "Cost"] " a")
      put("more than [0-9]+", "more than " third[name, "Cost"])
    }
  }
  for (i = 1; i <= lines; i++) print line[i]
  lines = 0
  name = ""
}
END { for (i = 1; i <= lines; i++) print line[i] }
