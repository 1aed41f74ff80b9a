#!/usr/bin/python3 -B
"""Tests of the package, against answers that others have published.

usage: test_tables.py [unittest option]... (check `tables` runs it)
"""
from __future__ import annotations

import math
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from tables import markdown, read, statistics  # noqa: E402


class Shares(unittest.TestCase):
    """Newcombe, Statistics in Medicine 17 (1998), table I."""

    def check(self, method, k, n, low, high):
        """Four decimals of one interval of the table."""
        found = method(k, n)
        self.assertAlmostEqual(found.value, k / n)
        self.assertAlmostEqual(found.low, low, places=4)
        self.assertAlmostEqual(found.high, high, places=4)

    def test_wilson(self):
        """Method 3 of the table: score without continuity correction."""
        self.check(statistics.wilson, 81, 263, 0.2553, 0.3662)
        self.check(statistics.wilson, 15, 148, 0.0624, 0.1605)
        self.check(statistics.wilson, 0, 20, 0.0, 0.1611)
        self.check(statistics.wilson, 1, 29, 0.0061, 0.1718)

    def test_clopper_pearson(self):
        """Method 5 of the table: exact."""
        self.check(statistics.clopper_pearson, 81, 263, 0.2527, 0.3676)
        self.check(statistics.clopper_pearson, 15, 148, 0.0578, 0.1617)
        self.check(statistics.clopper_pearson, 0, 20, 0.0, 0.1684)
        self.check(statistics.clopper_pearson, 1, 29, 0.0009, 0.1776)

    def test_ends_are_exact(self):
        """Rounding leaves no share below 0 or above 1."""
        self.assertEqual(statistics.wilson(0, 7).low, 0.0)
        self.assertEqual(statistics.wilson(7, 7).high, 1.0)

    def test_nothing_counted(self):
        """Of no case there is no share."""
        self.assertTrue(math.isnan(statistics.wilson(0, 0).value))


class Groups(unittest.TestCase):
    """Values that come in groups tell less than as many independent ones."""

    JUDGES = [[9, 2, 5, 8], [6, 1, 3, 2], [8, 4, 6, 8], [7, 1, 2, 6],
              [10, 5, 6, 9], [6, 2, 4, 7]]

    def test_intraclass(self):
        """Shrout and Fleiss, Psychological Bulletin 86 (1979): six targets,
        four judges, ICC(1, 1) = 0.17."""
        self.assertAlmostEqual(statistics.intraclass(self.JUDGES), 0.1657,
                               places=4)

    def test_worth(self):
        """Kish's 1 + (m - 1) rho; copies of one value are worth one."""
        self.assertAlmostEqual(statistics.worth(self.JUDGES),
                               24 / (1 + 3 * 0.165742), places=4)
        self.assertAlmostEqual(statistics.worth([[0] * 9, [1] * 9, [1] * 9]),
                               3)
        self.assertEqual(statistics.worth([[1, 1], [1, 1, 1]]), 2)
        self.assertEqual(statistics.worth([[0], [1], [1]]), 3)

    def test_independent_values_keep_their_number(self):
        random = np.random.default_rng(3)
        groups = random.random((200, 20)) < 0.3
        self.assertGreater(statistics.worth(groups.tolist()), 0.8 * 4000)

    def test_share(self):
        """Of as many as there are it is Wilson's."""
        self.assertEqual(
            [round(x, 12) for x in statistics.wilson_worth(81, 263, 263)],
            [round(x, 12) for x in statistics.wilson(81, 263)])
        self.assertEqual(statistics.wilson_worth(7, 7, 2.5).high, 1.0)
        self.assertTrue(math.isnan(statistics.wilson_worth(0, 0, 0).value))

    def test_coverage(self):
        """Of shares and medians of groups whose shares differ."""
        random = np.random.default_rng(4)
        held = [0, 0]
        for _ in range(300):
            chances = random.beta(2, 2, 40)
            values = (random.random((40, 12)) < chances[:, None]).tolist()
            n, k = 480, sum(map(sum, values))
            found = statistics.wilson_worth(k, n, statistics.worth(values))
            held[0] += found.low <= 0.5 <= found.high
            times = random.normal(0, 1, (40, 1)) + random.normal(0, 1, (40, 12))
            below = (times <= np.median(times)).tolist()
            found = statistics.quantile(times.ravel().tolist(), 0.5,
                                        statistics.worth(below))
            held[1] += found.low <= 0 <= found.high
        self.assertGreaterEqual(min(held), 0.92 * 300)


class Quantiles(unittest.TestCase):
    """Conover, Practical Nonparametric Statistics (1999), example 3.2.1."""

    def test_upper_quartile(self):
        """Sixteen transistors; 90 % there, so only the order is tested."""
        hours = [46.9, 47.2, 49.1, 56.5, 56.8, 59.2, 59.9, 63.2, 63.3, 63.4,
                 63.7, 64.1, 67.1, 67.7, 73.3, 78.5]
        found = statistics.quantile(hours, 0.75)
        self.assertEqual(found.value, 64.1)
        self.assertLessEqual(found.low, 63.3)
        self.assertGreaterEqual(found.high, 73.3)

    def test_median_of_ten(self):
        """The 2nd and 9th of ten hold the median in 97.9 % of cases."""
        found = statistics.quantile(range(1, 11), 0.5)
        self.assertEqual(found, (5, 2, 9))

    def test_few_values_have_an_open_end(self):
        """The largest of four is not above their 90 % quantile for sure."""
        found = statistics.quantile([1, 2, 3, 4], 0.9)
        self.assertEqual(found.value, 4)
        self.assertTrue(math.isnan(found.high))

    def test_coverage(self):
        """At least 95 % of the intervals hold the true quantile."""
        random = np.random.default_rng(1)
        held = 0
        for _ in range(400):
            found = statistics.quantile(random.random(60), 0.9)
            low = found.low if found.low == found.low else 0
            high = found.high if found.high == found.high else 1
            held += low <= 0.9 <= high
        self.assertGreaterEqual(held, 0.94 * 400)


class Distances(unittest.TestCase):
    """Two samples of Kolmogorov and Smirnov."""

    def test_by_hand(self):
        """Of all 20 orders of 3 and 3 values two are apart entirely."""
        found = statistics.kolmogorov_smirnov([1, 2, 3], [4, 5, 6])
        self.assertEqual((found.n, found.m, found.value), (3, 3, 1.0))
        self.assertAlmostEqual(found.p, 2 / 20)

    def test_band_of_large_samples(self):
        """1.358 sqrt(1/n + 1/m), from Smirnov's table of 1948."""
        values = np.arange(20000.0)
        found = statistics.kolmogorov_smirnov(values, values)
        self.assertAlmostEqual(found.band, 1.358 * math.sqrt(2 / 20000),
                               places=4)
        self.assertEqual((found.value, found.p), (0, 1))

    def test_several_tests_are_one_family(self):
        """Of 40 families of 10 tests of one law, about 2 have a distance above
        its band; without the correction about 16 would."""
        random = np.random.default_rng(1)
        bad = {1: 0, 10: 0}
        for _ in range(40):
            pairs = [(random.random(200), random.random(200))
                     for _ in range(10)]
            for tests, _ in bad.items():
                found = [statistics.kolmogorov_smirnov(a, b, tests)
                         for a, b in pairs]
                bad[tests] += any(one.value > one.band for one in found)
        self.assertLessEqual(bad[10], 6)
        self.assertGreaterEqual(bad[1], 8)

    def test_verdict(self):
        """Not to find a difference in few samples is not to find none."""
        random = np.random.default_rng(2)

        def verdict(n, shift):
            found = statistics.kolmogorov_smirnov(
                random.random(n), random.random(n) + shift)
            return found.verdict(0.05)
        self.assertEqual(verdict(100, 0), "open")
        self.assertEqual(verdict(20000, 0), "alike")
        self.assertEqual(verdict(20000, 0.1), "different")
        self.assertEqual(verdict(20000, 0.025),
                         "different, by less than 0.05")


class Survival(unittest.TestCase):
    """Kaplan and Meier on remissions under 6-MP.

    Freireich et al., Blood 21 (1963); figures of Collett, Modelling Survival
    Data in Medical Research, and of R's survfit with conf.type log-log.
    """

    def test_remissions(self):
        """Seven times at which some of the 21 patients relapsed."""
        found = statistics.kaplan_meier([21, 17, 15, 12, 11, 7, 6],
                                        [3, 1, 1, 1, 1, 1, 1])
        shares = [0.857, 0.807, 0.753, 0.690, 0.627, 0.538, 0.448]
        for one, share in zip(found, shares):
            self.assertAlmostEqual(one.value, share, places=3)
        self.assertAlmostEqual(found[0].low, 0.6197, places=4)
        self.assertAlmostEqual(found[0].high, 0.9516, places=4)
        self.assertAlmostEqual(found[6].low, 0.1881, places=4)
        self.assertAlmostEqual(found[6].high, 0.6801, places=4)

    def test_ends(self):
        """Where none or all are lost there is no interval."""
        nobody, everybody = statistics.kaplan_meier([5, 5], [0, 5])
        self.assertEqual((nobody.value, everybody.value), (1, 0))
        self.assertTrue(math.isnan(nobody.low))


class Squares(unittest.TestCase):
    """chi^2 against even."""

    def test_limit(self):
        """From any table: 16.919 at 9 degrees, 5 %."""
        self.assertAlmostEqual(statistics.chi_square_limit(9), 16.919,
                               places=3)

    def test_value(self):
        """(16 - 18)^2 / 18 and so on, from the page of scipy."""
        self.assertAlmostEqual(
            statistics.chi_square_even([16, 18, 16, 14, 12, 12]), 2.0)


class Reading(unittest.TestCase):
    """Rows by name, and errors that say where."""

    def file(self, text):
        """A file of that text, which is gone after the test."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = Path(folder.name, "rows.csv")
        path.write_text(text, encoding="utf-8")
        return str(path)

    def test_columns_by_name(self):
        """Comments are left out, empty fields are no numbers."""
        path = self.file("# stamp\na,b\n1,\n3,4e-3\n")
        rows = read.read_csv(path, ["a", "b"])
        self.assertEqual(read.numbers(rows, "b"), [4e-3])
        self.assertEqual(rows[1].count("a"), 3)

    def test_errors_name_file_line_and_column(self):
        """What a reader of the message needs to mend the file."""
        path = self.file("a,b\n1,x\n")
        with self.assertRaisesRegex(read.TableError, "rows.csv: .*'c'"):
            read.read_csv(path, ["c"])
        row = read.read_csv(path)[0]
        with self.assertRaisesRegex(read.TableError, "rows.csv:2: .*'b'.*'x'"):
            row.number("b")
        with self.assertRaisesRegex(read.TableError, "rows.csv:2: .*'c'"):
            row.number("c")

    def test_a_row_of_another_length(self):
        """It is no row of the table."""
        with self.assertRaisesRegex(read.TableError, "rows.csv:3: 1 fields"):
            read.read_csv(self.file("a,b\n1,2\n3\n"))

    def test_words(self):
        """The last column takes the rest of the line."""
        path = self.file("tf_step 0 3180 1 2 3\n\ntf_run 1\n")
        with self.assertRaisesRegex(read.TableError, "rows.csv:3: .*'count'"):
            read.read_words(path, ["name", "units", "count", "genes"])
        row = read.read_words(path, ["name", "rest"])[0]
        self.assertEqual(row["rest"], "0 3180 1 2 3")

    def test_no_file(self):
        """A file that is not there is an error, too."""
        with self.assertRaisesRegex(read.TableError, "none.csv"):
            read.read_csv("none.csv")


class Shards(unittest.TestCase):
    """What `cat` of the shards of a run is worth."""

    PARTS = [b"a,b\n1,2\n", b"", b"3,4\n5,6\n"]

    def shards(self, header: bool = False, run: int = 7) -> list[bytes]:
        """Three shards, each with its trailer."""
        shards = []
        for i, part in enumerate(self.PARTS, start=1):
            rows = part.count(b"\n") - (i == 1)
            if header and i > 1:
                part = b"a,b\n" + part
            shards.append(
                part + b"# shard %d/3: %d rows, crc32 %08x, run %08x\n" % (
                    i, rows, zlib.crc32(part), run))
        return shards

    def read(self, *parts: bytes, counted: bool = True) -> list[read.Row]:
        """The rows of the parts, one after the other."""
        with tempfile.NamedTemporaryFile() as file:
            file.write(b"".join(parts))
            file.flush()
            return read.read_csv(file.name, counted=counted)

    def refused(self, what: str, *parts: bytes, counted: bool = True) -> None:
        """It is an error that says so."""
        with self.assertRaisesRegex(read.TableError, what):
            self.read(*parts, counted=counted)

    def test_whole(self):
        """With a header each, or with one."""
        for header in (False, True):
            rows = self.read(*self.shards(header))
            self.assertEqual([row["b"] for row in rows], ["2", "4", "6"])

    def test_missing(self):
        """Wherever it is missing, and where nothing asked for trailers."""
        a, b, c = self.shards()
        for parts in ((a, c), (a, b), (a, c, b), (b, c), (a, a, b, c),
                      (a, b, c, a)):
            self.refused("is missing|damaged", *parts)
            self.refused("is missing|damaged", *parts, counted=False)

    def test_of_another_run(self):
        """Whole, but left over from a run before."""
        shards, others = self.shards(), self.shards(run=8)
        for i, other in enumerate(others):
            parts = shards[:i] + [other] + shards[i + 1:]
            self.refused("is of another run", *parts)
            self.refused("is of another run", *parts, counted=False)

    def test_cut_off(self):
        """Any shard, at any byte."""
        shards = self.shards()
        for i, shard in enumerate(shards):
            for n in range(len(shard)):
                parts = shards[:i] + [shard[:n]] + shards[i + 1:]
                self.refused("", *parts)

    def test_changed(self):
        """One digit."""
        a, b, c = self.shards()
        self.refused("damaged", a, b, c.replace(b"5", b"7", 1))

    def test_no_trailer(self):
        """Refused where the rows have to be counted."""
        self.refused("counts", b"a,b\n1,2\n")
        self.refused("counts", b"")
        self.assertEqual(len(self.read(b"a,b\n1,2\n", counted=False)), 1)


class Markdown(unittest.TestCase):
    """Tables as the documents have them."""

    def test_table(self):
        """Head, rule and rows, the second column to the right."""
        self.assertEqual(
            markdown.table(["a", "b"], [[1, "x"]], right=[1]),
            "| a | b |\n|---|--:|\n| 1 | x |")

    def test_numbers(self):
        """Digits as of C's %g; what is not known is a dash."""
        self.assertEqual(markdown.digits(1234567.0, 3), "1.23e+06")
        self.assertEqual(markdown.digits(math.nan, 3), "-")
        self.assertEqual(markdown.estimate(0.5, 0.25, math.nan, 4),
                         "0.5 [0.25, -]")


if __name__ == "__main__":
    unittest.main()
