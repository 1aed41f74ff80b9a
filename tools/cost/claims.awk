# What the headers say of costs: lines "name A B W" from the rows "Cost: at most
# A instructions [and B a UNIT]" and "no way through its code has more than W"
# of every public function, 0 for what is not said; "name none" where there is
# no such row.
/^\/\/\// {
  text = text " " substr($0, 4)
  next
}
/^#define tf_[a-z_0-9]+ TF_LINK/ {
  name = $2
  next
}
/^(TF_API|static inline) / && /\(/ {
  if (name == "" && match($0, /tf_[a-z_0-9]+\(/))
    name = substr($0, RSTART, RLENGTH - 1)
  gsub(/ +/, " ", text)
  if (!match(text, /Cost: at most [0-9]+ instructions( and [0-9]+ a )?/))
    print name, "none"
  else {
    split(substr(text, RSTART, RLENGTH), word, " ")
    way = 0
    if (match(text, /through its code has more than [0-9]+/))
      way = substr(text, RSTART + 31, RLENGTH - 31)
    print name, word[4], word[7] + 0, way + 0
  }
}
{ text = name = "" }
