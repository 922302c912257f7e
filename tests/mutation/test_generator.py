# SPDX-License-Identifier: GPL-3.0-or-later
"""The generator of mutants on snippets: what its rules make of them, and that a program with mutants in it is the original
until one is chosen, and then the broken one."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE / "generator")]
sys.dont_write_bytecode = True

import draw  # noqa: E402
import pieces  # noqa: E402
from pieces import ON, Mutant  # noqa: E402
from score import wilson  # noqa: E402

try:
    import compiler
    import cpp_rules
    compiler.load_library()
    compiler.cindex.Index.create()
except Exception as missing:  # the bindings, or the library that they load
    cpp_rules, reason = None, f"needs python3-clang-14: {missing}"
needs_clang = unittest.skipIf(cpp_rules is None, "" if cpp_rules else reason)

ARGUMENTS = ["-std=c++20", *(compiler.ANYHOW if cpp_rules else [])]


def places_of(text, folder):
    path = pathlib.Path(folder) / "snippet.cpp"
    path.write_text(text)
    unit = compiler.Unit(path, path, ARGUMENTS)
    assert unit.errors == 0, list(unit.unit.diagnostics)
    return unit, cpp_rules.Places("snippet.cpp", text).read(unit.unit, str(path))


def edit(start, end, number):
    return Mutant("f", start, end, "operator", "", pieces.choice(["x"], [(start, end)]), ["x"], number=number)


class PiecesTest(unittest.TestCase):
    def test_a_mutant_inside_another_is_in_its_sound_version(self):
        text = pieces.render("a + (b * c);", [edit(0, 11, 1), edit(5, 10, 2)], lambda m: f"on({m.number})")
        self.assertEqual(text, "(on(1) ? (x) : (a + ((on(2) ? (x) : (b * c)))));")

    def test_mutants_that_cut_each_other_do_not_go_together(self):
        self.assertTrue(pieces.conflict(edit(0, 5, 1), edit(3, 8, 2)))
        self.assertTrue(pieces.conflict(edit(0, 5, 1), edit(0, 5, 2)))
        self.assertFalse(pieces.conflict(edit(0, 8, 1), edit(3, 5, 2)))
        self.assertFalse(pieces.conflict(edit(0, 5, 1), edit(5, 8, 2)))
        without_middle = Mutant("f", 0, 8, "", "", [(0, 2), ON, (6, 8)], [])
        self.assertTrue(pieces.conflict(without_middle, edit(3, 5, 2)))


class DrawTest(unittest.TestCase):
    ROOMS = {"one": {"a.cpp": 300, "b.cpp": 300}, "two": {"c.cpp": 200}}

    def test_rooms_have_their_share_of_lines(self):
        order = draw.draw_files(self.ROOMS, 80, 1)
        self.assertEqual(sum(room == "one" for room, _ in order.values()), 60)

    def test_a_mutant_does_not_depend_on_how_many_are_drawn(self):
        few, many = (draw.draw_files(self.ROOMS, n, 7) for n in (10, 40))
        self.assertEqual(few, {n: many[n] for n in few})
        self.assertNotEqual(few, draw.draw_files(self.ROOMS, 10, 8))


class ScoreTest(unittest.TestCase):
    def test_the_interval_is_wilsons(self):
        # Newcombe 1998, table I: 81 of 263, 15 of 148, 0 of 20.
        for k, n, low, high in ((81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611)):
            self.assertAlmostEqual(wilson(k, n)[0], low, 4)
            self.assertAlmostEqual(wilson(k, n)[1], high, 4)


@needs_clang
class CppRulesTest(unittest.TestCase):
    def made(self, text):
        with tempfile.TemporaryDirectory() as folder:
            _, places = places_of(text, folder)
        return {(m.rule, m.says) for ms in places.found.values() for m in ms}, places.left_out

    def test_each_rule_makes_its_mutants(self):
        for code, rule, says in (
                ("double f(double a, double b) { return a + b; }", "operator", "a - b"),
                ("double f(double a, double b) { return a * b; }", "operator", "a / b"),
                ("double f(double a, double b) { return a + b; }", "dropped", "a"),
                ("double f(double a, double b) { return a - b; }", "dropped", "-(b)"),
                ("double f(double a, double b) { return a * b; }", "dropped", "b"),
                ("double f(double a) { return -a; }", "sign", "a"),
                ("bool f(double a) { return a < 1.0; }", "comparison", "a <= 1.0"),
                ("bool f(int a, int b) { return a >= b; }", "comparison", "a > b"),
                ("bool f(bool a, bool b) { return a && b; }", "operator", "a || b"),
                ("bool f(bool a) { return !a; }", "lost !", "static_cast<bool>(a)"),
                ("void f(int& a) { a += 2; }", "operator", "a -= 2"),
                ("void f(int& a) { a = 2; }", "left out", ";"),
                ("int f(int const* a, int i) { return a[i]; }", "index", "beside(i)"),
                ("int f() { return 3; }", "off by one", "3 - 1"),
                ("double f() { return 0.5; }", "constant", "2 * 0.5"),
                ("constexpr double half = 0.5; double f() { return half; }", "constant", "2 * 0.5"),
                ("enum class E { a, b }; E f() { return E::a; }", "constant", "E::b"),
                ("double g(double, double); double f(double a, double b) { return g(a, b); }", "swapped", "b, a"),
                ("struct S { double x, y; }; double f(S s) { return s.x; }", "member", "s.y"),
                ("int f(int a) { if (a > 0) return 1; return 2; }", "condition", "!(a > 0)"),
                ("bool f(int a) { return a > 0; }", "early return", " return true; ")):
            with self.subTest(code=code, rule=rule):
                self.assertIn((rule, says), self.made(code)[0])

    def test_what_changes_nothing_is_left_out(self):
        for code, reason, absent in (
                ("double f(double a) { return a + 0.0; }", "neutral", "a"),
                ("double f(double a) { return 1 * a; }", "neutral", "a"),
                ("bool f(double a, double b) { return a < b; }", "boundary of floats", "a <= b"),
                ("double g(double, double); double f(double a) { return g(a, a); }", "same text", "a, a"),
                ("template <int n> int g(); int f() { return g<3>(); }", None, "3 + 1"),
                ("int f(int a) { switch (a) { case 4: return 1; } return 2; }", "fixed in compilation", "4 + 1"),
                ("void f() { int a[5]; (void)a; }", None, "5 + 1"),
                ("struct S { static constexpr int n = 6; };", "fixed in compilation", "6 + 1")):
            with self.subTest(code=code):
                made, left_out = self.made(code)
                self.assertNotIn(absent, {says for _, says in made})
                if reason:
                    self.assertGreater(left_out[reason], 0)


PROGRAM = """#include <cstdio>
#include <cstddef>
struct Pair { double first, second; };
constexpr double half = 0.5;
struct Slots { int used = 0, none = -1; };
constexpr int free_slot() { return Slots{}.none; }
constexpr int twice(int n) { return 2 * n; }
double mean(Pair p) { return half * (p.first + p.second); }
double largest(double const* values, int n) {
  double most = values[0];
  for (int k = 1; k < n; ++k) {
    if (values[k] > most) most = values[k];
  }
  return most;
}
int main() {
  double const values[4] = {3.0, -1.0, 7.0, 2.0};
  static_assert(twice(2) == 4 && free_slot() == -1);
  std::printf("%g %g %d\\n", mean({values[0], values[1]}), largest(values, 4), twice(21));
}
"""


def compiled(folder, name, text):
    source = pathlib.Path(folder) / f"{name}.cpp"
    source.write_text(text)
    program = source.with_suffix("")
    runtime = HERE / "generator" / "mutants.cpp"
    subprocess.run(["c++", "-std=c++20", "-w", "-fsanitize=address", source, runtime, "-o", program], check=True)
    return program


def output(program, chosen=""):
    environment = {k: v for k, v in os.environ.items() if k != "SPHVERIFY_MUTANT"}
    if chosen:
        environment["SPHVERIFY_MUTANT"] = str(chosen)
    return subprocess.run([program], env=environment, capture_output=True, text=True, timeout=20).stdout


@needs_clang
class SchemataTest(unittest.TestCase):
    def test_a_program_is_the_original_until_a_mutant_is_chosen_and_then_the_broken_one(self):
        with tempfile.TemporaryDirectory() as folder:
            unit, places = places_of(PROGRAM, folder)
            taken = []
            for number in range(1, 13):
                mutant, _ = draw.choose(places.found, number, 5, taken,
                                        lambda m: unit.compiles(pieces.render(PROGRAM, [m], draw.guard)))
                if mutant:
                    taken.append(mutant)
            self.assertGreater(len(taken), 8)
            together = compiled(folder, "together", draw.instrumented(PROGRAM, taken))
            sound = output(compiled(folder, "sound", PROGRAM))
            self.assertEqual(output(together), sound)
            noticed = 0
            for k, mutant in enumerate(taken[:4]):
                text = PROGRAM[:mutant.start] + pieces.mutated_text(PROGRAM, mutant) + PROGRAM[mutant.end:]
                text = text.replace("beside(", "::mutation::beside(")
                alone = compiled(folder, f"alone{k}", f'#include "{HERE}/generator/mutants.hpp"\n' + text)
                with self.subTest(mutant=mutant.says, line=mutant.line):
                    self.assertEqual(output(together, mutant.number), output(alone))
                noticed += output(alone) != sound
            self.assertGreater(noticed, 1)

    def test_what_a_member_begins_with_may_be_asked_for_in_compilation(self):
        text = ("struct Slots { int used = 3; bool known = true; };\nconstexpr int first() { return Slots{}.used; }\n"
                "static_assert(first() == 3);\nint main() { return first() + Slots{}.known; }\n")
        with tempfile.TemporaryDirectory() as folder:
            unit, places = places_of(text, folder)
            inside = [m for ms in places.found.values() for m in ms if m.line == 1]
            self.assertGreater(len(inside), 1)
            for number, mutant in enumerate(inside, 1):
                mutant.number = number
                with self.subTest(mutant=mutant.says):
                    self.assertTrue(unit.compiles(pieces.render(text, [mutant], draw.guard)))

    def test_a_recording_run_says_what_it_reaches(self):
        text = "int f(int a) { if (a > 0) return 1; return 2; }\nint g() { return 3; }\nint main() { return f(1) - 1; }\n"
        with tempfile.TemporaryDirectory() as folder:
            _, places = places_of(text, folder)
            by_says = {m.says: m for ms in places.found.values() for m in ms}
            taken = [by_says["!(a > 0)"], by_says["3 + 1"]]
            taken[0].number, taken[1].number = 1, 2
            program = compiled(folder, "program", draw.instrumented(text, taken))
            marks = pathlib.Path(folder) / "marks"
            marks.write_bytes(bytes(3))
            self.assertEqual(output(program, f"record:{marks}"), "")
            self.assertEqual(list(marks.read_bytes()), [0, 1, 0])


class PageRulesTest(unittest.TestCase):
    def test_each_rule_makes_its_mutants_and_the_script_still_runs(self):
        folder = pathlib.Path(os.environ.get("ACORN_FOLDER", HERE.parents[1] / "build" / "mutants" / "node"))
        if not (folder / "node_modules" / "acorn").is_dir():
            self.skipTest("needs acorn, which tests/mutation/generate fetches")
        script = ("function f(a, b, list) {\n  if (!a) return list[1];\n  return g(a * 0.5, b * 2) + (a < b ? 1 : -a);\n}\n"
                  "const g = (x, y) => x - y;\nf(2, 3, [4, 5]);\n")
        with tempfile.TemporaryDirectory() as place:
            path = pathlib.Path(place) / "script.js"
            path.write_text(script)
            done = subprocess.run(["node", HERE / "generator" / "page_rules.mjs", folder, path], check=True,
                                  capture_output=True, text=True)
            found = json.loads(done.stdout)[0]["mutants"]
            made = {(m["rule"], m["says"]) for m in found}
            for expected in (("lost !", "Boolean(a)"), ("index", "1 - 1, or 1 for 0"), ("constant", "2 * 0.5"),
                             ("swapped", "b * 2, a * 0.5"), ("comparison", "a <= b"), ("condition", "!(a < b)"),
                             ("sign", "a"), ("operator", "x + y"), ("early return", " return; ")):
                self.assertIn(expected, made)
            for m in found:
                mutant = Mutant("script.js", m["start"], m["end"], m["rule"], m["says"],
                                [p if isinstance(p, str) else tuple(p) for p in m["pieces"]], [], number=1)
                text = pieces.render(script, [mutant], lambda _: "__mutant(1)")
                text = text.replace("f(2, 3, [4, 5]);", "console.log(f(2, 3, [4, 5]));")
                said = subprocess.run(["node", "-e", "globalThis.__mutant = () => false;\n" + text], capture_output=True,
                                      text=True)
                self.assertEqual(said.returncode, 0, m)


if __name__ == "__main__":
    unittest.main()
