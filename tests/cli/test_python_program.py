# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies, comparisons and gates from python/sphverify; which program it takes, and what it raises."""

import sys

sys.dont_write_bytecode = True

import contextlib
import io
import os
import pathlib
import shutil
import signal
import subprocess
import textwrap
import time
import unittest

from program import PROGRAM, PROGRAM_ERROR, SOURCE_DIR, USER_ERROR, ProgramTest, small_study, strict_json, timeless
from python_module import pandas, path_of, sphverify

LONG = small_study(resolution=[64, 96, 128, 192, 256], discretisation={"smoothing_ratio": [1.2, 1.3, 1.4, 1.5, 1.6]})


class Studies(ProgramTest):
    def run_quietly(self, document, *arguments, **options):
        """The results, and what was shown."""
        shown = io.StringIO()
        with contextlib.redirect_stderr(shown):
            results = sphverify.study(document, *arguments, program=PROGRAM, **options)
        return results, shown.getvalue()

    def assert_raises(self, status, *words, function=sphverify.study, arguments=(), **options):
        shown = io.StringIO()
        with contextlib.redirect_stderr(shown), self.assertRaises(sphverify.Error) as caught:
            function(*arguments, program=PROGRAM, **options)
        message = str(caught.exception)
        self.assertEqual(caught.exception.status, status, message)
        self.assertNotIn("\n", message)
        self.assertNotIn(message, shown.getvalue())  # it is said once
        for word in words:
            self.assertIn(word, message)

    def test_a_document_and_a_path_give_the_same(self):
        study = small_study(measure=["error"])
        of_dict, shown = self.run_quietly(study)
        self.assertEqual(shown.splitlines()[0], "3 runs")
        self.assertRegex(shown.splitlines()[-1], r"^3/3 runs \(100%\), ")
        self.assertEqual(repr(of_dict), "<small: 3 runs (3 ok), 1 series>")
        output = self.folder / "out.json"
        of_path, _ = self.run_quietly(self.write("study.json", study), output, jobs=1)
        pandas.testing.assert_frame_equal(of_dict.levels, of_path.levels)
        self.assertEqual(timeless(strict_json(output.read_text())), timeless(self.study(study)))

    def test_the_first_lines_of_the_documentation(self):
        self.write("study.json", small_study())
        page = (SOURCE_DIR / "docs" / "python.md").read_text()
        code = page[: page.index("The module needs")].partition("\n")[2]
        done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, cwd=self.folder,
                              env=os.environ | {"PYTHONPATH": str(SOURCE_DIR / "python"), "SPHVERIFY": PROGRAM})  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_jobs_and_resume_reach_the_program(self):
        script = self.write("spy", f'#!/bin/sh\nprintf "%s\\n" "$@" >"{self.folder}/arguments"\nexec "{PROGRAM}" "$@"\n')
        script.chmod(0o755)
        output = self.folder / "out.json"
        with contextlib.redirect_stderr(io.StringIO()):
            sphverify.study(small_study(), output, program=str(script), jobs=2, resume=True)
        told = (self.folder / "arguments").read_text().split("\n")[:-1]
        self.assertEqual(told, ["study", "-", "-o", str(output), "--jobs", "2", "--resume"])

    def test_what_the_program_refuses(self):
        self.assert_raises(USER_ERROR, "-: schema: found 'other', expected sphverify-study/1", arguments=[{"schema": "other"}])
        self.assert_raises(USER_ERROR, "nowhere.json: found no readable file", arguments=["nowhere.json"])
        self.assert_raises(USER_ERROR, "jobs", arguments=[small_study()], jobs=0)
        self.assert_raises(None, "resume: found no output", arguments=[small_study()], resume=True)

    def test_a_program_that_fails_or_is_killed(self):
        for text, status, word in (
            ("echo 'sphverify: no space left' >&2; exit 3", PROGRAM_ERROR, "no space left"),
            ("exit 3", PROGRAM_ERROR, "ended with status 3"),
            ("kill -9 $$", -signal.SIGKILL, "was ended by signal 9"),
        ):
            script = self.write("broken", f"#!/bin/sh\n{text}\n")
            script.chmod(0o755)
            with self.assertRaises(sphverify.Error) as caught:
                sphverify.study(small_study(), program=str(script))
            self.assertEqual(caught.exception.status, status)
            self.assertIn(word, str(caught.exception))

    def test_ctrl_c_reaches_the_program_once(self):
        told = self.folder / "told"
        script = self.write("patient", f"""#!/bin/sh
trap 'echo interrupted >>"{told}"' INT
echo $$ >&2
while ! test -s "{told}"; do sleep 0.05; done
sleep 0.5
""")
        script.chmod(0o755)
        code = (f"import signal, sphverify; signal.signal(signal.SIGINT, signal.default_int_handler); "
                f"sphverify.study({{}}, program={str(script)!r})")  # fmt: skip
        process = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True, start_new_session=True,
                                   env=os.environ | {"PYTHONPATH": str(SOURCE_DIR / "python")})  # fmt: skip
        program = int(process.stderr.readline())

        def end():
            for pid in (process.pid, program):
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            process.communicate()

        self.addCleanup(end)
        self.assertNotEqual(os.getpgid(program), process.pid)
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        _, shown = process.communicate(timeout=60)
        self.assertIn("KeyboardInterrupt", shown)
        self.assertEqual(told.read_text(), "interrupted\n")

    def test_an_interrupted_study_ends_in_order_and_is_taken_up(self):
        output = self.folder / "out.json"
        code = (f"import signal, sphverify; signal.signal(signal.SIGINT, signal.default_int_handler); "
                f"sphverify.study({LONG!r}, {str(output)!r}, program={PROGRAM!r}, jobs=1)")  # fmt: skip
        process = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True,
                                   env=os.environ | {"PYTHONPATH": str(SOURCE_DIR / "python")})  # fmt: skip
        journal = pathlib.Path(f"{output}.journal")
        deadline = time.monotonic() + 60
        while not (journal.exists() and journal.read_text().count("\n") > 2) and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, shown = process.communicate(timeout=60)
        self.assertIn("KeyboardInterrupt", shown)
        self.assertFalse(output.exists())
        for line in journal.read_text().splitlines():
            strict_json(line)
        results, shown = self.run_quietly(LONG, output, resume=True)
        self.assertRegex(shown, r"^25 runs, \d+ of them done before")
        self.assertEqual(len(results.runs), 25)


class Found(ProgramTest):
    """An installation, a variable and a PATH, each with a program of its own."""

    def setUp(self):
        super().setUp()
        self.prefix = self.folder / "prefix"
        module = self.prefix / "lib" / "python3" / "dist-packages" / "sphverify"
        shutil.copytree(SOURCE_DIR / "python" / "sphverify", module, ignore=shutil.ignore_patterns("__pycache__"))
        for place in ("prefix/bin/sphverify", "path/sphverify", "other/mine"):
            (self.folder / place).parent.mkdir(parents=True, exist_ok=True)
            self.write(place, "#!/bin/sh\n").chmod(0o755)

    def test_order(self):
        mine = str(self.folder / "other" / "mine")
        code = """
import os, sphverify
def found(*asked, **variables):
    os.environ.update(variables)
    try:
        print(sphverify.find_program(*asked))
    except sphverify.Error as error:
        print(error)
    os.environ.pop("SPHVERIFY", None)
"""
        code += f"found({mine!r}, SPHVERIFY='sphverify')\nfound(SPHVERIFY={mine!r})\nfound()\n"
        for gone in ("prefix/bin/sphverify", "path/sphverify"):
            code += f"os.unlink({str(self.folder / gone)!r})\nfound()\n"
        code += "found('nothing')\n"
        environment = {"PATH": f"{self.folder}/path:/usr/bin:/bin", "PYTHONPATH": str(self.prefix / "lib/python3/dist-packages")}
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment)
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.stdout.replace(f"{self.folder}/", "").splitlines(), [
            "other/mine", "other/mine", "prefix/bin/sphverify", "path/sphverify",
            "found no program sphverify: expected it on PATH, or SPHVERIFY to name it",
            "found no program 'nothing', expected sphverify",
        ])  # fmt: skip


class Verdicts(ProgramTest):
    def test_gates(self):
        gates = {"schema": "sphverify-gates/1", "name": "g", "gates": [
            {"name": "holds, and <how>", "select": {}, "measure": "status", "equals": "ok"},
            {"name": "breaks", "select": {}, "measure": "error", "field": "temperature", "maximum": 1e-9},
            {"name": "known", "select": {}, "measure": "status", "equals": "unstable", "expect": "fail", "reason": "because"},
            {"name": "nothing", "select": {"case": "hydro/noh"}, "measure": "status", "equals": "ok"},
        ]}  # fmt: skip
        frame = sphverify.gate(path_of("heat"), self.write("gates.json", gates), program=PROGRAM)
        self.assertEqual(list(frame["name"]), ["holds, and <how>", "breaks", "known", "nothing"])
        self.assertEqual(list(frame["verdict"]), ["passed", "failed", "expected-failure", "selects-nothing"])
        self.assertEqual(list(frame["holds"]), [True, False, True, False])
        self.assertEqual(frame["measured"][0], "status ok")
        self.assertEqual(list(frame["limit"]), ["= ok", "<= 1e-09", "= unstable", "= ok"])
        self.assertRegex(frame["remarks"][2], "^expected to fail: because\n")
        os.environ["GITHUB_ACTIONS"] = "true"
        self.addCleanup(os.environ.pop, "GITHUB_ACTIONS")
        pandas.testing.assert_frame_equal(sphverify.gate(path_of("heat"), self.folder / "gates.json", program=PROGRAM), frame)
        with self.assertRaisesRegex(sphverify.Error, "found 'sphverify-results/1', expected sphverify-gates/1"):
            sphverify.gate(path_of("heat"), path_of("heat"), program=PROGRAM)

    def test_sections(self):
        summary = sphverify.compare(path_of("heat"), section="summary", program=PROGRAM)
        self.assertEqual(summary["formulation"][0], "conduction/brookshaw")
        changes = sphverify.compare(path_of("heat"), path_of("heat"), section="changes", program=PROGRAM)
        self.assertEqual(len(changes), 0)
        with self.assertRaisesRegex(sphverify.Error, "--norm") as caught:
            sphverify.compare(path_of("heat"), norm="l3", program=PROGRAM)
        self.assertEqual(caught.exception.status, USER_ERROR)


if __name__ == "__main__":
    unittest.main()
