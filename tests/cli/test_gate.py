# SPDX-License-Identifier: GPL-3.0-or-later
"""`sphverify gate`: verdicts and exit status, JUnit, Markdown, annotations, baselines, bad input."""

import sys

sys.dont_write_bytecode = True

import json
import os
import pty
import subprocess
import unittest
import unittest.mock
import xml.etree.ElementTree as ElementTree

from program import (
    DONE,
    GATE_FAILED,
    PROGRAM,
    SOURCE_DIR,
    USER_ERROR,
    ProgramTest,
    mutated,
    small_study,
    strict_json,
    without,
)

WIDEST = 100
SLAB = {"case": "conduction/slab-dirichlet", "formulation": "conduction/brookshaw"}
STUDY = small_study(
    formulations=["conduction/brookshaw", "conduction/lucy-flux", {"id": "conduction/brookshaw", "walls": "off"}],
    resolution=[8, 12, 16, 24],
    measure=["error", "conservation", "cost", "stability"],
)

# One gate of every measure that the study above keeps by a wide margin.
HOLDING = {
    "error": {"field": "temperature", "maximum": 1.0},
    "order": {"field": "temperature", "minimum": -50, "verdict": "ignore"},
    "skill": {"field": "temperature", "maximum": 1.0},
    "time_error": {"maximum": 0.5},
    "conservation": {"quantity": "energy", "maximum": 1.0},
    "wall_flux": {"maximum": 10.0},
    "status": {"equals": "ok"},
    "stability": {"quantity": "spectral_abscissa", "maximum": 1e-3},
    "time_to_error": {"target": 0.1, "maximum": 1e9, "relative_to": "conduction/lucy-flux", "interval": "ignore"},
    "cost": {"quantity": "rate_evaluations", "maximum": 100, "relative_to": "conduction/lucy-flux"},
}


def gate(measure="error", **keys):
    return {"name": f"a gate of {measure}", "select": SLAB, "measure": measure, **keys}


class Gate(ProgramTest):
    @classmethod
    def setUpClass(cls):
        helper = cls()
        helper.setUp()
        try:
            document = helper.study(STUDY)
            for run in document["runs"]:
                for regions in run["errors"].values():
                    for error in regions.values():
                        error["initial"] = error.get("initial") or {"l1": 0.3, "l2": 0.4, "linf": 0.5}
            for series in document["series"]:  # what a gate makes of an order, not what an order is, is tested here
                for order in series["orders"]:
                    order.update(order=1.5, interval=[1.4, 1.6], verdict="asymptotic", reason="by hand")
            cls.document = json.dumps(document)
        finally:
            helper.doCleanups()

    def runTest(self):
        """Lets `setUpClass` make an instance."""

    def setUp(self):
        super().setUp()
        clean = {key: value for key, value in os.environ.items() if not key.startswith("GITHUB_")}
        patch = unittest.mock.patch.dict(os.environ, clean, clear=True)
        patch.start()
        self.addCleanup(patch.stop)
        text = getattr(self, "document", None)
        self.results = text and self.write("results.json", text)

    def judge(self, *gates, options=(), results=None, **keys):
        """The finished program on a document of these gates."""
        document = {"schema": "sphverify-gates/1", "gates": list(gates), **keys}
        path = self.write("gates.json", document)
        return self.run_program("gate", results or self.results, path, *options)

    def verdict(self, one, **options):
        """First line and exit status of a single gate."""
        result = self.judge(one, **options)
        self.assertEqual(result.stderr, "")
        return result.stdout.splitlines()[0], result.returncode


class Verdicts(Gate):
    def test_every_measure_passes_and_fails(self):
        for measure, keys in HOLDING.items():
            with self.subTest(measure=measure):
                line, status = self.verdict(gate(measure, **keys))
                self.assertTrue(line.startswith(f"passed  a gate of {measure}"), line)
                self.assertEqual(status, DONE)
                impossible = dict(keys)
                if measure == "status":
                    impossible["equals"] = "unstable"
                else:
                    impossible.pop("minimum", None)
                    impossible.update(maximum=-60, interval="ignore")
                    if measure not in ("order", "time_to_error"):
                        del impossible["interval"]
                    if measure in ("error", "wall_flux", "skill"):
                        impossible.pop("maximum")
                        impossible["minimum"] = 1e3
                line, status = self.verdict(gate(measure, **impossible))
                self.assertTrue(line.startswith(f"failed  a gate of {measure}"), line)
                self.assertEqual(status, GATE_FAILED)

    def test_the_numbers_are_those_of_the_results(self):
        document = strict_json(self.document)
        series = document["series"][0]
        finest = document["runs"][series["runs"][-1]]
        error = finest["errors"]["temperature"]["wall"]["linf"]
        line, _ = self.verdict(gate(field="temperature", region="wall", norm="linf", maximum=1))
        self.assertIn(f"linf error {error:.3g} K", line)
        order = next(o for o in series["orders"] if (o["field"], o["region"], o["norm"]) == ("temperature", "all", "l2"))
        line, _ = self.verdict(gate("order", minimum=-50, verdict="ignore"))
        self.assertIn(f"order {order['order']:.3g} [{order['interval'][0]:.3g}, {order['interval'][1]:.3g}]", line)

    def test_a_ratio_of_run_times_fails_only_beyond_its_interval(self):
        document = strict_json(self.document)
        for run in document["runs"]:
            slow = 2 if run["formulation"] == "conduction/brookshaw" else 1
            run["cost"].update(seconds=0.9 * slow, low_seconds=0.9 * slow, median_seconds=slow, high_seconds=1.1 * slow)
        results = self.write("timed.json", document)
        self.assert_valid("sphverify-results-1", document)
        for maximum, verdict, status in ((3, "passed", DONE), (1.8, "within-noise", DONE), (1.5, "failed", GATE_FAILED)):
            one = gate("cost", quantity="seconds", maximum=maximum, relative_to="conduction/lucy-flux")
            self.assert_valid("sphverify-gates-1", {"schema": "sphverify-gates/1", "gates": [one]})
            line, found = self.verdict(one, results=results)
            self.assertTrue(line.startswith(f"{verdict}  a gate of cost  seconds ratio 2 [1.64, 2.44]"), line)
            self.assertEqual(found, status)
            line, _ = self.verdict(one | {"interval": "ignore"}, results=results)
            self.assertTrue(line.startswith("passed" if maximum == 3 else "failed"), line)

    def test_an_interval_that_holds_the_limit_is_undecided_and_fails(self):
        document = strict_json(self.document)
        lower, upper = document["series"][0]["orders"][1]["interval"]
        inside = gate("order", field="temperature", region="all", norm=document["series"][0]["orders"][1]["norm"],
                      minimum=0.5 * (lower + upper), verdict="ignore")  # fmt: skip
        line, status = self.verdict(inside)
        self.assertTrue(line.startswith("undecided  "), line)
        self.assertEqual(status, GATE_FAILED)
        line, status = self.verdict({**inside, "minimum": 0.6 * lower + 0.4 * upper, "interval": "ignore"})
        self.assertTrue(line.startswith("passed  "), line)
        self.assertEqual(status, DONE)

    def test_expected_failures_pass_and_unexpected_passes_fail(self):
        known = {"expect": "fail", "reason": "as we all know"}
        result = self.judge(gate(minimum=1e3, **known))
        self.assertTrue(result.stdout.startswith("expected-failure  "))
        self.assertIn("expected to fail: as we all know", result.stdout)
        self.assertEqual(result.returncode, DONE)
        result = self.judge(gate(maximum=1, **known))
        self.assertTrue(result.stdout.startswith("unexpected-pass  "))
        self.assertIn("remove \"expect\": \"fail\"", result.stdout)
        self.assertEqual(result.returncode, GATE_FAILED)

    def orders(self, **keys):
        """Results in which every order of the first ladder has these keys."""
        document = strict_json(self.document)
        for order in document["series"][0]["orders"]:
            order.update(keys)
        return self.write("orders.json", document)

    def test_the_order_of_a_floored_or_diverging_ladder_keeps_no_limit(self):
        for verdict in ("floored", "diverging", "asymptotic"):
            results = self.orders(verdict=verdict, order=1.0, interval=[0.9, 1.1], reason="made by hand")
            for limit in ({"minimum": 0.5}, {"maximum": 1.5}):
                line, status = self.verdict(gate("order", **limit), results=results)
                self.assertEqual(status, DONE if verdict == "asymptotic" else GATE_FAILED, (verdict, line))
                line, status = self.verdict(gate("order", verdict="ignore", **limit), results=results)
                self.assertEqual(status, DONE, (verdict, line))
            line, status = self.verdict(gate("order", equals=verdict), results=results)
            self.assertEqual(status, DONE, line)
        floored = self.judge(gate("order", minimum=0.5), results=self.orders(verdict="floored", order=1.0, reason="why"))
        self.assertIn("the ladder is floored: why", floored.stdout)

    def test_an_expected_failure_swallows_no_crash_null_or_undecided_order(self):
        known = {"expect": "fail", "reason": "as we all know"}
        document = strict_json(self.document)
        last = document["series"][0]["runs"][-1]
        for status in ("unstable", "timed-out"):
            broken = self.write("broken.json", mutated(document, ("runs", last, "status"), status))
            result = self.judge(gate(minimum=1e3, **known), results=broken)
            self.assertTrue(result.stdout.startswith("failed  "), result.stdout)
            self.assertIn("not the failure that is expected", result.stdout)
            self.assertEqual(result.returncode, GATE_FAILED)
            line, found = self.verdict(gate("status", equals="ok", **known), results=broken)
            self.assertEqual(found, DONE if status == "unstable" else GATE_FAILED, line)
        null = self.write("null.json", mutated(document, ("runs", last, "errors", "temperature", "all", "l2"), None))
        self.assertEqual(self.verdict(gate(minimum=1e3, **known), results=null)[1], GATE_FAILED)
        order = {"verdict": "pre-asymptotic", "order": 0.9, "reason": "x"}
        for interval, word, status in (([0.5, 1.5], "undecided", GATE_FAILED), ([0.8, 0.95], "expected-failure", DONE)):
            results = self.orders(**order, interval=interval)
            line, found = self.verdict(gate("order", minimum=1, **known), results=results)
            self.assertTrue(line.startswith(word), line)
            self.assertEqual(found, status)
        results = self.orders(verdict="floored", order=None, interval=None, reason="x")
        self.assertEqual(self.verdict(gate("order", minimum=1, **known), results=results)[1], GATE_FAILED)

    def test_every_entry_of_a_list_must_match_and_how_many_are_looked_at_may_be_said(self):
        both = {**SLAB, "formulation": ["conduction/brookshaw", "conduction/lucy-flux"]}
        self.assertEqual(self.verdict({**gate(maximum=1), "select": both})[1], DONE)
        missing = {**SLAB, "formulation": ["conduction/brookshaw", "conduction/lucyflux"]}
        result = self.judge({**gate(maximum=1), "select": missing})
        self.assertTrue(result.stdout.startswith("selects-nothing  "), result.stdout)
        self.assertIn("'conduction/lucyflux' in the list of 'formulation' matches nothing", result.stdout)
        self.assertIn("did you mean 'conduction/lucy-flux'?", " ".join(result.stdout.split()))
        self.assertEqual(result.returncode, GATE_FAILED)
        self.assertEqual(self.verdict({**gate(maximum=1, at_least=1), "select": missing})[1], DONE)
        for rule, status in (({"runs": 2}, DONE), ({"runs": 1}, GATE_FAILED), ({"runs": 3}, GATE_FAILED),
                             ({"at_least": 2}, DONE), ({"at_least": 3}, GATE_FAILED)):  # fmt: skip
            line, found = self.verdict({**gate(maximum=1, **rule), "select": both})
            self.assertEqual(found, status, line)
        line, _ = self.verdict({**gate(maximum=1, runs=3), "select": both})
        self.assertIn("2 runs  = 3", line)

    def test_misspelt_names_are_answered_with_the_nearest_that_there_is(self):
        for select, meant in (({"case": "conduction/slab-dirchlet"}, "conduction/slab-dirichlet"),
                              ({"formulation": "brookshaw"}, "conduction/brookshaw"),
                              ({"discretisation": {"layout": "latice"}}, "lattice"),
                              ({"discretisation": {"density": "gven"}}, "given"),
                              ({"parameters": {"final_tme": 1}}, "final_time")):  # fmt: skip
            result = self.judge({**gate(maximum=1), "select": select})
            self.assertTrue(result.stdout.startswith("selects-nothing  "), result.stdout)
            self.assertIn(f"(did you mean '{meant}'?)", " ".join(result.stdout.split()))

    def test_a_gate_that_selects_nothing_fails_and_says_why(self):
        for known in ({}, {"expect": "fail", "reason": "x"}):
            result = self.judge({**gate(maximum=1, **known), "select": {"case": "hydro/noh"}})
            self.assertTrue(result.stdout.startswith("selects-nothing  "))
            self.assertIn("no run matches 'case'; the runs have conduction/slab-dirichlet", result.stdout)
            self.assertEqual(result.returncode, GATE_FAILED)

    def test_runs_without_walls_are_only_taken_if_named(self):
        with_walls = self.judge({**gate(minimum=1e3), "select": {"formulation": "conduction/brookshaw"}}).stdout
        self.assertNotIn("walls off", with_walls)
        without_walls = self.judge({**gate(minimum=1e3), "select": {"walls": "off"}}).stdout
        self.assertIn("(walls off)", without_walls)

    def test_a_run_that_is_not_ok_and_a_null_fail_every_accuracy_gate(self):
        document = strict_json(self.document)
        last = document["series"][0]["runs"][-1]
        broken = mutated(document, ("runs", last, "status"), "non-finite")
        broken = self.write("broken.json", mutated(broken, ("runs", last, "reason"), "a NaN appeared"))
        for measure in ("error", "order", "conservation", "wall_flux", "time_to_error", "cost"):
            result = self.judge(gate(measure, **HOLDING[measure]), results=broken)
            self.assertTrue(result.stdout.startswith("failed  "), measure)
            self.assertIn("non-finite: a NaN appeared", result.stdout, measure)
        null = self.write("null.json", mutated(document, ("runs", last, "errors", "temperature", "all", "l2"), None))
        result = self.judge(gate(maximum=1), results=null)
        self.assertTrue(result.stdout.startswith("failed  "))
        self.assertIn("the error is null", result.stdout)

    def test_one_line_per_gate_in_100_columns_and_a_summary_at_the_end(self):
        gates = [gate(measure, **keys) for measure, keys in HOLDING.items()]
        gates.append({**gate(minimum=1e3), "name": "a long name " * 12})
        lines = self.judge(*gates).stdout.splitlines()
        for one, line in zip(gates, lines):
            self.assertIn(one["name"][:12], line)
        self.assertEqual(lines[len(gates)], "")
        self.assertEqual(lines[-1], "11 gates: 10 passed, 1 failed")
        for line in lines:
            if not line.startswith("a long name"):
                self.assertLessEqual(len(line), WIDEST, line)

    def test_documents_may_come_from_standard_input(self):
        path = self.write("gates.json", {"schema": "sphverify-gates/1", "gates": [gate(maximum=1)]})
        self.assertIn("1 passed", self.succeed("gate", "-", path, text=self.document))
        self.assertIn("1 passed", self.succeed("gate", self.results, "-", text=path.read_text()))

    def test_colour_on_a_terminal_only(self):
        path = self.write("gates.json", {"schema": "sphverify-gates/1", "gates": [gate(maximum=1)]})
        self.assertNotIn("\x1b", self.succeed("gate", self.results, path))
        main, side = pty.openpty()
        subprocess.run([PROGRAM, "gate", self.results, path], stdout=side, check=True, timeout=60)
        os.close(side)
        shown = os.read(main, 65536).decode()
        os.close(main)
        self.assertIn("\x1b[32mpassed\x1b[0m", shown)


class Reports(Gate):
    GATES = [
        {**gate(maximum=1), "name": "holds"},
        {**gate(minimum=1e3), "name": "fails <&> \"quoted\" | 100%, a:b"},
        {**gate(minimum=1e3, expect="fail", reason="known, see <docs>"), "name": "known"},
        {**gate(maximum=1, expect="fail", reason="x"), "name": "mended"},
        {**gate(maximum=1), "name": "nowhere", "select": {"case": "x"}},
    ]

    def test_junit_is_xml_with_one_test_case_per_gate(self):
        result = self.judge(*self.GATES, name="A & B", options=("--junit", "out.xml"))
        self.assertEqual(result.returncode, GATE_FAILED)
        root = ElementTree.fromstring((self.folder / "out.xml").read_bytes())
        self.assertEqual(root.tag, "testsuites")
        suite = root.find("testsuite")
        self.assertEqual((suite.get("name"), suite.get("tests"), suite.get("failures"), suite.get("skipped"),
                          suite.get("errors")), ("A & B", "5", "3", "1", "0"))  # fmt: skip
        cases = suite.findall("testcase")
        self.assertEqual([case.get("name") for case in cases], [one["name"] for one in self.GATES])
        self.assertEqual({case.get("classname") for case in cases}, {"sphverify.A & B"})
        outcomes = [[child.tag for child in case] for case in cases]
        self.assertEqual(outcomes, [["system-out"], ["failure"], ["skipped", "system-out"], ["failure"], ["failure"]])
        self.assertEqual(cases[1].find("failure").get("type"), "failed")
        self.assertIn("limit >= 1000", cases[1].find("failure").get("message"))
        self.assertIn("conduction/slab-dirichlet", cases[1].find("failure").text)
        self.assertEqual(cases[2].find("skipped").get("message"), "expected failure: known, see <docs>")
        self.assertEqual(cases[4].find("failure").get("type"), "selects-nothing")

    def test_markdown_is_written_and_appended_to_the_step_summary(self):
        summary = self.write("summary.md", "before\n")
        os.environ["GITHUB_STEP_SUMMARY"] = str(summary)
        self.judge(*self.GATES, options=("--markdown", "out.md"))
        written = (self.folder / "out.md").read_text()
        self.assertEqual(summary.read_text(), "before\n" + written + "\n")
        rows = [line for line in written.splitlines() if line.startswith("|")]
        self.assertEqual(len(rows), 2 + len(self.GATES))
        self.assertIn("fails &lt;&amp;>", written)
        self.assertIn("\\|", rows[3])

    def test_github_gets_annotations_where_it_runs_the_program(self):
        self.assertNotIn("::", self.judge(*self.GATES).stdout.replace(": :", ""))
        os.environ["GITHUB_ACTIONS"] = "true"
        lines = [line for line in self.judge(*self.GATES).stdout.splitlines() if line.startswith("::")]
        self.assertEqual([line.split(" ")[0] for line in lines], ["::error", "::notice", "::error", "::error"])
        self.assertIn('title=fails <&> "quoted" | 100%25%2C a%3Ab::failed: ', lines[0])
        self.assertIn("gates.json,", lines[0])

    def test_reports_never_overwrite_the_input_and_need_a_place(self):
        for option in ("--junit", "--markdown"):
            for place, words in ((self.results, "the input itself"), ("gates.json", "the input itself"),
                                 ("no/such/folder/x", "cannot be written"), ("-", "a file")):  # fmt: skip
                result = self.judge(gate(maximum=1), options=(option, place))
                self.assert_user_error(result, words)
        self.assertEqual(self.results.read_text(), self.document)
        os.environ["GITHUB_STEP_SUMMARY"] = str(self.folder / "no" / "folder")
        self.assert_user_error(self.judge(gate(maximum=1)), "GITHUB_STEP_SUMMARY")


class Baselines(Gate):
    WITHIN = gate(field="temperature", resolution="all", within={"relative": 1e-6}, baseline="old.json")

    def store(self, factor=1.0):
        """The results as a baseline in which the error of one run is another."""
        document = strict_json(self.document)
        errors = document["runs"][0]["errors"]["temperature"]["all"]
        errors |= {norm: factor * errors[norm] for norm in ("l1", "l2", "linf")}
        return self.write("old.json", document)

    def test_unchanged_results_pass_and_changed_ones_fail_in_both_directions(self):
        for factor, word in ((1.0, "passed"), (1.0 + 1e-7, "passed"), (1.001, "failed"), (0.999, "failed")):
            self.store(factor)
            line, status = self.verdict(self.WITHIN)
            self.assertTrue(line.startswith(word), (factor, line))
            self.assertEqual(status, DONE if word == "passed" else GATE_FAILED)

    def test_a_baseline_of_zero_is_kept_to_rounding_unless_an_absolute_tolerance_is_given(self):
        document = strict_json(self.document)
        run = document["series"][0]["runs"][-1]
        energy = document["runs"][run]["conservation"]["energy"]
        terms = max(abs(energy[key]) for key in ("initial", "final", "exchanged"))
        place = ("runs", run, "conservation", "energy", "drift")
        self.write("old.json", mutated(document, place, 0.0))
        one = gate("conservation", resolution="finest", within={"relative": 1e-3}, baseline="old.json")
        for part, status in ((1e-15, DONE), (1e-13, GATE_FAILED)):
            now = self.write("now.json", mutated(document, place, part * terms))
            line, found = self.verdict(one, results=now)
            self.assertEqual(found, status, line)
            self.assertIn("0 +- 1.4e-14", line)
            self.assertEqual(self.verdict({**one, "within": {"absolute": 0}}, results=now)[1], GATE_FAILED)
            self.assertEqual(self.verdict({**one, "within": {"absolute": 1e-12}}, results=now)[1], DONE)

    def test_rebaselining_shows_the_difference_and_then_writes(self):
        self.store(0.5)
        result = self.judge(self.WITHIN, options=("--rebaseline",))
        self.assertEqual(result.returncode, DONE, result.stderr)
        lines = result.stdout.splitlines()
        self.assertEqual(lines[0], self.WITHIN["name"])
        self.assertIn(" -> ", lines[1])
        self.assertIn("(+100%)", lines[1])
        self.assertIn("1 of 4 numbers differ from the baseline", result.stdout)
        self.assertIn("written: ", lines[-1])
        self.assertEqual(strict_json((self.folder / "old.json").read_text()), strict_json(self.document))
        self.assertEqual(self.verdict(self.WITHIN)[1], DONE)

    def test_a_first_baseline_is_made_and_its_lack_is_said(self):
        self.assert_user_error(self.judge(self.WITHIN), "old.json", "no readable file")
        self.assertEqual(self.judge(self.WITHIN, options=("--rebaseline",)).returncode, DONE)
        self.assertEqual(self.verdict(self.WITHIN)[1], DONE)

    def test_what_cannot_be_a_baseline_is_refused_and_nothing_written(self):
        old = self.store()
        before = old.read_text()
        failed = mutated(strict_json(self.document), ("runs", 0, "status"), "unstable")
        failed = self.write("failed.json", failed)
        self.assert_user_error(self.judge(self.WITHIN, options=("--rebaseline",), results=failed), "unstable")
        self.assert_user_error(self.judge(gate(maximum=1), options=("--rebaseline",)), "no gate with a baseline")
        self.assert_user_error(self.judge({**self.WITHIN, "baseline": "results.json"}), "the results themselves")
        self.assert_user_error(
            self.judge({**self.WITHIN, "baseline": "results.json"}, options=("--rebaseline",)), "the input itself")
        result = self.judge(self.WITHIN, options=("--rebaseline", "--junit", "x.xml"))
        self.assert_user_error(result, "--junit")
        self.assertEqual(old.read_text(), before)


class BadGates(Gate):
    def refuse(self, one, *words):
        result = self.judge(one)
        self.assert_user_error(result, "gates.json: ", "gates[0]", *words)

    def test_unknown_names_are_refused_with_what_there_is(self):
        self.refuse(gate(maximun=1), "gates[0].maximun: found an unknown key", "did you mean 'maximum'?")
        self.refuse(gate("stabilty", maximum=1), "did you mean 'stability'?")
        self.refuse(gate(maximum=1, field="temprature"), "gates[0].field", "one of temperature")
        self.refuse(gate(maximum=1, region="corner"), "gates[0].region", "one of all")
        self.refuse(gate("skill", maximum=1, region="wal"), "gates[0].region", "did you mean 'wall'?")
        self.refuse(gate(maximum=1, norm="l3"), "gates[0].norm", "l1, l2, linf")
        self.refuse(gate("conservation", quantity="momentum", maximum=1), "gates[0].quantity", "one of energy")
        self.refuse(gate("cost", maximum=1, relative_to="conduction/campbell-flux"), "gates[0].relative_to",
                    "conduction/lucy-flux")  # fmt: skip

    def test_time_and_cost_need_another_formulation(self):
        for measure in ("cost", "time_to_error"):
            self.refuse(gate(measure, maximum=1), "gates[0].relative_to: found nothing", "ratios only")

    def test_a_limit_below_the_accuracy_of_the_reference_is_refused(self):
        self.refuse(gate(maximum=1e-20), "gates[0].maximum: found 1e-20, expected at least",
                    "the reference of conduction/slab-dirichlet is no more accurate")  # fmt: skip

    def test_a_missing_limit_or_reason_is_refused(self):
        self.refuse(gate(), "found no limit")
        self.refuse(gate(maximum=1, expect="fail"), "gates[0].reason")
        self.refuse(gate(maximum=1, name="two\nlines"), "gates[0].name")

    def test_broken_documents_are_refused(self):
        for text in ("", "{", "[]", "{}", '{"schema": "sphverify-study/1"}'):
            path = self.write("bad.json", text)
            self.assert_user_error(self.run_program("gate", self.results, path), path)
            good = self.write("gates.json", {"schema": "sphverify-gates/1", "gates": [gate(maximum=1)]})
            self.assert_user_error(self.run_program("gate", path, good), path)
        self.assert_user_error(self.run_program("gate", "-", "-"), "standard input")
        self.assert_user_error(self.run_program("gate", self.results), "GATES.json")


class Documents(Gate):
    def test_the_schema_takes_what_the_program_takes(self):
        gates = [gate(measure, **keys) for measure, keys in HOLDING.items()]
        gates += Reports.GATES[:1] + [Baselines.WITHIN]
        gates += [gate(maximum=1, runs=2), gate("status", equals="ok", at_least=2), gate("order", within={"relative": 1},
                  baseline="b", verdict="ignore", runs=1), gate("skill", maximum=1, region="smooth", at_least=1)]  # fmt: skip
        self.assert_valid("sphverify-gates-1", {"schema": "sphverify-gates/1", "gates": gates})

    def test_the_schema_refuses_what_the_program_refuses(self):
        for one in (gate(), gate(maximun=1), gate("cost", maximum=1), gate("status", maximum=1), gate("x", maximum=1),
                    gate(maximum=1, expect="fail"), gate(maximum=1, reason="x"), gate(maximum=1, equals=1),
                    gate("order", equals=2), gate(maximum=1, baseline="b"), gate(maximum=1, norm="l3"),
                    gate(maximum=1, runs=0), gate(maximum=1, runs=1, at_least=1), gate(maximum=1, at_least=0.5),
                    gate(maximum=1, verdict="ignore"), gate("order", equals="floored", verdict="ignore"),
                    gate("order", minimum=1, verdict="never"), gate("skill", maximum=1, relative=True),
                    gate("time_error", maximum=1, norm="l1"),
                    without(gate(maximum=1), ("select",))):  # fmt: skip
            document = {"schema": "sphverify-gates/1", "gates": [one]}
            with self.assertRaises(AssertionError, msg=json.dumps(one)):
                self.assert_valid("sphverify-gates-1", document)
            self.assertEqual(self.judge(one).returncode, USER_ERROR, one)

    def test_our_own_gates_and_their_studies_are_valid(self):
        documents = sorted((SOURCE_DIR / "tests" / "gates").glob("*.json"))
        self.assertGreaterEqual(len(documents), 4)
        for path in documents:
            self.assert_valid("sphverify-gates-1", strict_json(path.read_text()))
            study = path.parent / "studies" / path.name
            self.assert_valid("sphverify-study-1", strict_json(study.read_text()))

    def test_our_own_gates_on_rates_hold(self):
        """The others take longer: tests/gates/run."""
        for name in ("operators", "rates"):
            folder = SOURCE_DIR / "tests" / "gates"
            self.succeed("study", folder / "studies" / f"{name}.json", "-o", self.folder / "own.json")
            self.succeed("gate", self.folder / "own.json", folder / f"{name}.json")


if __name__ == "__main__":
    unittest.main()
