"""Stack of the functions of a library, from what nm and objdump -d
--no-show-raw-insn say of a program that is linked from it (Arm Thumb and
RISC-V). From each symbol on every way through the code is walked with the depth
of the stack; a function is as deep as its deepest place, calls included. Behind
a jump through a table every instruction of the function may follow, at that
depth: an upper bound. What is not understood (recursion, a call through a
pointer, a stack pointer out of a register) is refused.
"""
import re

TOO_DEEP = 4096
# What ends a way, by the mnemonic and its operands.
RETURN = re.compile(r"(ret|jr\tra|bx\tlr|mov\tpc, lr)|"
                    r"(pop|ldmia[.w]*)\t.*pc\}|ldr[.w]*\tpc,")
TABLE = re.compile(r"mov\tpc,|(tbb|tbh|bx|jr)\t")
CALL = re.compile(r"(jalr?|bl[a-z]*)\t")
CONDITION = re.compile(r"bl(s|tu|eu|tz|ez|e|t)\t")


def registers(line):
    """How many bytes the registers "{r4, r5, d8-d9}" take."""
    total = 0
    for each in re.split(", *", re.search(r"\{(.*)\}", line)[1]):
        first, _, last = each.partition("-")
        count = int(last[1:]) - int(first[1:]) + 1 if last else 1
        total += count * (8 if each[0] == "d" else 4)
    return total


def number(line):
    """The number behind "#", or at the end of RISC-V's operands."""
    found = re.match(r"\s*[-+]?\d+", re.split("[#,]", line)[-1])
    return int(found[0]) if found else 0


class Code:
    def __init__(self, nm, objdump):
        self.text, self.at, self.room = [], {}, []
        self.refused, self.depth, self.open = [], {}, set()
        self.t1 = 0
        rooms = 0
        for line in objdump.split("\n"):
            found = re.match(r" *([0-9a-f]+):\t(.*)", line)
            if found:
                self.at[int(found[1], 16)] = len(self.text)
                # A comment begins with ; or @ or #.
                self.text.append(re.sub(r"[ \t]*[;@#] .*$", "", found[2]))
                self.room.append(rooms)
            rooms += bool(re.match(r"[0-9a-f]+ <.*>:$", line))
        # One place may have several names.
        self.symbols = {name: int(address, 16) for address, name in re.findall(
            r"^([0-9a-f]+) [TtWw] ([^$\s]\S*)", nm, re.M)}

    def refuse(self, text):
        self.refused.append(text)

    def functions(self):
        return {name: self.worst(self.at[address])
                for name, address in self.symbols.items() if address in self.at}

    def change(self, line):
        """By how much an instruction deepens the stack; one that pops on a
        condition may not have done so."""
        if re.match("v?push|stmdb", line):
            moves = "stmdb" not in line or "sp!" in line
            return registers(line) if moves else 0
        if re.match(r"(v?pop|ldmia)[.w]*\t", line):
            moves = "ldmia" not in line or "sp!" in line
            return -registers(line) if moves else 0
        if re.match(r"sub[.w]*\tsp, (sp, )?#", line):
            return number(line)
        if re.match(r"add[.w]*\tsp, (sp, )?#", line):
            return -number(line)
        if re.search(r"\[sp, #-\d+\]!", line):
            return -number(line.split("]!")[0])
        if re.match(r"v?ldrd?[.w]*\t.*\[sp\], #", line):
            return -number(line)
        if re.match(r"(c\.)?add(i|i16sp)?\tsp,sp,-?\d", line):
            return -number(line)
        if line.startswith("sub\tsp,sp,t1"):
            return self.t1
        if re.match(r"[a-z.0-9]+\tsp *,", line) and \
                not re.match("cmp|str|sw|sd|s[bh]", line):
            self.refuse(f"{line}: a stack pointer out of a register")
        return 0

    def worst(self, i):
        if i in self.depth:
            return self.depth[i]
        if i in self.open:
            self.refuse(f"{self.text[i]}: recursion")
            return 0
        self.open.add(i)
        walk = Walk(self, i)
        deepest = max([walk.most] + [deep + self.worst(target)
                                     for target, deep in walk.calls])
        self.open.remove(i)
        self.depth[i] = deepest
        return deepest


class Walk:
    """All ways through one function, from instruction `start` on."""

    def __init__(self, code, start):
        self.code, self.seen, self.waiting = code, {}, []
        self.calls, self.most, self.table, self.behind = set(), 0, None, None
        self.follow(start, 0)
        while self.waiting:
            self.step(self.waiting.pop())
            # A jump through a table waits until no other way is left.
            if not self.waiting and self.table:
                self.follow_all(*self.table)
                self.table = None

    def follow(self, i, deep):
        if i is None or i >= len(self.code.text):
            self.code.refuse("a way leads out of the code")
        elif self.seen.get(i, -1) < deep:
            if deep > TOO_DEEP:
                self.code.refuse(f"{self.code.text[i]}: a stack without a "
                                 "bound")
                return
            self.seen[i] = deep
            self.waiting.append(i)

    def follow_all(self, i, deep):
        """What no way has come to yet in the function of instruction i."""
        room = self.code.room
        for j in range(len(room)):
            if room[j] == room[i] and j not in self.seen:
                self.follow(j, deep)

    def open_table(self, i, deep):
        if not self.table or self.table[1] < deep:
            self.table = i, deep

    def step(self, i):
        code, line = self.code, self.code.text[i]
        deep = self.seen[i] + code.change(line)
        self.most = max(self.most, deep)
        if line.startswith("li\tt1,"):
            code.t1 = number(line)
        named = re.search("([0-9a-f]+) <", line)
        target = code.at.get(int(named[1], 16)) if named else None
        if line.startswith(".") or RETURN.match(line):  # data, or the end
            return
        if line.startswith("jr\tt0"):  # the end of a shared prologue, which
            if self.behind is not None:  # may also be looked at by itself
                self.follow(self.behind, deep)
            return
        if TABLE.match(line):
            self.open_table(i, deep)
            return
        if line.startswith("jal\tt0,"):  # a prologue that is shared
            self.behind = i + 1
            self.follow(target, deep)
            return
        if CALL.match(line) and not CONDITION.match(line):
            if target is None:
                code.refuse(f"{line}: a call through a pointer")
            else:
                self.calls.add((target, deep))
            if "__gnu_thumb1_case" in line:
                self.open_table(i, deep)
        elif named and line[0] in "bj" or line.startswith("cb"):
            self.follow(target, deep)
            if re.match(r"(j|b|b\.[nw])\t", line):
                return
        self.follow(i + 1, deep)
