# SPDX-License-Identifier: GPL-3.0-or-later
"""Documents of ours that somebody edited by hand: numbers that none of our runs could have are refused where they stand,
and a journal's records are those of the runs that they are taken for."""

import sys

sys.dont_write_bytecode = True

import json
import pathlib
import unittest
import zlib

from program import DONE, PROGRAM, ProgramTest, mutated, small_study, without

LADDER = small_study(resolution=[8, 12, 16, 24], measure=["error", "conservation", "cost", "stability"])
ORDER = ("series", 0, "orders", 0)
ERROR = ("runs", 0, "errors", "temperature", "all")
GATES = {
    "schema": "sphverify-gates/1",
    "gates": [{"name": "runs", "select": {"walls": "on"}, "measure": "status", "equals": "ok"}],
}


class Results(ProgramTest):
    def setUp(self):
        super().setUp()
        self.results = self.study(LADDER)
        self.gates = self.write("gates.json", GATES)

    def refuse(self, path, value, place, *words):
        edited = self.write("edited.json", mutated(self.results, path, value))
        for arguments in (("compare", edited), ("report", edited, "-o", "page.html"), ("gate", edited, self.gates)):
            with self.subTest(command=arguments[0], path=path):
                self.assert_user_error(self.run_program(*arguments), f"{edited}: {place}: found ", ", expected ", *words)

    def test_what_is_never_negative_is_refused(self):
        for path, place in (
            ((*ERROR, "l1"), "runs[0].errors.temperature.all.l1"),
            ((*ERROR, "scale", "l2"), "runs[0].errors.temperature.all.scale.l2"),
            ((*ERROR, "initial", "linf"), "runs[0].errors.temperature.all.initial.linf"),
            ((*ERROR, "round_off"), "runs[0].errors.temperature.all.round_off"),
            (("runs", 0, "spacing"), "runs[0].spacing"),
            (("runs", 0, "smoothing_length"), "runs[0].smoothing_length"),
            (("runs", 0, "cost", "seconds"), "runs[0].cost.seconds"),
            (("runs", 0, "stability", "spectral_radius"), "runs[0].stability.spectral_radius"),
            ((*ORDER, "levels", 1, "error"), "series[0].orders[0].levels[1].error"),
            ((*ORDER, "levels", 1, "spacing"), "series[0].orders[0].levels[1].spacing"),
            (("series", 0, "time_to_error", 0, "error"), "series[0].time_to_error[0].error"),
        ):
            self.refuse(path, -0.1, place, "0 or more")
        self.refuse(("runs", 0, "spacing"), 0, "runs[0].spacing", "a positive number, where there are errors")
        self.refuse(("runs", 0, "discretisation", "smoothing_ratio"), -1, "runs[0].discretisation.smoothing_ratio")

    def test_norms_out_of_order_are_refused(self):
        error = self.results["runs"][0]["errors"]["temperature"]["all"]
        self.refuse((*ERROR, "l1"), 2 * error["l2"], "runs[0].errors.temperature.all.l1", "at most l2")
        self.refuse((*ERROR, "linf"), 0.5 * error["l2"], "runs[0].errors.temperature.all.l2", "at most linf")

    def test_intervals_that_end_before_they_begin_are_refused(self):
        self.refuse((*ORDER, "interval"), [2, 1], "series[0].orders[0].interval", "[2,1]", "the lower end first")
        floor = {"value": 1e-3, "interval": [2e-3, 1e-3]}
        self.refuse((*ORDER, "floor"), floor, "series[0].orders[0].floor.interval", "the lower end first")

    def test_momenta_in_more_than_three_dimensions_are_refused_at_once(self):
        run = self.results["runs"][0]["conservation"]["energy"]
        momentum = {key: [0.0] * 20_000 for key in run}
        self.refuse(("runs", 0, "conservation", "momentum"), momentum, "runs[0].conservation.momentum.initial", "one number per dimension")

    def test_a_verdict_that_there_is_not_is_refused(self):
        self.refuse((*ORDER, "verdict"), "splendid", "series[0].orders[0].verdict", "asymptotic")

    def test_a_study_in_results_that_is_none_is_refused_by_who_takes_runs_from_it(self):
        whole = self.results["study"]
        lacking = [without(whole, [key]) for key in ("schema", "name", "formulations", "resolution", "measure", "repeat")]
        for study in ({}, 5, [], {"schema": 5}, whole | {"resolution": []}, *lacking):
            with self.subTest(study=study):
                edited = self.write("edited.json", self.results | {"study": study})
                self.assert_user_error(self.run_program("repeat", edited, 0), f"{edited}: ", ": found ", ", expected ")

    def test_what_we_wrote_ourselves_is_taken(self):
        self.succeed("compare", "results.json")


class Journals(ProgramTest):
    """A journal of a finished run, made by hand from results."""

    def journal(self, *records, build=None):
        self.results = self.study(LADDER, "whole.json")
        lines = [{"run": index, "record": self.record(index) | change} for index, change in records]
        text = self.header(self.results, build) + "".join(json.dumps(line) + "\n" for line in lines)
        self.write("r.json.journal", text)
        return self.run_program("study", self.write("study.json", LADDER), "-o", "r.json", "--resume")

    def header(self, results, build=None):
        built = pathlib.Path(PROGRAM).read_bytes()
        build = build or f"{zlib.crc32(built):08x}-{len(built)}"
        return json.dumps({"schema": "sphverify-journal/1", "build": build, "study": results["study"]}) + "\n"

    def record(self, index):
        return self.results["runs"][index]

    def test_a_record_of_the_run_itself_is_taken(self):
        result = self.journal((1, {}))
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertIn("1 of them done before", result.stderr)

    def test_a_record_of_another_run_is_refused(self):
        for change in (
            {"resolution": 99},
            {"case": "conduction/marshak"},
            {"formulation": "conduction/lucy-flux"},
            {"walls": "off"},
            {"smoothing_exponent": 0.5},
            {"parameters": {"final_time": 0.02}},
        ):
            with self.subTest(change=change):
                result = self.journal((1, change))
                self.assert_user_error(result, "r.json.journal: run 1: found a record of another run", "at resolution 12")
                self.assertTrue((self.folder / "r.json.journal").exists())

    def test_a_record_with_impossible_numbers_is_refused(self):
        result = self.journal((1, {"spacing": -1}))
        self.assert_user_error(result, "r.json.journal: record.spacing: found -1")

    def test_a_journal_of_another_build_is_refused(self):
        result = self.journal((1, {}), build="00000000-1")
        self.assert_user_error(result, "r.json.journal: build: found the journal of another build")
        self.assertTrue((self.folder / "r.json.journal").exists())

    def test_a_first_line_of_other_things_is_no_journal(self):
        for line in ("5", "[]", "{}", '{"schema": 5}', '{"schema": ["sphverify-journal/1"], "study": {}}', "[" * 100_000):
            with self.subTest(line=line[:40]):
                self.write("r.json.journal", line + "\n")
                result = self.run_program("study", self.write("study.json", LADDER), "-o", "r.json", "--resume")
                self.assert_user_error(result, "r.json.journal: found something else, expected the journal of a study")

    def test_a_line_that_is_nested_without_end_is_damaged(self):
        """Whoever looks into it goes as deep."""
        for line in ("[" * 200_000 + "]" * 200_000, '{"run": 0, "record": {"case": ' + "[" * 200_000 + "]" * 200_000 + "}}"):
            self.journal()
            self.write("r.json.journal", self.header(self.results) + line + "\n")
            result = self.run_program("study", self.write("study.json", LADDER), "-o", "r.json", "--resume")
            self.assert_user_error(result, "r.json.journal: found a damaged line")

    def test_a_time_below_zero_is_refused(self):
        record = self.study(LADDER)["runs"][0]
        line = {"run": 0, "record": record, "awaits_timing": True, "spent_seconds": -1}
        self.journal()
        self.write("r.json.journal", self.header(self.results) + json.dumps(line) + "\n")
        result = self.run_program("study", self.write("study.json", LADDER), "-o", "r.json", "--resume")
        self.assert_user_error(result, "r.json.journal: spent_seconds: found -1")

    def test_a_journal_without_its_study_is_refused(self):
        self.write("r.json.journal", '{"schema": "sphverify-journal/1"}\n')
        result = self.run_program("study", self.write("study.json", LADDER), "-o", "r.json", "--resume")
        self.assert_user_error(result, "the journal of another study")


if __name__ == "__main__":
    unittest.main(verbosity=2)
