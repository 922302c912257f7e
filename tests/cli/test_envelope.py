# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies that drive a parameter until runs break, and runs that are carried out again."""

import unittest

import program

STUDY = {
    "schema": "sphverify-study/1",
    "name": "limits",
    "cases": "conduction/slab-dirichlet",
    "formulations": ["conduction/brookshaw", "conduction/campbell-flux"],
    "discretisation": {"layout": "lattice"},
    "envelope": {"parameter": "smoothing_ratio", "from": 1.2, "to": 0.5, "bisections": 4},
    "resolution": 40,
    "measure": "error",
}


class EnvelopeTest(program.ProgramTest):
    def test_brackets_where_a_form_breaks(self):
        results = self.study(STUDY, "limits.json")
        held, broke = results["envelopes"]
        self.assertEqual((held["held"], held["failed"], held["status"]), (0.5, None, "ok"))
        self.assertEqual([p["value"] for p in held["points"]], [0.5])
        self.assertEqual(broke["status"], "unstable")
        self.assertAlmostEqual(broke["held"] - broke["failed"], 0.7 / 2**4, delta=1e-12)
        self.assertEqual(len(broke["points"]), 6)
        self.assertEqual(len(results["runs"]), 7)
        self.assertEqual(results["series"], [])
        tried = [run["discretisation"]["smoothing_ratio"] for run in results["runs"]]
        self.assertEqual(tried, [p["value"] for e in (held, broke) for p in e["points"]])

    def test_refuses_what_cannot_be_driven(self):
        for change, key in [
            ({"parameter": "colour"}, "colour"),
            ({"parameter": "amplitude", "from": 0.1, "to": 0.3}, "jittered"),
            ({"to": 1.2}, "from"),
            ({"parameter": "dimension", "from": 1, "to": 3}, "whole number"),
            ({"from": -1, "scale": "logarithmic"}, "positive"),
            ({"parameter": "final_time", "to": -1}, "final_time"),
        ]:
            document = STUDY | {"envelope": STUDY["envelope"] | change}
            self.write("bad.json", document)
            self.assert_user_error(self.run_program("study", self.folder / "bad.json"), key)


class RepeatTest(program.ProgramTest):
    def test_a_run_comes_out_as_it_was(self):
        results = self.study(STUDY, "limits.json")
        broken = next(i for i, run in enumerate(results["runs"]) if run["status"] == "unstable")
        for index in (0, broken):
            again = program.strict_json(self.succeed("repeat", self.folder / "limits.json", index))
            before = results["runs"][index]
            for key in ("status", "reason", "errors", "discretisation", "particles", "spacing"):
                self.assertEqual(again[key], before[key], key)

    def test_a_level_of_a_refinement_path_keeps_its_smoothing_length(self):
        ladder = STUDY | {"resolution": [20, 33], "smoothing_exponent": 0.5}
        del ladder["envelope"]
        results = self.study(ladder, "ladder.json")
        again = program.strict_json(self.succeed("repeat", self.folder / "ladder.json", 1))
        for key in ("smoothing_length", "smoothing_exponent", "errors"):
            self.assertEqual(again[key], results["runs"][1][key], key)

    def test_says_whether_the_numbers_agree(self):
        results = self.study(STUDY, "limits.json")
        same = self.run_program("repeat", self.folder / "limits.json", 0)
        self.assertRegex(same.stderr, r"numbers +all \d+ agree to the bit")
        results["runs"][0]["errors"]["temperature"]["wall"]["linf"] *= 2
        self.write("moved.json", results)
        moved = self.run_program("repeat", self.folder / "moved.json", 0)
        self.assertEqual(moved.returncode, program.DONE)
        self.assertRegex(moved.stderr, r"numbers +1 of \d+ differ, .*temperature wall linf: 5\.0e-1 of it")
        self.assertEqual(moved.stdout, same.stdout)

    def test_refuses_a_run_that_is_not_there_and_names_it_as_it_was_given(self):
        self.study(STUDY, "limits.json")
        for index in ("7", "-1"):
            result = self.run_program("repeat", self.folder / "limits.json", index)
            self.assert_user_error(result, f"RUN: found {index}, expected an index from 0 to 6")


if __name__ == "__main__":
    unittest.main()
