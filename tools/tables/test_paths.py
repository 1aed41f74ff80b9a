#!/usr/bin/python3 -B
"""Longest ways of small functions against what they take when they are run.

usage: test_paths.py [unittest option]...

They are compiled as the core is; all inputs there are, are tried, and the
instructions counted. Needs gcc and clang on x86-64.
"""
from __future__ import annotations

import os
import platform
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Optional

TOOLS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TOOLS / "verify/cost"), str(TOOLS / "verify/check")]
import loop_table  # noqa: E402
from assembly import Code  # noqa: E402
from paths import Ways  # noqa: E402
from turns import Loop, Turns  # noqa: E402

# What a byte is and which are alike decides how far the loops run.
SOURCE = r"""
unsigned plain(const unsigned char *b, unsigned n);
unsigned nested(const unsigned char *b, unsigned n);
unsigned triangle(const unsigned char *b, unsigned n);
unsigned ends_early(const unsigned char *b, unsigned n);
unsigned goes_on(const unsigned char *b, unsigned n);
unsigned unrolled(const unsigned char *b, unsigned n);
unsigned first_turn(const unsigned char *b, unsigned n);
unsigned both_ends(const unsigned char *b, unsigned n);
unsigned inlined(const unsigned char *b, unsigned n);
unsigned by_table(const unsigned char *b, unsigned n);
unsigned seldom(const unsigned char *b, unsigned n);
unsigned unknown(const unsigned char *b, unsigned n);

unsigned plain(const unsigned char *b, unsigned n) {
  for (unsigned i = 0; i < 6; i++) n = n * 5 + b[i];
  return n;
}
unsigned nested(const unsigned char *b, unsigned n) {
  for (unsigned i = 0; i < 3; i++) {
    for (unsigned j = 0; j < 5; j++) n = n * 7 + b[j] / (i + 1);
    n ^= n >> 3;
  }
  return n;
}
unsigned triangle(const unsigned char *b, unsigned n) {
  unsigned sum = 0;
  for (unsigned i = 0; i <= n; i++)
    for (unsigned j = i; j < n; j++) sum = sum * 3 + b[j];
  return sum;
}
unsigned ends_early(const unsigned char *b, unsigned n) {
  for (unsigned i = 0; i < 6; i++) {
    if (b[i] == 2) return n / (i + 3);
    while (n > 0 && b[n - 1] != i) n--;
    n += 2 - (n > 3 ? 1 : 0);
  }
  return n;
}
unsigned goes_on(const unsigned char *b, unsigned n) {
  unsigned odd = 0;
  for (unsigned i = 0; i < 6; i++) {
    if (b[i] == 0) continue;
    odd += b[i] / (n + 1);
    if (b[i] == 1) continue;
    for (unsigned j = 0; j < 4; j++)
      if (b[j] == odd % 3) odd = odd * n + j;
  }
  return odd;
}
unsigned unrolled(const unsigned char *b, unsigned n) {
  unsigned sum = 0;
#pragma GCC unroll 4
  for (unsigned i = 0; i < n; i++) sum = (sum ^ b[i]) * 9;
#pragma GCC unroll 3
  for (unsigned i = 0; i < 6; i++) sum += b[i] * (sum >> 5);
  for (unsigned i = 0; i < 2; i++) sum = sum * 5 + b[i];
  return sum;
}
unsigned first_turn(const unsigned char *b, unsigned n) {
  unsigned sum = n, state = 0;
  for (unsigned i = 0; i < 6; i++) {
    if (i > 1 && sum > 40) return sum;
    if (state == 0) state = b[i] > 0 ? 1 : 2;
    else if (state == 1) { sum += b[i] / (i + n); state = b[i]; }
    else { sum = sum * 3 + 1; state = b[i] & 1; }
  }
  return sum;
}
unsigned both_ends(const unsigned char *b, unsigned n) {
  unsigned i = 0;
  while (i < n) {
    while (i < n && b[i] == 1) i++;
    i++;
  }
  return i;
}
static unsigned sum_to(const unsigned char *b, unsigned n) {
  unsigned sum = 0;
  for (unsigned i = 0; i < n; i++) sum = sum * 3 + b[i];
  return sum;
}
unsigned inlined(const unsigned char *b, unsigned n) {
  unsigned sum = 0;
  for (unsigned i = 0; i < 3; i++) sum ^= sum_to(b + i, b[i]) + sum_to(b, n);
  return sum;
}
unsigned by_table(const unsigned char *b, unsigned n) {
  for (unsigned i = 0; i < 6; i++) {
    switch ((b[i] * 2 + n) % 8) {
    case 0: n = n * 3 + i; break;
    case 1: n = n / 5 + 7; break;
    case 2: n ^= 21; break;
    case 3: return n;
    case 4: n -= b[i]; break;
    case 5: n = n * n; break;
    default: n++; break;
    }
  }
  return n;
}
__attribute__((noinline)) static unsigned long_one(const unsigned char *b,
                                                   unsigned n) {
  for (unsigned i = 0; i < 6; i++) n = n * 5 + b[i];
  return n;
}
unsigned seldom(const unsigned char *b, unsigned n) {
  unsigned sum = 0;
  for (unsigned i = 0; i < 6; i++)
    if (i == n || i == n + 2) sum ^= long_one(b, i);
  return sum;
}
unsigned unknown(const unsigned char *b, unsigned n) {
  while (b[n] != 0) n = b[n];
  return n;
}
"""
# The most that n and a byte are is 3.
AT_MOST = {"triangle": "3", "ends_early": "8", "unrolled": "3",
           "both_ends": "3", "sum_to": "3"}
DRIVER = r"""
#include "verify/cost/count.h"
#include <stdio.h>
int count_stepping;
uint32_t count_additions;
#define TRY(f)                                                               \
  unsigned f(const unsigned char *b, unsigned n);                            \
  static void try_##f(void) {                                                \
    uint32_t most = 0;                                                       \
    for (unsigned code = 0; code < 4 * 4096; code++) {                       \
      unsigned char b[8] = {0};                                              \
      for (unsigned i = 0; i < 6; i++) b[i] = (code >> 2 * i) % 4;           \
      const uint32_t count = COUNT(f(b, code / 4096));                       \
      if (count > most) most = count;                                        \
    }                                                                        \
    printf("%s %u\n", #f, (unsigned)most);                                   \
  }
"""


@unittest.skipUnless(platform.machine() == "x86_64", "counts on x86-64 only")
class LongestWays(unittest.TestCase):
    """All functions of SOURCE."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.before = os.getcwd()
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        Path("a.c").write_text(SOURCE, encoding="utf-8")
        flags = ["gcc", "-std=c99", "-O2", "-ffreestanding"]
        subprocess.run([*flags, "-w", "-g1", "-S", "a.c"], check=True)
        cls.loops = sorted(loop_table.loops_of("a.c", {"a.c"}, "-w"))
        cls.code = Code([Path("a.s")])
        names = [name for _, name in cls.code.functions
                 if f"\nunsigned {name}(" in SOURCE
                 and name != "unknown"]
        Path("run.c").write_text(
            DRIVER + "".join(f"TRY({name})\n" for name in names) +
            "int main(void) {\n" +
            "".join(f"try_{name}();\n" for name in names) +
            "return 0;\n}\n", encoding="utf-8")
        counted = subprocess.run([str(TOOLS / "verify/cost" / "count.py"), "a.s"],
                                 check=True, stdout=subprocess.PIPE).stdout
        Path("counted.s").write_bytes(counted)
        subprocess.run(["gcc", "-O1", f"-I{TOOLS}", "run.c", "counted.s",
                        "-o", "run"], check=True)
        lines = subprocess.run(["./run"], check=True, stdout=subprocess.PIPE,
                               text=True).stdout.split()
        cls.most = dict(zip(lines[::2], map(int, lines[1::2])))

    @classmethod
    def tearDownClass(cls) -> None:
        os.chdir(cls.before)
        cls.folder.cleanup()

    def ways(self, fewer: int = 0, calls: Optional[dict[tuple[str, str], int]]
             = None) -> Ways:
        """Longest ways, with so many turns of each loop fewer than true."""
        told = {(loop.file, loop.function, loop.bound):
                AT_MOST.get(loop.function, "") for loop in self.loops}
        found = []
        for one in self.loops:
            turns = loop_table.turns(one, told)
            found.append(Loop(
                one.file, one.function, one.line, one.column, one.last,
                one.test, one.condition, one.body,
                turns and (lambda n, turns=turns: max(0, turns(n) - fewer))))
        return Ways(self.code, Turns(self.code.files, found), 0, calls)

    def test_no_call_takes_more(self):
        """All functions, all inputs; each but the endless one has a number."""
        ways = self.ways()
        for name, most in self.most.items():
            with self.subTest(name):
                self.assertLessEqual(most, ways.longest((0, name)))

    def test_some_take_as_much(self):
        """Where all loops may run their most there is nothing to spare."""
        ways = self.ways()
        for name in "plain", "nested", "inlined":
            with self.subTest(name):
                self.assertEqual(self.most[name], ways.longest((0, name)))

    def test_too_few_turns_are_noticed(self):
        """The bounds of the loops are what the ways hang on."""
        ways = self.ways(fewer=1)
        for name in "plain", "nested", "by_table":
            with self.subTest(name):
                self.assertGreater(self.most[name], ways.longest((0, name)))

    def test_fewer_calls(self):
        """Of six calls in a loop two are made; one is too few."""
        all_, two, one = [
            self.ways(calls=calls).longest((0, "seldom"))
            for calls in ({}, {("seldom", "long_one"): 2},
                          {("seldom", "long_one"): 1})]
        self.assertEqual(all_ - two, 4 * self.ways().longest((0, "long_one")))
        self.assertLessEqual(self.most["seldom"], two)
        self.assertGreater(self.most["seldom"], one)

    def test_no_number_without_a_bound(self):
        """A loop whose end hangs on data alone."""
        ways = self.ways()
        self.assertIsNone(ways.try_longest((0, "unknown")))
        self.assertIn("a.c:", ways.why[0, "unknown"])


if __name__ == "__main__":
    unittest.main()
