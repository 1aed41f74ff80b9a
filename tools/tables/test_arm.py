#!/usr/bin/python3 -B
"""Longest ways through Thumb-2 code: of snippets written by hand, of which
they are known, and of the functions of test_paths.py against what an emulator
counts.

usage: test_arm.py [unittest option]...

Needs arm-none-eabi-gcc and clang; the emulator is qemu-system-arm.
"""
from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TOOLS / "verify/cost"), str(TOOLS / "verify/check"),
                str(TOOLS / "tables")]
import loop_table  # noqa: E402
from arm import ArmTurns, ArmWays, Bounds, Elf, memory_loops  # noqa: E402
from budget import Budget, line_above, verdict  # noqa: E402
import thumb  # noqa: E402
from test_paths import AT_MOST, SOURCE  # noqa: E402
from turns import Loop  # noqa: E402

FLAGS = ["arm-none-eabi-gcc", "-mcpu=cortex-m4", "-mthumb", "-ffreestanding",
         "-nostdlib", "-w", "-g1"]
# Function, its longest way, its code.
KNOWN = (
    ("branch", 7, """cmp r0, #0
        beq 1f
        adds r0, #1
        adds r0, #2
        adds r0, #3
        b 2f
     1: adds r0, #4
     2: bx lr"""),
    ("loop", 1 + 5 * 3 + 1, """movs r1, #5
     1: adds r0, #1
        subs r1, #1
        bne 1b
        bx lr"""),
    ("calls", 2 + 7 + 17 + 2, """push {r4, lr}
        bl branch
        bl loop
        pop {r4, pc}"""),
    ("goes_to", 2 + 17, """cmp r0, #1
        b loop"""),
    ("calls_if", 5 + 17 + 1, """push {r4, lr}
        cmp r0, #1
        it eq
        bleq loop
        nop
        pop {r4, pc}"""),
    ("from_start", 6 * 2 + 1, """subs r0, #1
        bne from_start
        bx lr"""),
    ("calls_inside", 3 + 2, """push {r4, lr}
        bl 1f
        pop {r4, pc}
     1: adds r0, #1
        bx lr"""),
    ("it_block", 7, """cmp r0, #0
        ittee eq
        addeq r0, #1
        addeq r0, #2
        addne r0, #3
        addne r0, #4
        bx lr"""),
    ("returns_if", 7, """cmp r0, #3
        it eq
        bxeq lr
        cbz r1, 1f
        adds r0, #1
        adds r0, #2
     1: bx lr"""),
    ("loop_that_returns", 1 + 4 * 5 + 1, """push {r4, lr}
     1: subs r1, #1
        it mi
        popmi {r4, pc}
        cmp r0, r1
        bne 1b
        pop {r4, pc}"""),
    ("by_bytes", 3 + 3, """cmp r0, #2
        bhi 9f
        tbb [pc, r0]
     0: .byte (1f - 0b) / 2, (2f - 0b) / 2, (3f - 0b) / 2
        .p2align 1
     3: bx lr
     1: adds r0, #1
        adds r0, #2
     9: bx lr
     2: adds r0, #1
        bx lr"""),
    # After this table there is a constant, which is none of it.
    ("by_halves", 3 + 4, """cmp r0, #1
        bhi 9f
        tbh [pc, r0, lsl #1]
     0: .short (1f - 0b) / 2, (2f - 0b) / 2
        .short 3, 4
     9: bx lr
     1: adds r0, #1
        adds r0, #2
        adds r0, #3
     2: bx lr"""),
    ("by_addresses", 4 + 3, """cmp r0, #1
        bhi 9f
        add r1, pc, #4
        ldr.w pc, [r1, r0, lsl #2]
        .p2align 2
     0: .word 1f + 1, 2f + 1
     9: bx lr
     1: adds r0, #1
     2: adds r0, #1
        bx lr"""),
    ("literal", 3, """ldr r0, 1f
        ldr r1, 1f + 4
        bx lr
        .p2align 2
     1: .word 0x47702000, 0xe7fee7fe"""))
REFUSED = (
    ("endless", "endless+0x2", """movs r1, #1
     1: lsls r1, #1
        bne 1b
        bx lr"""),
    ("itself", "itself calls itself", """push {r4, lr}
        cbz r0, 1f
        bl itself
     1: pop {r4, pc}"""),
    ("ping", "ping calls itself", """push {r4, lr}
        bl pong
        pop {r4, pc}"""),
    ("pong", "pong calls itself", """cbz r0, 1f
        b ping
     1: bx lr"""),
    ("by_pointer", "call through a pointer at by_pointer+0x2", """push {r4, lr}
        blx r3
        pop {r4, pc}"""),
    ("jumps", "jump through a pointer at jumps+0x2", """movs r0, #1
        bx r3"""),
    ("runs_out", "no code follows runs_out", """movs r0, #1
        .word 0"""),
    ("calls_endless", "endless+0x2", """push {r4, lr}
        bl endless
        pop {r4, pc}"""),
    ("clear_some", "memset of an unknown size at clear_some+0x2", """nop
        bl memset
        pop {r4, pc}"""))
SIZED = """cbz r0, 1f
        movs r4, #{0}
        b 2f
     1: movs r4, #3
     2: mov r2, r4
        movs r1, #0
        bl memset
        pop {{r4, pc}}"""
LIBRARY = {"loop+0x2": (3, 5), "loop_that_returns+0x2": (5, 4),
           "from_start": (2, 6)}
DRIVER = r"""
__asm__(".section .vectors\n.word 0x20010000\n.word start\n.text");
unsigned FUNCTION(const unsigned char *b, unsigned n);
__attribute__((noinline)) void window_open(void) { __asm__ volatile(""); }
__attribute__((noinline)) void window_close(void) { __asm__ volatile(""); }
void start(void) {
  static const unsigned exited[2] = {0x20026, 0};
  window_open();
  window_close();
  for (unsigned code = 0; code < 4 * 4096; code++) {
    unsigned char b[8] = {0};
    for (unsigned i = 0; i < 6; i++) b[i] = (code >> 2 * i) % 4;
    window_open();
    FUNCTION(b, code / 4096);
    window_close();
  }
  register unsigned what __asm__("r0") = 0x20;
  register const unsigned *how __asm__("r1") = exited;
  __asm__ volatile("bkpt 0xAB" : : "r"(what), "r"(how) : "memory");
  for (;;) continue;
}
"""
LAYOUT = """ENTRY(start)
SECTIONS { .text 0 : { KEEP(*(.vectors)) *(.text*) *(.rodata*) } }
"""


def function(name: str, code: str) -> str:
    """Assembly of a function."""
    return f"""        .global {name}
        .type {name}, %function
        .thumb_func
        .p2align 2
{name}: {code}
        .size {name}, . - {name}
"""


@unittest.skipUnless(shutil.which(FLAGS[0]), f"needs {FLAGS[0]}")
class InFolder(unittest.TestCase):
    """With a folder of its own; the memory functions are the boards'."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.before = os.getcwd()
        os.chdir(TOOLS.parent)
        cls.folder = tempfile.TemporaryDirectory()
        cls.memory = memory_loops("-DTF_REAL_FLOAT")

    @classmethod
    def tearDownClass(cls) -> None:
        os.chdir(cls.before)
        cls.folder.cleanup()

    def path(self, name: str) -> Path:
        """A file of the folder."""
        return Path(self.folder.name, name)


class ByHand(InFolder):
    """Functions of KNOWN and REFUSED."""

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        text = "        .syntax unified\n        .thumb\n        .text\n"
        for name, _, code in KNOWN + REFUSED:
            text += function(name, code)
        for size in 5, 6:
            text += function(f"clear_{size}", "push {r4, lr}\n        "
                             + SIZED.format(size))
        source, elf = (Path(cls.folder.name, name) for name in ("a.s", "elf"))
        source.write_text(text, encoding="ascii")
        subprocess.run([*FLAGS, "-Os", "-Wl,-e,branch", str(source),
                        "port/arch/memory.c", "-o", str(elf)], check=True)
        program = Elf(elf)
        code = program.program()
        cls.ways = ArmWays(code, ArmTurns(code, cls.memory,
                                          program.frames(code),
                                          library=LIBRARY), 1)

    def test_known_ways(self):
        """No more and no less."""
        for name, longest, _ in KNOWN:
            with self.subTest(name):
                found = self.ways.try_longest((0, name))
                self.assertEqual(longest, found, self.ways.why.get((0, name)))

    def test_refused(self):
        """What has no number is told with its name."""
        for name, why, _ in REFUSED:
            with self.subTest(name):
                ways = ArmWays(self.ways.code, self.ways.turns, 1)
                self.assertIsNone(ways.try_longest((0, name)))
                self.assertIn(why, ways.why[0, name])

    def test_what_is_not_followed(self):
        """Loops of Armv8.1-M, and a jump past the comparison of a table."""
        for text in ("le lr, 0x8000", "dls lr, r0", "wls lr, r0, 0x8010",
                     "letp lr, 0x8000", "bf 0x8000, 0x8010", "blxns r0"):
            self.assertEqual("pointer", thumb.kind_of(text), text)
        self.assertEqual("", thumb.kind_of("bfi r0, r1, #2, #3"))
        code = """00008000 <switch>:
    8000:\t{0}\tb.n\t8006 <switch+0x6>
    8002:\t2802\tcmp\tr0, #{1}
    8004:\td804\tbhi.n\t8010 <switch+0x10>
    8006:\te8df f000\ttbb\t[pc, r0]
    800a:\t0302\t.short\t0x0302
    800c:\t0504\t.short\t0x0504
    800e:\t4770\tbx\tlr
    8010:\t4770\tbx\tlr
    8012:\t4770\tbx\tlr
    8014:\t4770\tbx\tlr
"""
        jumps = thumb.read_listing(code.format("e001", 1))
        self.assertEqual([0x800e, 0x8010, 0x8012, 0x8014],
                         jumps.table(jumps.lines[0x8006]))
        plain = thumb.read_listing(code.format("bf00", 1).replace(
            "b.n\t8006 <switch+0x6>", "nop"))
        self.assertEqual([0x800e, 0x8010], plain.table(plain.lines[0x8006]))

    def test_memory_functions(self):
        """The largest number that the size may be counts, byte by byte."""
        ways = [self.ways.longest((0, name)) for name in
                ("clear_5", "clear_6", "memset(5)", "memset(6)")]
        self.assertGreater(ways[1], ways[0])
        self.assertEqual(ways[1] - ways[0], ways[3] - ways[2])
        self.assertEqual(8, ways[0] - ways[2])

    def test_another_library(self):
        """A loop of another length than the table has is not trusted."""
        turns = self.ways.turns
        ways = ArmWays(turns.code, ArmTurns(
            turns.code, self.memory, turns.frames[0],
            library={"loop+0x2": (4, 5)}), 1)
        self.assertIsNone(ways.try_longest((0, "loop")))
        self.assertIn("has 3 instructions, not 4", ways.why[0, "loop"])


@unittest.skipUnless(shutil.which("qemu-system-arm"), "needs qemu-system-arm")
class Counted(InFolder):
    """All functions of test_paths.SOURCE, with all inputs there are."""

    def counted(self, name: str, option: str) -> tuple[int, Bounds]:
        """The most that the emulator counts, and the bounds."""
        elf, out = self.path(f"{name}{option}.elf"), self.path("out")
        subprocess.run([*FLAGS, option, f"-DFUNCTION={name}", "-T",
                        str(self.path("layout")), str(self.path("driver.c")),
                        str(self.path("a.c")), "port/arch/memory.c",
                        "-o", str(elf)], check=True)
        said = subprocess.run(["arm-none-eabi-nm", str(elf)], text=True,
                              check=True, stdout=subprocess.PIPE).stdout
        at = {line.split()[-1]: line.split()[0] for line in said.splitlines()}
        subprocess.run(
            ["timeout", "60", "qemu-system-arm", "-M", "mps2-an386", "-display",
             "none", "-monitor", "none", "-serial", "none",
             "-semihosting-config", "enable=on,target=native", "-plugin",
             f"{self.path('count.so')},open=0x{at['window_open']},"
             f"close=0x{at['window_close']},out={out}", "-kernel", str(elf)],
            check=True, stdin=subprocess.DEVNULL)
        number, _, _, most = map(int, out.read_text(encoding="ascii").split())
        self.assertEqual(4 * 4096, number)
        told = {(loop.file, loop.function, loop.bound):
                AT_MOST.get(loop.function, "") for loop in self.loops}
        loops = [Loop(one.file, one.function, one.line, one.column, one.last,
                      one.test, one.condition, one.body,
                      loop_table.turns(one, told)) for one in self.loops]
        return most, Bounds(Elf(elf), loops + self.memory,
                            ("window_open", "window_close"))

    def test_no_call_takes_more(self):
        """Optimised for size and for speed, as boards are."""
        self.path("a.c").write_text(SOURCE, encoding="utf-8")
        self.path("driver.c").write_text(DRIVER, encoding="utf-8")
        self.path("layout").write_text(LAYOUT, encoding="utf-8")
        subprocess.run(["cc", "-std=c99", "-O2", "-fPIC", "-shared",
                        "tools/bench/count.c", "-o",
                        str(self.path("count.so"))], check=True)
        file = os.path.relpath(self.path("a.c"))
        self.loops = [loop._replace(file=file) for loop in sorted(
            loop_table.loops_of(file, {file}, "-w"))]
        met = set()
        for name in ("plain", "nested", "triangle", "ends_early", "goes_on",
                     "unrolled", "first_turn", "both_ends", "inlined",
                     "by_table", "seldom"):
            for option in "-Os", "-O2":
                with self.subTest(name, option=option):
                    most, bounds = self.counted(name, option)
                    way = bounds.of_window(0)
                    self.assertLessEqual(most, way)
                    met |= {name} if most == way else set()
        self.assertLessEqual({"plain", "nested", "inlined"}, met)


class Budgets(unittest.TestCase):
    """Rows of budgets and their bounds."""

    ROWS = [Budget("b", "float", n, 1, 2, 3, bound)
            for n, bound in ((0, 4), (1, 10), (2, 25), (4, 40), (8, 80))]

    def test_a_longer_step_is_noticed(self):
        """Than the bound."""
        row = self.ROWS[0]
        self.assertTrue(row._replace(found=4).is_held())
        self.assertFalse(row._replace(found=5).is_held())

    def test_line(self):
        """It is above all bounds."""
        self.assertEqual((5, 10), line_above(self.ROWS))

    def test_verdicts(self):
        """What is proved, what is only found, what is neither."""
        row = self.ROWS[0]
        self.assertIn("worst: reached.", verdict(4, row, 3))
        self.assertIn("but not by the bound", verdict(3, row, 3))
        self.assertIn("worst: not reached.", verdict(2, row, 3))


if __name__ == "__main__":
    unittest.main()
