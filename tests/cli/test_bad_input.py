# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input: one line that says which file, which key, what was found and what was expected; exit status 2; nothing
on standard output; no file touched; no crash and no wait."""

import sys

sys.dont_write_bytecode = True

import copy
import json
import os
import random
import resource
import subprocess
import time
import unittest

from program import (
    PROGRAM,
    PROGRAM_ERROR,
    SECONDS_FOR_AN_ANSWER,
    SOURCE_DIR,
    USER_ERROR,
    ProgramTest,
    small_study,
    strict_json,
    without,
)

OLD = "results of last week\n"


class BadInput(ProgramTest):
    def setUp(self):
        super().setUp()
        self.old = self.write("old.json", OLD)
        os.utime(self.old, (1_000_000_000, 1_000_000_000))

    def refuse(self, *arguments, text=None, words=()):
        """The program refuses at once, and an older output and everything else in the folder stays as it was."""
        before = sorted(self.folder.iterdir())
        start = time.monotonic()
        result = self.run_program(*arguments, text=text, timeout=60)
        self.assertLess(time.monotonic() - start, SECONDS_FOR_AN_ANSWER)
        self.assert_user_error(result, *words)
        self.assertLess(len(result.stderr), 2000)
        for sign in ("Traceback", "terminate called", "what():", "std::", "basic_", "json.exception", ".cpp"):
            self.assertNotIn(sign, result.stderr)
        self.assertEqual(self.old.read_text(), OLD)
        self.assertEqual(os.stat(self.old).st_mtime, 1_000_000_000)
        self.assertEqual(sorted(self.folder.iterdir()), before)

    def refuse_study(self, document, *words):
        path = self.write("bad.json", document)
        self.refuse("study", path, "-o", self.old, words=(path, *words))

    def refuse_state(self, document, *words):
        path = self.write("state.json", document)
        self.refuse("evaluate", path, "-o", self.old, words=(path, *words))


class Studies(BadInput):
    def test_an_unknown_identifier_is_refused_with_the_nearest_one(self):
        for change, key, near in (
            ({"cases": ["conduction/slab-dirichle"]}, "cases[0]", "conduction/slab-dirichlet"),
            ({"cases": [{"id": "marshack"}]}, "cases[0].id", "conduction/marshak"),
            ({"formulations": ["brookshaw"]}, "formulations[0]", "conduction/brookshaw"),
            ({"formulations": ["conduction/lucy_flux"]}, "formulations[0]", "conduction/lucy-flux"),
            ({"formulations": [{"id": "momentum/p-rho"}]}, "formulations[0].id", "momentum/p-rho2"),
            ({"discretisation": {"kernel": "cubic-splin"}}, "discretisation.kernel", "cubic-spline"),
            ({"discretisation": {"density": "gven"}}, "discretisation.density", "given"),
            ({"discretisation": {"face_weight": ["exact", "campbel"]}}, "discretisation.face_weight[1]", "campbell"),
            ({"discretisation": {"layout": "latice"}}, "discretisation.layout", "lattice"),
            ({"measure": ["error", "stabilty"]}, "measure[1]", "stability"),
        ):
            with self.subTest(change=change):
                self.refuse_study(small_study(**change), f"{key}: ", f"did you mean '{near}'?")

    def test_an_unknown_key_is_refused_with_the_nearest_one(self):
        for change, key, near in (
            ({"resolutoin": 10}, "resolutoin", "resolution"),
            ({"discretisation": {"densty": "given"}}, "discretisation.densty", "density"),
            ({"cases": [{"id": "conduction/marshak", "paramters": {}}]}, "cases[0].paramters", "parameters"),
            ({"cases": [{"id": "conduction/marshak", "parameters": {"exponnt": 3}}]},
             "cases[0].parameters.exponnt", "exponent"),
            ({"formulations": [{"id": "conduction/brookshaw", "wals": "off"}]}, "formulations[0].wals", "walls"),
            ({"discretisation": {"layout": {"id": "jittered", "amplitude": 0.1, "sed": 1}}},
             "discretisation.layout.sed", "seed"),
        ):  # fmt: skip
            with self.subTest(change=change):
                self.refuse_study(small_study(**change), f"{key}: found an unknown key", f"'{near}'?")

    def test_a_missing_key_is_refused(self):
        for key in ("schema", "name", "cases", "formulations", "resolution"):
            with self.subTest(key=key):
                self.refuse_study(small_study(**{key: None}), f"{key}: found nothing")
        self.refuse_study(small_study(cases=[{"parameters": {}}]), "cases[0].id: found nothing")
        layout = {"id": "jittered", "amplitude": 0.1}
        self.refuse_study(small_study(discretisation={"layout": layout}), "discretisation.layout.seed")

    def test_a_resolution_that_is_no_positive_whole_number_is_refused(self):
        for value, shown in ((-10, "-10"), (0, "0"), (10.5, "10.5"), ("10", "'10'"), (None, "null"), (True, "true"),
                             ({}, "an object"), ([], "an empty list"), (1e300, "1e+300")):  # fmt: skip
            with self.subTest(value=value):
                self.refuse_study({**small_study(), "resolution": value}, "resolution: ", f"found {shown}, expected")
        self.refuse_study(small_study(resolution=[20, -10]), "resolution[1]: found -10")
        self.refuse_study(small_study(resolution=[20, 10]), "resolution[1]: found 10", "ascending")
        self.refuse_study(small_study(resolution=[10, 10]), "resolution[1]: found 10", "ascending")

    def test_more_combinations_than_anybody_can_mean_are_refused_before_they_are_made(self):
        layout = {"id": "jittered", "amplitude": 0.1, "seeds": list(range(1, 1001))}
        self.refuse_study(small_study(discretisation={"layout": layout, "smoothing_ratio": [1 + 0.001 * k for k in range(500)]}),
                          "found lists of 1.5e+06 combinations, expected at most 200000")  # fmt: skip

    def test_what_does_not_fit_into_memory_is_refused_with_what_it_would_take(self):
        cube = small_study(cases=["conduction/cube"], resolution=[10, 100_000])
        self.refuse_study(cube, "resolution: found 100000, which on conduction/cube is 1e+15 particles", "GB, expected")
        growing = small_study(cases=["conduction/cube"], resolution=[10, 300], smoothing_exponent=[1])
        self.refuse_study(growing, "resolution: found 300", "2.7e+07 particles", "GB")

    def test_what_does_not_fit_into_the_memory_that_the_process_may_have_is_refused(self):
        path = self.write("cube.json", small_study(cases=["conduction/cube"], resolution=[100]))
        limit = 600_000_000

        def run_limited(*arguments):
            return subprocess.run(
                [PROGRAM, *arguments], capture_output=True, text=True, timeout=60,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))  # fmt: skip

        if run_limited("list").returncode != 0:
            self.skipTest("a sanitizer takes more address space than that to begin with")
        result = run_limited("study", path)
        self.assert_user_error(result, path, "resolution: found 100", "1e+06 particles", "the 0.6 GB that this process may have")

    def test_a_glass_needs_its_seed_and_nothing_else(self):
        self.refuse_study(small_study(discretisation={"layout": "glass"}), "discretisation.layout", "seed")
        layout = {"id": "glass", "seed": 1, "amplitude": 0.1}
        self.refuse_study(small_study(discretisation={"layout": layout}), "discretisation.layout.amplitude")

    def test_a_parameter_of_the_wrong_type_is_refused(self):
        for case, name, value, shown in (
            ("conduction/slab-dirichlet", "final_time", "soon", "'soon'"),
            ("conduction/slab-dirichlet", "left", None, "null"),
            ("conduction/slab-dirichlet", "left", True, "true"),
            ("conduction/slab-dirichlet", "left", [1], "a list"),
            ("conduction/slab-dirichlet", "modes", 1, "1"),
            ("conduction/slab-dirichlet", "modes", [1, 2], "1"),
            ("conduction/slab-dirichlet", "modes", [["one", 2]], "'one'"),
            ("operator/polynomial", "degree", 1.5, "1.5"),
            ("operator/sine", "dimension", "2", "'2'"),
        ):
            with self.subTest(parameter=name, value=value):
                study = small_study(cases=[{"id": case, "parameters": {name: value}}])
                self.refuse_study(study, f"cases[0].parameters.{name}", f"found {shown}, expected")

    def test_a_parameter_without_a_meaning_is_refused(self):
        for case, name, value in (
            ("conduction/slab-dirichlet", "final_time", -1),
            ("conduction/slab-dirichlet", "final_time", 0),
            ("conduction/slab-dirichlet", "conductivity", 0),
            ("conduction/slab-dirichlet", "density", -1),
            ("operator/sine", "dimension", 4),
            ("operator/polynomial", "degree", -1),
            ("conduction/barenblatt", "exponent", 1),
            ("conduction/barenblatt", "half_width", 1),
            ("conduction/marshak", "exponent", 0),
            ("conduction/marshak", "final_time", 100),
        ):
            with self.subTest(parameter=name, value=value):
                study = small_study(cases=[{"id": case, "parameters": {name: value}}])
                self.refuse_study(study, f"cases[0].parameters.{name}: found ", "expected")

    def test_a_mode_that_is_no_pair_or_has_no_whole_number_is_refused(self):
        for modes in ([[1]], [[1, 2, 3]], [[1.5, 1]], [[1e30, 1]], [[-1, 1]], [[0, 1]]):
            with self.subTest(modes=modes):
                case = {"id": "conduction/slab-dirichlet", "parameters": {"modes": modes}}
                self.refuse_study(small_study(cases=[case]), "cases[0]", "mode")

    def test_other_values_of_a_study_are_checked(self):
        jitter = {"id": "jittered", "amplitude": 0.1, "seed": 1}
        for change, key in (
            ({"name": 3}, "name: found 3"),
            ({"cases": []}, "cases: found an empty list"),
            ({"cases": [[]]}, "cases[0]"),
            ({"formulations": {}}, "formulations"),
            ({"formulations": ["conduction/brookshaw", "conduction/brookshaw"]}, "formulations[1]"),
            ({"formulations": [{"id": "conduction/brookshaw", "walls": True}]}, "formulations[0].walls: found true"),
            ({"formulations": [{"id": "conduction/brookshaw", "work": "work/sqrt-p"}]}, "formulations[0].work"),
            ({"formulations": [{"id": "momentum/sqrt-p", "work": "work/sqrt"}]}, "formulations[0].work"),
            ({"discretisation": []}, "discretisation: found an empty list"),
            ({"discretisation": {"density": []}}, "discretisation.density"),
            ({"discretisation": {"density": ["given", "given"]}}, "discretisation.density[1]"),
            ({"discretisation": {"smoothing_ratio": -1.2}}, "discretisation.smoothing_ratio: found -1.2"),
            ({"discretisation": {"smoothing_ratio": 0}}, "discretisation.smoothing_ratio: found 0"),
            ({"discretisation": {"layout": "jittered"}}, "discretisation.layout"),
            ({"discretisation": {"layout": jitter | {"amplitude": 0.7}}}, "layout.amplitude: found 0.7"),
            ({"discretisation": {"layout": jitter | {"amplitude": -0.1}}}, "layout.amplitude: found -0.1"),
            ({"discretisation": {"layout": jitter | {"seed": -1}}}, "layout.seed: found -1"),
            ({"discretisation": {"layout": jitter | {"seed": 1.5}}}, "layout.seed: found 1.5"),
            ({"discretisation": {"layout": jitter | {"seeds": [2]}}}, "discretisation.layout"),
            ({"discretisation": {"layout": {"id": "lattice", "amplitude": 0.1}}}, "layout.amplitude"),
            ({"smoothing_exponent": 5}, "smoothing_exponent: found 5"),
            ({"smoothing_exponent": "0.5"}, "smoothing_exponent: found '0.5'"),
            ({"measure": "eror"}, "measure: found 'eror'"),
            ({"measure": []}, "measure: found an empty list"),
            ({"threads": 0}, "threads: found 0"),
            ({"repeat": 0}, "repeat: found 0"),
            ({"repeat": "often"}, "repeat: found 'often'"),
            ({"repeat": {"most": 5, "least": 6}}, "repeat.least: found 6"),
            ({"repeat": {"spread": 0}}, "repeat.spread: found 0"),
            ({"repeat": {"seconds": 0}}, "repeat.seconds: found 0"),
            ({"repeat": {"maximum": 3}}, "repeat.maximum: found an unknown key"),
            ({"time_budget": 0}, "time_budget: found 0"),
            ({"closure": "interpolated", "discretisation": {"closure": "one-sided"}}, "closure"),
        ):
            with self.subTest(change=change):
                self.refuse_study(small_study(**change), key, "expected")

    def test_another_schema_is_refused(self):
        self.refuse_study(small_study(schema="sphverify-study/2"), "schema: found 'sphverify-study/2'",
                          "sphverify-study/1")  # fmt: skip
        self.refuse_study(small_study(schema=1), "schema: found 1", "sphverify-study/1")
        for document, shown in (("[]", "an empty list"), ("null", "null"), ("3", "3"), ('"study"', "'study'")):
            self.refuse_study(document, f"found {shown}", "sphverify-study/1")
        path = self.write("study.json", small_study())
        self.refuse("compare", path, words=(path, "schema", "sphverify-results/1"))
        self.refuse("evaluate", path, words=(path, "schema", "sphverify-state/1"))


class Files(BadInput):
    COMMANDS = ("study", "evaluate", "compare")

    def refuse_everywhere(self, content, *words):
        path = self.write("broken.json", content)
        for command in self.COMMANDS:
            with self.subTest(command=command):
                self.refuse(command, path, words=(path, *words, "expected"))

    def test_an_empty_file_is_refused(self):
        for content in ("", " \n\t\n"):
            self.refuse_everywhere(content, "found an empty file")

    def test_a_truncated_file_is_refused_wherever_it_is_cut(self):
        whole = json.dumps(small_study(), indent=1)
        for cut in (1, 2, 20, len(whole) // 2, len(whole) - 1):
            with self.subTest(cut=cut):
                path = self.write("cut.json", whole[:cut])
                self.refuse("study", path, "-o", self.old, words=(f"{path}:{1 + whole[:cut].count(chr(10))}:", "complete JSON"))

    def test_broken_json_is_refused_with_the_line(self):
        whole = json.dumps(small_study(), indent=1)
        path = self.write("broken.json", whole.replace('"formulations":', '"formulations"'))
        line = 1 + whole[: whole.index('"formulations"')].count("\n")
        message = self.run_program("study", path).stderr
        self.assertTrue(f"{path}:{line}:" in message or f"{path}:{line + 1}:" in message, message)
        self.refuse_everywhere(whole + "}", f"broken.json:{1 + whole.count(chr(10))}:2: ")
        self.refuse_everywhere(whole.replace('"name"', "'name'"), "broken.json:3:2: ")
        self.refuse_everywhere("study", "broken.json:1:1: ")

    def test_nan_and_infinity_literals_are_refused(self):
        for literal in ("NaN", "Infinity", "-Infinity", "nan"):
            text = json.dumps(small_study()).replace("0.01", literal)
            self.refuse_everywhere(text, f"broken.json:1:{1 + text.index(literal)}: ")

    def test_a_number_beyond_double_precision_is_refused_with_its_place(self):
        for number in ("1e999", "-1e999"):
            text = json.dumps(small_study(), indent=1).replace("0.01", number)
            path = self.write("huge.json", text)
            result = self.run_program("study", path)
            self.assert_user_error(result, path, "expected")
            self.assertIn(f"{path}:8:", result.stderr)

    def test_binary_garbage_is_refused(self):
        noise = random.Random(1).randbytes(100_000)
        zeros = bytes(1000)
        bad_utf8 = b'{"schema": "sphverify-study/1", "name": "\xff\xfe"}'
        for content in (noise, zeros, b"\xff\xfe{\x00}\x00", b"\x7fELF" + noise, bad_utf8, b"\x1f\x8b" + noise):
            self.refuse_everywhere(content)

    def test_deep_nesting_is_refused_without_a_crash(self):
        deep = 100_000
        self.refuse_everywhere("[" * deep)
        self.refuse_everywhere("[" * deep + "]" * deep)
        self.refuse_everywhere('{"a":' * deep + "1" + "}" * deep)
        self.refuse_everywhere('{"schema": "sphverify-study/1", "name": ' + "[" * deep + "]" * deep + "}")

    def test_what_is_not_json_is_said_in_words_with_line_and_column(self):
        for text, said in (
            ('{"a": 1,}', "1:8: found a trailing comma, expected another entry after it, or none before '}'"),
            ('{"a": [1,\n2,]}', "2:2: found a trailing comma"),
            ('{"a": 1\n "b": 2}', "1:8: found a missing comma before a text"),
            ("[1 2]", "1:3: found a missing comma before '2'"),
            ('{"a": "b\n}', "1:7: found a text that is not closed on its line"),
            ('{"a": "b', "1:9: found the end of the file, expected a complete JSON document: the text "
                         "that opens at line 1, column 7 is not closed"),
            ('{"a": [1,\n{"b": 2', "the object that opens at line 2, column 1 is not closed"),
            ("{'a': 1}", "1:2: found a single quote, expected double quotes"),
            ('{“a”: 1}', "1:2: found a typographic quote, expected double quotes"),
            ('{"a": 1} // why', "1:10: found a comment"),
            ('# why\n{"a": 1}', "1:1: found a comment"),
            ('{"a" 1}', "1:6: found '1', expected a colon after the key 'a'"),
            ('{"a": }', "1:7: found '}', expected a value of the key 'a'"),
            ("{a: 1}", "1:2: found 'a' without quotes, expected a key in double quotes"),
            ('{"ä": NaN}', "1:7: found 'NaN', expected a finite number"),
            ('{"a": True}', "1:7: found 'True', expected true"),
            ('{"a": .5}', "1:7: found '.5', expected a number as JSON writes it"),
            ('{"a": 1e999}', "1:7: found '1e999', expected a number within the range of double"),
            ('{"a": 1}}', "1:9: found '}' after the end of the document"),
            ('{"a": [1}', "1:9: found '}', expected ']', which closes the list that opens at line 1"),
            ('{"a": 1, "a": 2}', "1:10: found the key 'a' twice"),
            ('{"a": 1, "\\u0061": 2}', "1:10: found the key 'a' twice"),
            ('{"a": "\\q"}', "1:8: found the escape \\q, expected one of"),
            ('{"a": "\t"}', "1:8: found the control character \\t in a text"),
            (b'{"a": "\xff"}', "1:8: found the byte 0xff, which is not UTF-8, expected text in UTF-8"),
            (b"\xff\xfe{\x00", "1:1: found text in UTF-16, expected text in UTF-8"),
            ("[" * 100, "1:65: found lists or objects nested too deeply, expected at most 64 levels"),
        ):  # fmt: skip
            with self.subTest(text=text):
                path = self.write("broken.json", text)
                self.refuse("study", path, "-o", self.old, words=(f"sphverify: {path}:", said))

    def test_a_byte_order_mark_is_taken(self):
        path = self.write("marked.json", b"\xef\xbb\xbf" + json.dumps(small_study()).encode())
        self.succeed("study", path)

    def test_an_unknown_key_is_named_before_a_missing_one(self):
        for document, keys in (
            (without(small_study(), ["schema"]) | {"shcema": "sphverify-study/1"}, ("study", "shcema")),
            (without(small_study(), ["name"]) | {"nmae": "small"}, ("study", "nmae")),
            (without(small_study(), ["name"]) | {"discretisation": {"desnity": "given"}},
             ("study", "discretisation.desnity")),
            ({"schema": "sphverify-state/1", "dimensoin": 1}, ("evaluate", "dimensoin")),
            ({"schema": "sphverify-state/1", "dimension": 1, "particles": {"positoin": [0.1]}},
             ("evaluate", "particles.positoin")),
        ):  # fmt: skip
            with self.subTest(document=document):
                path = self.write("bad.json", document)
                self.refuse(keys[0], path, words=(f"{path}: {keys[1]}: found an unknown key",))

    def test_nothing_that_the_input_holds_reaches_the_terminal_raw(self):
        escape = "\x1b[31m\x07\n\x9b"
        path = self.write("bad.json", small_study(cases=[escape]))
        self.refuse("study", path, words=("cases[0]: found '\\u001b[31m\\u0007\\n\\u009b'",))
        path = self.write("bad.json", small_study() | {escape: 1})
        self.refuse("study", path, words=("\\u001b[31m\\u0007\\n\\u009b: found an unknown key",))
        path = self.write("bad.json", small_study(formulations=[{"id": "conduction/brookshaw", "walls": escape}]))
        self.refuse("study", path, words=("\\u001b",))
        for arguments in (("describe", escape), (escape,), ("study", f"no{escape}file"), ("list", escape),
                          ("exact", "hydro/noh", "--time", "0", "--points", escape),
                          ("exact", "hydro/noh", "--time", "0", "--points", "0", "--parameter", escape)):  # fmt: skip
            with self.subTest(arguments=arguments):
                self.refuse(*arguments, words=("\\u001b",))
                self.assertNotRegex(self.run_program(*arguments).stderr.rstrip("\n"), "[\x00-\x1f\x7f-\x9f]")

    def test_names_in_results_reach_a_table_in_a_printable_form(self):
        results = self.study(small_study(), "good.json")
        results["series"][0]["label"] = "conduction/\x1b[31mred"
        text = self.succeed("compare", self.write("red.json", results))
        self.assertNotIn("\x1b[31m", text)

    def test_a_key_given_twice_is_refused(self):
        text = json.dumps(small_study())
        path = self.write("twice.json", text.replace('"resolution"', '"resolution": 10, "resolution"'))
        self.refuse("study", path, "-o", self.old, words=(path, "resolution"))

    def test_a_missing_file_is_refused(self):
        for command in self.COMMANDS:
            missing = self.folder / "missing.json"
            self.refuse(command, missing, words=(missing, "expected"))

    def test_a_directory_in_place_of_a_file_is_refused(self):
        directory = self.folder / "directory"
        directory.mkdir()
        for command in self.COMMANDS:
            with self.subTest(command=command):
                self.refuse(command, directory, words=(directory, "expected"))

    def test_nothing_on_standard_input_is_refused(self):
        for command in ("study", "evaluate"):
            self.refuse(command, "-", text="", words=("empty",))

    def test_results_cut_down_by_hand_are_refused_with_the_key(self):
        results = self.study(small_study(), "good.json")
        for path, key in (
            (("runs",), "runs"),
            (("context",), "context"),
            (("runs", 1, "status"), "runs[1].status"),
            (("runs", 1, "errors", "temperature", "all", "l2"), "runs[1].errors.temperature.all.l2"),
            (("series", 0, "orders", 0, "verdict"), "series[0].orders[0].verdict"),
        ):
            with self.subTest(key=key):
                file = self.write("cut.json", without(results, path))
                self.refuse("compare", file, words=(file, f"{key}: found nothing"))
        results["series"][0]["runs"] = [99]
        file = self.write("cut.json", results)
        self.refuse("compare", file, words=(file, "series[0].runs"))


    def test_a_status_that_no_run_can_have_is_refused(self):
        results = self.study(small_study(), "good.json")
        results["runs"][1]["status"] = "fine"
        file = self.write("odd.json", results)
        for command in (("compare", file), ("report", file), ("repeat", file, 0)):
            self.refuse(*command, words=(f"{file}: runs[1].status: found 'fine', expected one of ok, unstable",))


class Places(BadInput):
    """Root may write anywhere that exists, so these are places that nobody can write."""

    def test_results_that_cannot_be_written_are_refused_before_anything_runs(self):
        directory = self.folder / "directory"
        directory.mkdir()
        study = self.write("study.json", small_study(resolution=[2000, 4000]))
        for place in (self.folder / "no" / "such" / "place.json", directory, self.old / "below-a-file.json",
                      "/proc/sphverify-results.json", self.folder / ("x" * 300)):  # fmt: skip
            with self.subTest(place=place):
                self.refuse("study", study, "-o", place, words=(place, "cannot be written"))

    def test_rates_that_cannot_be_written_are_refused(self):
        state = reference_state()
        path = self.write("state.json", state)
        for place in (self.folder / "no" / "rates.json", self.folder, self.old / "rates.json"):
            with self.subTest(place=place):
                self.refuse("evaluate", path, "-o", place, words=(place, "cannot be written"))

    def test_an_empty_name_for_the_results_is_refused(self):
        study = self.write("study.json", small_study())
        self.refuse("study", study, "-o", "", words=("expected",))

    def test_a_full_device_is_the_machine_s_failure_in_one_line(self):
        for arguments in (("list",), ("describe", "conduction/brookshaw"), ("list", "--json")):
            with self.subTest(command=arguments), open("/dev/full", "w") as full:
                process = self.start(*arguments, stdout=full)
                message = process.communicate(timeout=10)[1].decode()
                self.assertEqual(process.returncode, PROGRAM_ERROR, message)
                self.assertEqual(message.count("\n"), 1, message)


def reference_state():
    path = SOURCE_DIR / "tests" / "data" / "operators-1d.json"
    return copy.deepcopy(strict_json(path.read_text())[0]["state"])


class States(BadInput):
    def setUp(self):
        super().setUp()
        self.state = reference_state()
        self.particles = self.state["particles"]
        self.walls = self.state["walls"]

    def refuse_this(self, *words):
        self.refuse_state(self.state, *words)
        self.state = reference_state()
        self.particles = self.state["particles"]
        self.walls = self.state["walls"]

    def test_two_particles_at_the_same_place_are_refused_by_number(self):
        self.particles["position"][7] = self.particles["position"][3]
        self.refuse_this("particles.position", "3", "7", "same place")

    def test_two_particles_at_the_same_place_across_a_period_are_refused(self):
        self.state["walls"] = []
        self.state["periodic"] = [[0, 1]]
        self.particles["position"][0] = [0.0]
        self.particles["position"][11] = [1.0]
        self.refuse_this("particles.position", "0", "11", "same place")

    def test_a_particle_on_or_outside_its_wall_is_refused_by_number(self):
        for particle, x in ((0, -0.1), (0, 0.0), (11, 1.0), (11, 1.5)):
            with self.subTest(x=x):
                self.particles["position"][particle] = [x]
                self.refuse_this("particles.position", f"particle {particle} ", "wall")

    def test_a_particle_outside_its_period_is_refused_by_number(self):
        self.state["walls"] = []
        self.state["periodic"] = [[0, 1]]
        for x in (-0.01, 1.01, 1.5, 7.3):
            with self.subTest(x=x):
                self.state["walls"] = []
                self.state["periodic"] = [[0, 1]]
                self.particles["position"][5] = [x]
                self.refuse_this("particles.position[5]", f"found [{x}]", "axis 0, 0 to 1")

    def test_a_particle_at_the_end_of_its_period_or_by_rounding_beyond_is_taken(self):
        for x in (0.0, 1.0, 1.0 + 1e-12):
            with self.subTest(x=x):
                self.state["walls"] = []
                self.state["periodic"] = [[0, 1]]
                self.particles["position"][11] = [x]
                self.succeed("evaluate", self.write("edge.json", self.state))

    def test_a_support_in_which_particles_meet_twice_is_refused(self):
        self.state["walls"] = []
        self.state["periodic"] = [[0, 1]]
        self.particles["smoothing_length"] = 0.26
        self.refuse_this("particles.smoothing_length: found 0.26", "at most 0.25", "axis 0")

    def test_a_wall_across_a_periodic_axis_is_refused(self):
        self.state["periodic"] = [[0, 1]]
        self.refuse_this("walls[0].outward_normal", "axis 0", "periodic")

    def test_two_walls_on_one_side_are_refused(self):
        self.walls.append(dict(self.walls[0], point=[-0.5]))
        self.refuse_this("walls[2].outward_normal: found [-1.0]", "another side than that of walls[0]")

    def test_no_particles_are_refused(self):
        for key, value in self.particles.items():
            if isinstance(value, list):
                self.particles[key] = []
        self.refuse_this("particles.position: found an empty list", "at least one")

    def test_lengths_that_differ_are_refused(self):
        for key in ("mass", "density", "pressure", "velocity", "temperature", "conductivity"):
            with self.subTest(key=key):
                self.particles[key].pop()
                self.refuse_this(f"particles.{key}: found a list of 11", "12")
                self.particles[key].append(self.particles[key][0])
                self.refuse_this(f"particles.{key}: found a list of 13", "12")
        self.particles["position"].pop()
        self.refuse_this("found a list of 12", "11")

    def test_values_that_are_no_finite_numbers_are_refused_by_place(self):
        for value, shown in ((None, "null"), ("1", "'1'"), (True, "true"), ([1], "a list")):
            with self.subTest(value=value):
                self.particles["pressure"][4] = value
                self.refuse_this("particles.pressure[4]", f"found {shown}", "number")
        self.particles["pressure"][4] = float("nan")
        self.refuse_this("state.json:1:", "expected a finite number")
        self.particles["position"][4] = [float("inf")]
        self.refuse_this("state.json:1:", "expected a finite number")

    def test_masses_densities_and_smoothing_lengths_that_are_not_positive_are_refused(self):
        for key in ("mass", "density"):
            for value in (0, -1):
                self.particles[key][2] = value
                self.refuse_this(f"particles.{key}[2]: found {value}", "positive")
        for value in (0, -1, [1], "1", None):
            self.particles["smoothing_length"] = value
            expected = "one per position" if isinstance(value, list) else "a number from 1e-100 to 1e+100"
            self.refuse_this("particles.smoothing_length", expected)

    def test_vectors_of_another_dimension_are_refused(self):
        self.particles["position"][2] = [0.5, 0.5]
        self.refuse_this("particles.position[2]", "1 number")
        self.particles["velocity"][2] = 0.5
        self.refuse_this("particles.velocity[2]", "list")
        self.state["dimension"] = 2
        self.refuse_this("particles.position[0]", "2 numbers")
        for value in (0, 4, 1.5, "1", None):
            self.state["dimension"] = value
            self.refuse_this("dimension", "1 to 3")

    def test_missing_and_unknown_keys_are_refused(self):
        for key in ("schema", "dimension", "particles"):
            del self.state[key]
            self.refuse_this(key)
        for key in ("position", "mass", "density", "smoothing_length"):
            del self.particles[key]
            self.refuse_this(f"particles.{key}: found nothing")
        self.particles["presure"] = self.particles["pressure"]
        self.refuse_this("particles.presure", "unknown key", "'pressure'?")
        self.state["wals"] = []
        self.refuse_this("wals", "unknown key", "'walls'?")

    def test_unknown_words_are_refused_with_the_nearest(self):
        for key, value, near in (("kernel", "cubic-splin", "cubic-spline"), ("face_weight", "exat", "exact"),
                                 ("closure", "interpolate", "interpolated")):  # fmt: skip
            self.state[key] = value
            self.refuse_this(f"{key}: found '{value}'", f"'{near}'?")
        self.particles["density"] = "sumation"
        self.refuse_this("particles.density: found 'sumation'", "'summation'?")

    def test_a_wall_that_makes_no_sense_is_refused(self):
        for key, value, word in (
            ("outward_normal", [2.0], "unit length"),
            ("outward_normal", [0.0], "unit length"),
            ("outward_normal", [1.0, 0.0], "1 number"),
            ("outward_normal", 1, "list"),
            ("point", [], "1 number"),
            ("pressure", "high", "number"),
            ("flux", 1, "list"),
            ("temprature", 1, "unknown key"),
        ):
            with self.subTest(key=key, value=value):
                self.walls[0][key] = value
                self.refuse_this(f"walls[0].{key}", word)
        for key in ("point", "outward_normal", "conductivity"):
            del self.walls[1][key]
            self.refuse_this(f"walls[1].{key}: found nothing")
        self.state["walls"] = {}
        self.refuse_this("walls: found an object")

    def test_a_period_that_makes_no_sense_is_refused(self):
        for value, key in (([[1, 0]], "periodic[0]"), ([[0]], "periodic[0]"), ([], "periodic"), ([[0, 0.1]], "period")):
            with self.subTest(value=value):
                self.state["walls"] = []
                self.state["periodic"] = value
                self.refuse_this(key)


class CommandLine(BadInput):
    def test_no_command_is_refused(self):
        self.refuse(words=("--help",))

    def test_an_unknown_command_is_refused_by_name(self):
        self.refuse("frobnicate", words=("frobnicate",))
        self.refuse("studdy", "study.json", words=("studdy", "study"))

    def test_missing_arguments_are_refused_by_name(self):
        for arguments, word in (
            (("study",), "STUDY.json"),
            (("evaluate",), "STATE.json"),
            (("compare",), "RESULTS.json"),
            (("describe",), "ID"),
            (("exact",), "CASE"),
            (("exact", "conduction/marshak", "--points", "0"), "--time"),
            (("exact", "conduction/marshak", "--time", "1"), "--points"),
        ):
            with self.subTest(arguments=arguments):
                self.refuse(*arguments, words=(word,))

    def test_bad_option_values_are_refused_by_name(self):
        study = self.write("study.json", small_study())
        for arguments, word in (
            (("study", study, "--jobs", "0"), "--jobs"),
            (("study", study, "--jobs", "-1"), "--jobs"),
            (("study", study, "--jobs", "many"), "--jobs"),
            (("study", study, "--jobs", "1.5"), "--jobs"),
            (("study", study, "--jobs"), "--jobs"),
            (("study", study, "--output"), "--output"),
            (("study", study, "--job", "2"), "--job"),
            (("study", study, "another"), "another"),
            (("study", study, "--resume"), "--resume"),
            (("list", "kernls"), "kernls"),
            (("list", "--xml"), "--xml"),
            (("compare", study, "--format", "xml"), "--format"),
            (("compare", study, "--region", "edge"), "--region"),
            (("compare", study, "--norm", "l3"), "--norm"),
        ):
            with self.subTest(arguments=arguments):
                self.refuse(*arguments, words=(word,))

    def test_a_word_that_is_nearly_one_of_an_option_is_answered_by_it(self):
        for arguments, meant in (
            (("compare", "r.json", "--section", "sumary"), "summary"),
            (("compare", "r.json", "--format", "jason"), "json"),
            (("compare", "r.json", "--region", "wal"), "wall"),
            (("order", "t.csv", "--format", "tabel"), "table"),
            (("list", "kernls"), "kernels"),
        ):
            with self.subTest(arguments=arguments):
                self.refuse(*arguments, words=(f"found '{arguments[-1]}'", f"did you mean '{meant}'?"))

    def test_an_unknown_identifier_to_describe_is_refused_with_the_nearest(self):
        self.refuse("describe", "brookshaw", words=("'brookshaw'", "did you mean 'conduction/brookshaw'?"))
        self.refuse("describe", "conduction/marshack", words=("did you mean 'conduction/marshak'?",))
        self.refuse("describe", "", words=("expected",))

    def test_what_to_expect_of_an_identifier_is_short_and_names_the_list_of_them_all(self):
        study = self.write("study.json", small_study(cases=["conduction/marshack"], formulations=["wholly-other"]))
        forms = self.write("forms.json", small_study(formulations=["wholly-other"]))
        for arguments, listing in (
            (("describe", "wholly-other"), "`sphverify list`"),
            (("exact", "conduction/slab", "--time", "1", "--points", "0"), "`sphverify list cases`"),
            (("study", study), "`sphverify list cases`"),
            (("study", forms), "`sphverify list formulations`"),
        ):
            with self.subTest(arguments=arguments):
                self.refuse(*arguments, words=(listing,))
                self.assertLess(len(self.run_program(*arguments).stderr), 250)

    def test_one_bad_document_among_several_is_refused_by_name(self):
        self.study(small_study(), "good.json")
        bad = self.write("bad.json", "{}")
        self.refuse("compare", "good.json", bad, words=(bad, "schema"))


class StatusOnly(ProgramTest):
    def test_a_wrong_study_on_standard_input_names_standard_input(self):
        result = self.run_program("study", "-", text=json.dumps(small_study(resolution=-1)))
        self.assertEqual(result.returncode, USER_ERROR)
        self.assertIn("resolution: found -1", result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
