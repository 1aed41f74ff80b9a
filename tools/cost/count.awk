# Makes the assembly of x86-64 (gcc -S, or clang) count its own instructions:
# in front of every stretch that is run as a whole stands one instruction that
# adds the length of the stretch to register mm7. Nothing else uses the MMX
# registers, and that addition changes neither flags nor other registers, so the
# code does what it did, in the same instructions. A repeated string instruction
# counts as one. What is in count.h opens and closes a window. The memory
# functions that a compiler may call get names of their own: those that the rest
# of a program calls are not counted.
function close_stretch(i) {
  for (i = 0; i < lines; i++) print line[i]
  lines = length_ = 0
}

# A new stretch: a place for the addition, whose size is not known yet.
function open_stretch() {
  close_stretch()
  mark = -1
}

function instruction(text) {
  if (length_++ == 0) mark = lines++
  line[lines++] = text
  if (length_ > longest) longest = length_
  line[mark] = "\tpaddq\t.Lcounts+" 8 * length_ "(%rip), %mm7"
}

BEGIN { longest = 0 }
/mem(set|cpy|move)/ { gsub(/mem(set|cpy|move)/, "counted_&") }
/^[A-Za-z_.][A-Za-z_0-9.$]*:/ { # a label
  open_stretch()
  print
  next
}
/^[ \t]+[a-z]/ { # an instruction; a jump or a return ends the stretch
  instruction($0)
  if ($1 ~ /^(j[a-z]*|ret[a-z]*|notrack|ud2|call[a-z]*)$/) open_stretch()
  next
}
{ line[lines++] = $0 }
END {
  close_stretch()
  print "\t.section\t.rodata\n\t.align 8\n.Lcounts:"
  # The upper half counts the additions themselves.
  for (i = 0; i <= longest; i++) print "\t.long\t" i ", 1"
}
