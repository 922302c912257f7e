# SPDX-License-Identifier: GPL-3.0-or-later
"""`sphverify order`: orders, floors and verdicts of ladders that somebody else measured."""

import sys

sys.dont_write_bytecode = True

import subprocess
import unittest

from program import PROGRAM, USER_ERROR, ProgramTest, complaints, strict_json

PUBLISHED = """# a first-order scheme, and one that stops at a floor
N,first,floored
10,0.195,1.01e-5
20,0.110,9.9e-7
40,0.0566,1.08e-6
80,0.0285,1.08e-6
160,0.0143,1.19e-6
"""


def order(table, *arguments):
    return subprocess.run(
        [PROGRAM, "order", "-", *arguments], input=table, capture_output=True, text=True, timeout=60
    )


class Order(ProgramTest):
    def columns(self, table, *arguments):
        done = order(table, "--format", "json", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        document = strict_json(done.stdout)
        self.assertEqual(complaints("sphverify-orders-1", document), [])
        return document["columns"]

    def test_each_column_is_judged_by_itself(self):
        columns = self.columns(PUBLISHED)
        self.assertEqual(list(columns), ["first", "floored"])
        first, floored = columns["first"], columns["floored"]
        self.assertEqual(first["verdict"], "asymptotic")
        self.assertLess(first["interval"][0], 1)
        self.assertGreater(first["interval"][1], 1)
        self.assertEqual(floored["verdict"], "floored")
        self.assertIsNone(floored["order"])
        self.assertLess(floored["floor"]["interval"][0], 1.08e-6)
        self.assertGreater(floored["floor"]["interval"][1], 1.08e-6)

    def test_targets_are_reached_at_an_N_or_never(self):
        columns = self.columns(PUBLISHED, "--target", "1e-3", "1e-8")
        first, floored = columns["first"]["targets"], columns["floored"]["targets"]
        self.assertAlmostEqual(first[0]["N"], 0.0143 * 160 / 1e-3, delta=100)
        self.assertIsNone(floored[1]["N"])
        self.assertIn("never", floored[1]["remark"])

    def test_spacings_and_seeds_are_read(self):
        rows = [f"{1 / n},{seed},{(1 + 0.01 * seed) / n**2}" for n in (8, 16, 32, 64) for seed in (1, 2, 3)]
        column = self.columns("spacing,seed,l2\n" + "\n".join(rows) + "\n")["l2"]
        self.assertAlmostEqual(column["order"], 2, delta=0.05)
        self.assertEqual(len(column["pairwise"]), 3)

    def test_the_order_of_the_rows_does_not_matter(self):
        lines = PUBLISHED.splitlines()
        turned = "\n".join(lines[:2] + lines[:1:-1]) + "\n"
        self.assertEqual(self.columns(PUBLISHED), self.columns(turned))

    def test_a_table_answers_in_a_screen(self):
        done = order(PUBLISHED)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        self.assertLess(len(lines), 24)
        self.assertLessEqual(max(map(len, lines)), 100)
        self.assertIn("asymptotic", done.stdout)
        self.assertIn("floored", done.stdout)

    def test_a_file_is_read_like_standard_input(self):
        path = str(self.folder / "table.csv")
        with open(path, "w", encoding="utf-8") as file:
            file.write(PUBLISHED.replace("\n", "\r\n"))
        done = subprocess.run(
            [PROGRAM, "order", path, "--format", "json"], capture_output=True, text=True, timeout=60
        )
        self.assertEqual(strict_json(done.stdout)["columns"], self.columns(PUBLISHED))

    def test_bad_tables_get_one_line_with_the_place(self):
        for table, expected in [
            ("", ["names"]),
            ("N,l2\n", ["rows"]),
            ("n,l2\n10,0.1\n", ["N or spacing"]),
            ("N,spacing,l2\n1,1,1\n", ["N and spacing"]),
            ("N,l2,l2\n1,1,1\n", ["'l2' twice"]),
            ("N\n10\n", ["no column of errors"]),
            ("N,l2\n10,0.1\n20;0.05\n", [":3", "columns", "1"]),
            ("N,l2\n10,0.1\n20,x\n", [":3", "l2", "'x'", "a number"]),
            ("N,l2\n10,0.1\n-20,0.05\n", [":3", "N", "'-20'"]),
            ("N,l2\n10,0.1\n20,-0.05\n", [":3", "l2", "'-0.05'"]),
            ("N,l2\n10,0.1\n10,0.05\n", [":3", "seed"]),
            ("N,seed,l2\n10,1,0.1\n10,1,0.05\n", [":3", "seed"]),
            ("N,l2\n10,0.1\n20,1e999\n", [":3", "l2"]),
            ("N,l2\n10,0.1\n1e200,0.05\n", [":3", "N", "1e30"]),
            ("N,\x1b[31mred\n10,1\n20,.5\n", ["names", "control characters"]),
            ("N,f\u00e9hler\n10,1\n20,.5\n", ["names", "ASCII"]),
        ]:
            with self.subTest(table=table):
                done = order(table)
                self.assertEqual(done.returncode, USER_ERROR, done.stderr)
                self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
                for word in expected:
                    self.assertIn(word, done.stderr)
        self.assertEqual(order(PUBLISHED, "--target", "nan").returncode, USER_ERROR)
        self.assertEqual(order(PUBLISHED, "--allowed", "nan").returncode, USER_ERROR)
        missing = subprocess.run([PROGRAM, "order", "none.csv"], capture_output=True, text=True, timeout=60)
        self.assertEqual(missing.returncode, USER_ERROR)
        self.assertIn("none.csv", missing.stderr)

    def test_what_spreadsheets_write_is_read(self):
        lines = PUBLISHED.splitlines()
        plain = self.columns(PUBLISHED)
        for table in ("\ufeff" + PUBLISHED, "\ufeff" + "\r\n".join(lines[1:]) + "\r\n",
                      PUBLISHED.replace("N,first,floored", '"N","first", "floored"'),
                      PUBLISHED.replace("10,0.195", '"10","0.195"')):  # fmt: skip
            with self.subTest(table=table[:40]):
                self.assertEqual(self.columns(table), plain)
        names = list(self.columns(PUBLISHED.replace("floored\n", '"l2, ""relative"""\n')))
        self.assertEqual(names, ["first", 'l2, "relative"'])
        for header in ('N,"l2', 'N,"l2"x'):
            done = order(f"{header}\n10,0.1\n20,0.05\n")
            self.assertEqual(done.returncode, USER_ERROR, done.stderr)
            self.assertIn(":1:3: columns: ", done.stderr)
            self.assertIn("quotation mark", done.stderr)

    def test_levels_that_hardly_differ_are_refused(self):
        for table, found in (("spacing,l2\n0.1,1\n0.10000000000000002,2\n", "0.1 and 0.10000000000000002"),
                             ("N,l2\n1000000,1\n1000000.5,2\n2000000,0.5\n", "1000000.5 and 1000000")):  # fmt: skip
            done = order(table)
            self.assertEqual(done.returncode, USER_ERROR, done.stdout)
            self.assertEqual(len(done.stderr.splitlines()), 1)
            self.assertIn(found, done.stderr)
            self.assertIn("1e-06", done.stderr)
        self.columns("N,l2\n1000000,1\n1000002,0.999\n")

    def test_no_number_is_none_whatever_the_table(self):
        for first, last in ((1e-29, 1e29), (1e28, 1e29), (1e-29, 1e-28)):
            for high, low in ((1e300, 1e-300), (1e-300, 1e-305), (1e308, 1e300), (1.0, 0.0), (1e-300, 1e300)):
                ns = [first * (last / first) ** (k / 4) for k in range(5)]
                es = [high * (k == 0) + (k > 0) * (high ** (1 - k / 4) * low ** (k / 4)) for k in range(5)]
                table = "N,e\n" + "".join(f"{n!r},{e!r}\n" for n, e in zip(ns, es))
                with self.subTest(table=table):
                    for form in ("table", "json"):
                        done = order(table, "--format", form)
                        self.assertEqual(done.returncode, 0, done.stderr)
                        self.assertNotRegex(done.stdout + done.stderr, r"(?i)(?<!\w)-?(nan|inf)(?!\w)")

    def test_what_the_coarsest_level_has_is_a_bound_as_in_comparisons(self):
        done = order(PUBLISHED, "--target", "0.5")
        self.assertRegex(done.stdout, r"first .*<=10")

    def test_missing_errors_are_runs_that_failed(self):
        column = self.columns("N,l2\n10,0.1\n20,0.05\n40,0.025\n80,\n")["l2"]
        self.assertEqual(column["verdict"], "diverging")
        between = self.columns("N,l2\n10,0.1\n20,nan\n40,0.025\n80,0.0125\n160,0.00625\n")["l2"]
        self.assertEqual(between["verdict"], "asymptotic")


if __name__ == "__main__":
    unittest.main()
