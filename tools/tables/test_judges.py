#!/usr/bin/python3 -B
"""Tests of what judges costs, alarms and changes, on files made for them.

usage: test_judges.py [unittest option]...
"""
from __future__ import annotations

import subprocess
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[1]
CODE = """\
\t.globl\ttf_step_f64
tf_step_f64:
\tmovl\t$1, %eax
.L2:
\taddl\t$1, %eax
\tcmpl\t$9, %eax
\tjne\t.L2
\tret
tf_begin_f64:
\tcall\ttf_step_f64
\ttestl\t%eax, %eax
\tje\t.L4
\tnop
\tnop
.L4:
\tret
tf_slip_f64:
	testl	%eax, %eax
	je	.L5
	call	tf_energy_f64
.L5:
	ret
tf_energy_f64:
	je	.L7
	ret
.L7:
	nop
	ret
tf_other_f64:
.L6:
\tjmp\t.L6
"""
ALARMS = """\
in: any
at: tf_step
what: mem_access, \\valid(x)
why: It is.
"""
PROPERTIES = """\
directory\tfile\tline\tfunction\tproperty kind\tstatus\tproperty
src\tstep.c\t1\ttf_step_f64\tmem_access\tUnknown\t\\valid(x)
src\tstep.c\t2\ttf_step_f64\tmem_access\tValid\t\\valid(y)
tools\tany.c\t3\tany\tuser check\tInvalid or unreachable\t\\false
"""
LOG = """\
noticed double-test_tyre src/model/tyre.c 12 5 7 < becomes <=
survived - src/model/tyre.c 13 6 9 1 becomes 2
"""


class Folder(unittest.TestCase):
    """A folder that is gone after the test."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name: str, text: str) -> str:
        """A file of that text."""
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return str(path)

    def run_script(self, *command: object, code: int = 0) -> list[str]:
        """The lines that a script prints; it has to end with the code."""
        name, *arguments = map(str, command)
        done = subprocess.run([str(TOOLS / name), *arguments], text=True,
                              stdout=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, code, done.stdout)
        return done.stdout.splitlines()


class Costs(Folder):
    """Longest ways, counting and rows."""

    def test_longest_ways(self):
        """A number without loops; a reason where one is no loop's of src/."""
        self.file("double/counted/moreau/step.s", CODE)
        ways = self.run_script("verify/cost/paths.py", "double", self.folder)
        self.assertEqual([line.split(" a ")[0] for line in sorted(ways)],
                         ["tf_begin -", "tf_energy 3 0", "tf_other -",
                          "tf_slip 7 0", "tf_step -"])

    def test_no_assembly(self):
        """A folder that has moved is an error."""
        self.run_script("verify/cost/paths.py", "double", self.folder, code=1)

    def test_counting(self):
        """In front of each stretch stands its length, eight bytes a count."""
        counted = self.run_script("verify/cost/count.py", self.file("a.s", CODE))
        added = [line for line in counted if "paddq" in line]
        self.assertEqual([int(line.split("+")[1].split("(")[0]) // 8
                          for line in added],
                         [1, 3, 1, 1, 2, 2, 1, 2, 1, 1, 1, 1, 2, 1])

    def judge(self, claim: str, way: str, code: int,
              found: str = "tf_step 0 100 1:2\n") -> list[str]:
        """What is wrong with the row of a function that took 100."""
        two = [self.file("ways", f"tf_step {way}\n"), self.file("found", found)]
        return self.run_script("verify/cost/judge.py",
                               self.file("claims", f"tf_step {claim}\n"),
                               *two, *two, code=code)

    def test_rows_that_hold(self):
        """At most a quarter more than was found, or than the way."""
        self.assertEqual(self.judge("125 0 0 0", "200 0", 0), [])
        self.assertEqual(self.judge("125 0 250 0", "200 0", 0), [])
        self.assertEqual(self.judge("125 0 0 0", "- why not", 0), [])
        some = "tf_step 0 100 1:2\ntf_step 9 190 1:2\n"
        self.assertEqual(self.judge("100 10 100 20", "100 18", 0, some), [])

    def test_rows_that_do_not_hold(self):
        """Too little, too much, more than the longest way."""
        for claim, way, wrong in (
                ("99 0 0 0", "200 0", "it took 100"),
                ("126 0 0 0", "200 0", "is the most"),
                ("110 0 0 0", "90 0", "longest way has 90"),
                ("110 0 150 0", "200 0", "longest way, which has 200"),
                ("110 0 260 0", "200 0", "longest way, which has 200")):
            with self.subTest(claim):
                self.assertIn(wrong, self.judge(claim, way, 1)[0])
        some = "tf_step 0 100 1:2\ntf_step 9 190 1:2\n"
        self.assertIn("longest way has 189",
                      self.judge("100 10 0 0", "99 10", 1, some)[1])

    def test_headers(self):
        """Figures are read, and written where they were."""
        header = self.file("a.h", "/// Cost: at most 7 instructions and 3 a "
                           "step,\n/// 8 and 5 by the longest way. "
                           "Stack: 16 B\n"
                           "TF_API void tf_step(void);\n")
        self.assertEqual(self.run_script("verify/cost/headers.py", "claims", header),
                         ["tf_step 7 3 8 5"])
        figures = self.file("figures", "tf_step Cost 90 4 95 6\n"
                            "tf_step Stack 32\n")
        self.run_script("verify/cost/headers.py", "put", figures, header)
        self.assertEqual(self.run_script("verify/cost/headers.py", "claims", header),
                         ["tf_step 90 4 95 6"])
        self.assertIn("Stack: 32 B", Path(header).read_text(encoding="utf-8"))


class Alarms(Folder):
    """Reasons against alarms."""

    def judge(self, alarms: str, properties: str, code: int) -> list[str]:
        """What the judge prints."""
        return self.run_script("verify/eva/judge.py", self.file("alarms", alarms),
                               self.file("any-f64.csv", properties), code=code)

    def test_explained(self):
        """Nothing is wrong."""
        self.assertEqual(self.judge(ALARMS, PROPERTIES, 0), [
            "1 entries, 1 properties proven, 1 alarms explained, 0 not"])

    def test_faults(self):
        """No reason, no alarm, an end that is not reached."""
        said = self.judge(ALARMS.replace("(x)", "(z)"), PROPERTIES, 1)
        self.assertIn("any: step.c:1: not explained", said)
        self.assertIn("explained, but no alarm: any tf_step mem_access, "
                      "\\valid(z)", said)
        said = self.judge(ALARMS, PROPERTIES.replace("\\false", "\\true"), 1)
        self.assertIn("its end is not reached", "\n".join(said))


class Changes(Folder):
    """The report of wrong changes."""

    def test_report(self):
        """Wilson's interval of one of two."""
        listed = self.file("all", "1\n2\n3\n")
        said = self.run_script("verify/mutation/report.py", "--seed", 5, "--all",
                               listed, "--excused", self.file("none", ""),
                               self.file("log", LOG))
        self.assertEqual(said[3], "src/model/tyre.c:6:9: 1 becomes 2")
        self.assertIn("1 of 2 changes noticed: 50.0 % (95 % interval 9.5 to "
                      "90.5)", said[4])
        self.assertEqual(said[5], "seed 5, of 3 changes in all, 0 of them "
                         "excused")


if __name__ == "__main__":
    unittest.main()
