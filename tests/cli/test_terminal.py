# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress of a study on a terminal (a pseudo-terminal here) and off it."""

import sys

sys.dont_write_bytecode = True

import fcntl
import os
import pty
import re
import select
import signal
import struct
import termios
import unittest

from program import DONE, PROGRAM_ERROR, USER_ERROR, ProgramTest, environment, small_study, strict_json

STUDY = small_study(
    discretisation={
        "density": ["given", "summation"],
        "layout": {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2, 3]},
    },
    resolution=[50, 100, 200],
    measure=["error", "stability"],
)
RUNS = 18


END = b"\x00end\x00"


class Terminal:
    """A pseudo-terminal with a program on it. The program's side stays open here as well: what is under way in a
    terminal whose last writer closes it may be lost."""

    def __init__(self, columns=None):
        self.ours, self.theirs = pty.openpty()
        if columns is not None:
            fcntl.ioctl(self.theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))

    def close(self):
        os.close(self.ours)
        os.close(self.theirs)

    def read(self, process, until=END):
        """All that the program writes until it ends, or until a pattern has come."""
        text, ended = b"", False
        while not re.search(until, text) and END not in text:
            if not ended and process.poll() is not None:
                ended = True
                os.write(self.theirs, END)
            if select.select([self.ours], [], [], 0.02)[0]:
                text += os.read(self.ours, 65536)
        return text.removesuffix(END)


def screen(text):
    """The lines that a terminal shows in the end."""
    lines = []
    for raw in text.decode().replace("\r\n", "\n").split("\n"):
        line = ""
        for part in re.split(r"(\r|\x1b\[K)", raw):
            if part == "\r":
                column = 0
            elif part == "\x1b[K":
                line = line[:column]
            elif part:
                column = column if line else 0
                line = line[:column] + part + line[column + len(part) :]
                column += len(part)
        lines.append(line.rstrip())
    return lines


def terminals_exist():
    """A bare chroot or container may have none; the tests on one are then skipped, not failed."""
    try:
        for end in os.openpty():
            os.close(end)
        return True
    except OSError:
        return False


@unittest.skipUnless(terminals_exist(), "no pseudo-terminal can be opened here")
class OnATerminal(ProgramTest):
    def start_on_terminal(self, *arguments, streams=("stderr",), columns=None, **options):
        terminal = Terminal(columns)
        self.addCleanup(terminal.close)
        return self.start(*arguments, **{stream: terminal.theirs for stream in streams}, **options), terminal

    def start_study(self):
        study = self.write("study.json", STUDY)
        return self.start_on_terminal("study", study, "-o", self.folder / "results.json")

    def test_a_bar_redraws_itself_in_one_line_and_leaves_nothing_behind(self):
        process, terminal = self.start_study()
        text = terminal.read(process)
        self.assertEqual(process.wait(timeout=60), DONE, text)
        bars = re.findall(rb"\r\[(=*) *\] (\d+)/%d  " % RUNS, text)
        self.assertTrue(bars, text)
        self.assertEqual(int(bars[-1][1]), RUNS)
        done = [int(count) for _, count in bars]
        self.assertEqual(done, sorted(done))
        self.assertEqual(len({len(bar) for bar in re.findall(rb"\[=* *\]", text)}), 1, "the bar keeps its width")
        after_heading = text.split(b"\n", 1)[1]
        self.assertNotIn(b"\n", after_heading, "the bar stays in its line")
        self.assertTrue(text.endswith(b"\r\x1b[K"), "the line is wiped in the end")
        self.assertEqual(screen(text), [f"{RUNS} runs", ""])

    def test_a_bar_fits_into_80_columns(self):
        process, terminal = self.start_study()
        text = terminal.read(process)
        process.wait(timeout=60)
        bars = re.findall(rb"\r(\[[^\r\x1b]*)", text)
        self.assertTrue(bars)
        for drawn in bars:
            self.assertLessEqual(len(drawn), 80, drawn)

    def test_an_interrupt_wipes_the_bar_and_ends_with_one_line(self):
        study = self.write("study.json", STUDY | {"resolution": [50, 100, 200, 300, 400]})
        process, terminal = self.start_on_terminal("study", study, "-o", self.folder / "results.json")
        text = terminal.read(process, until=rb"\r\[")
        process.send_signal(signal.SIGINT)
        text += terminal.read(process)
        self.assertEqual(process.wait(timeout=60), PROGRAM_ERROR, text)
        shown = screen(text)
        self.assertEqual(len(shown), 3, shown)
        self.assertTrue(shown[1].startswith("sphverify: interrupted"), shown)
        self.assertEqual(shown[2], "")

    def test_results_on_standard_output_are_not_mixed_with_the_bar(self):
        study = self.write("study.json", small_study())
        process, terminal = self.start_on_terminal("study", study)
        output = process.stdout.read()
        terminal.read(process)
        self.assertEqual(process.wait(timeout=60), DONE)
        self.assertEqual(strict_json(output.decode())["schema"], "sphverify-results/1")

    def test_a_table_on_a_terminal_sets_off_the_best_by_colour_and_star(self):
        study = small_study(formulations=["conduction/brookshaw", "conduction/lucy-flux"])
        self.study(study)
        process, terminal = self.start_on_terminal("compare", "results.json", streams=("stdout",))
        text = terminal.read(process).decode().replace("\r\n", "\n")
        self.assertEqual(process.wait(timeout=60), DONE)
        self.assertRegex(text, r"\x1b\[[0-9;]+m[^\x1b]*\*[^\x1b]*\x1b\[0m")
        plain = re.sub(r"\x1b\[[0-9;]*m", "", text)
        self.assertEqual([line.rstrip() for line in plain.splitlines()],
                         [line.rstrip() for line in self.succeed("compare", "results.json").splitlines()])  # fmt: skip


    def text_on_terminal(self, *arguments, **options):
        process, terminal = self.start_on_terminal(*arguments, streams=("stdout",), **options)
        text = terminal.read(process).decode().replace("\r\n", "\n")
        self.assertEqual(process.wait(timeout=60), DONE)
        return text

    def test_tables_are_as_wide_as_the_terminal_and_columns_has_the_last_word(self):
        formulations = [f"conduction/{name}" for name in ("brookshaw", "lucy-flux", "campbell-flux")]
        self.study(small_study(formulations=formulations, smoothing_exponent=[0, 0.25, 0.5, 0.75, 1]))
        for columns in (60, 100, 150):
            text = self.text_on_terminal("compare", "results.json", columns=columns)
            widest = max(len(re.sub(r"\x1b\[[0-9;]*m", "", line)) for line in text.splitlines())
            self.assertLessEqual(widest, columns)
            self.assertGreater(widest, 0.8 * columns)
        told = self.text_on_terminal("compare", "results.json", columns=150, env=environment(COLUMNS="60"))
        self.assertEqual(told, self.text_on_terminal("compare", "results.json", columns=60))

    def test_in_a_pipe_tables_are_as_wide_as_the_terminal_beside_it(self):
        self.study(small_study(smoothing_exponent=[0, 0.25, 0.5, 0.75, 1]))
        process, _ = self.start_on_terminal("compare", "results.json", streams=("stderr",), columns=61)
        piped = process.stdout.read().decode()
        self.assertEqual(process.wait(timeout=60), DONE)
        self.assertEqual(piped, self.succeed("compare", "results.json", env=environment(COLUMNS="61")))

    def test_no_colour_where_it_is_not_wanted_or_the_terminal_is_dumb(self):
        self.study(small_study(formulations=["conduction/brookshaw", "conduction/lucy-flux"]))
        gate = {"name": "reached", "measure": "error", "field": "temperature", "maximum": 1}
        self.write("gates.json", {"schema": "sphverify-gates/1", "gates": [{**gate, "select": {}}]})
        for command in (("compare", "results.json"), ("gate", "results.json", "gates.json")):
            for variables, coloured in (({"NO_COLOR": "1"}, False), ({"TERM": "dumb"}, False),
                                        ({"NO_COLOR": ""}, True), ({"TERM": "xterm"}, True)):  # fmt: skip
                with self.subTest(command=command[0], variables=variables):
                    text = self.text_on_terminal(*command, env=environment(**variables))
                    self.assertEqual("\x1b" in text, coloured)

    def test_progress_on_a_dumb_terminal_is_plain_lines_and_a_bar_is_never_wider_than_its_terminal(self):
        study = self.write("study.json", STUDY)
        process, terminal = self.start_on_terminal("study", study, "-o", "r.json", env=environment(TERM="dumb"))
        text = terminal.read(process).decode().replace("\r\n", "\n")
        self.assertEqual(process.wait(timeout=60), DONE)
        self.assertNotRegex(text, r"[\r\x1b]")
        process, terminal = self.start_on_terminal("study", study, "-o", "r.json", columns=44)
        bars = re.findall(rb"\r(\[[^\r\x1b]*)", terminal.read(process))
        self.assertEqual(process.wait(timeout=60), DONE)
        self.assertTrue(bars)
        self.assertLess(max(map(len, bars)), 44)

    def test_lists_and_descriptions_fit_into_80_columns_and_say_what_they_say_off_a_terminal(self):
        lists = strict_json(self.succeed("list", "--json"))
        ids = [entry["id"] for kind, entries in lists.items() if kind != "schema" for entry in entries]
        wide = 0
        for arguments in [("list",), ("list", "cases"), *(("describe", one) for one in ids)]:
            with self.subTest(arguments=arguments):
                text = self.text_on_terminal(*arguments)
                self.assertLessEqual(max(map(len, text.splitlines())), 80)
                plain = self.succeed(*arguments)
                self.assertEqual(text.split(), plain.split())
                wide += max(map(len, plain.splitlines())) > 80
        self.assertGreater(wide, 10, "or nothing had to be broken")


class OffATerminal(ProgramTest):
    def test_progress_is_plain_lines(self):
        study = self.write("study.json", STUDY)
        result = self.run_program("study", study, "-o", self.folder / "results.json")
        self.assertEqual(result.returncode, DONE)
        self.assertEqual(result.stdout, "")
        self.assertNotRegex(result.stderr, r"[\r\x1b]")
        lines = result.stderr.splitlines()
        self.assertEqual(lines[0], f"{RUNS} runs")
        self.assertRegex(lines[-1], rf"^{RUNS}/{RUNS} runs \(100%\), \d+ s$")
        self.assertLess(len(lines), 10, "a line every few seconds, not one per run")

    def test_a_log_hears_of_a_run_that_takes_long_before_it_ends(self):
        code = {"id": "external/slow", "command": ["sh", "-c", "sleep 7", "{initial}", "{final}"]}
        study = self.write("study.json", small_study(formulations=[code], resolution=[8]))
        result = self.run_program("study", study, "-o", self.folder / "results.json")
        self.assertEqual(result.returncode, DONE, result.stderr)
        lines = result.stderr.splitlines()
        self.assertEqual(lines[0], "1 runs")
        self.assertRegex(lines[1], r"^0/1 runs \(0%\), \d+ s$")
        self.assertEqual([line for line in lines[2:] if re.match(r"\d+/\d+ runs", line)], lines[2:3])
        self.assertRegex(lines[2], r"^1/1 runs \(100%\), \d+ s$")
        self.assertNotRegex(result.stderr, r"[\r\x1b]")

    def test_a_study_of_which_nothing_can_run_says_so_and_why(self):
        study = self.write("study.json", small_study(formulations=["momentum/p-rho2", "momentum/sqrt-p"]))
        result = self.run_program("study", study)
        self.assertEqual(result.returncode, USER_ERROR)
        results = strict_json(result.stdout)
        self.assertEqual((len(results["skipped"]), results["runs"]), (2, []))
        column = 1 + study.read_text().index('"formulations"')
        self.assertEqual(
            result.stderr,
            f"sphverify: {study}:1:{column}: formulations: found nothing to run: all of its 2 combinations are skipped (the first: "
            "momentum/p-rho2 on conduction/slab-dirichlet: a momentum form has no rate on a "
            "conduction case), expected a combination that makes sense\n",
        )
        # The document that says so is there, and no journal is left.
        result = self.run_program("study", study, "-o", self.folder / "results.json")
        self.assertEqual(result.returncode, USER_ERROR)
        self.assertEqual(len(strict_json((self.folder / "results.json").read_text())["skipped"]), 2)
        self.assertEqual([path.name for path in self.folder.glob("*.journal")], [])

    def test_a_support_wider_than_the_domain_is_remarked(self):
        wide = small_study(resolution=[10, 40], discretisation={"smoothing_ratio": 5.0})
        study = self.write("study.json", wide)
        result = self.run_program("study", study, "-o", self.folder / "results.json")
        self.assertEqual(result.returncode, DONE)
        remark = "support wider than the domain: 2 m against 1 m along axis 1"
        self.assertIn(f"remark: 1 of 2 runs: {remark}\n", result.stderr)
        runs = strict_json((self.folder / "results.json").read_text())["runs"]
        self.assertEqual([run["remarks"] for run in runs], [[remark], []])

    def test_what_is_not_known_of_the_time_error_is_said(self):
        study = self.write("study.json", small_study(measure=["conservation"], cases=["hydro/acoustic"],
                                                     formulations=["momentum/p-rho2"], discretisation=None))  # fmt: skip
        results = strict_json(self.succeed("study", study))
        for run in results["runs"]:
            self.assertIsNone(run["integration"]["time_error_share"])
            self.assertIn("not asked for", run["integration"]["remark"])
        results = strict_json(self.succeed("study", self.write("study.json", small_study())))
        for run in results["runs"]:
            self.assertIsNotNone(run["integration"]["time_error_share"])
            self.assertEqual(run["integration"]["remark"], "")

    def test_how_runs_ended_is_said_unless_all_are_ok(self):
        for budget, said in ((1e-9, ["of 3 runs 0 ok, 3 timed-out"]), (60, [])):
            study = self.write("study.json", small_study(time_budget=budget))
            result = self.run_program("study", study, "-o", self.folder / "r.json")
            self.assertEqual(result.returncode, DONE)
            self.assertEqual([line for line in result.stderr.splitlines() if line.startswith("of ")], said)

    def test_results_go_to_standard_output_when_no_file_is_named(self):
        study = self.write("study.json", small_study())
        before = sorted(self.folder.iterdir())
        results = strict_json(self.succeed("study", study))
        self.assertEqual(len(results["runs"]), 3)
        self.assertEqual(sorted(self.folder.iterdir()), before, "no journal without a file")


if __name__ == "__main__":
    unittest.main(verbosity=2)
