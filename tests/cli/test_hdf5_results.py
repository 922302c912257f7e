# SPDX-License-Identifier: GPL-3.0-or-later
"""Results in HDF5: the same names and numbers as in JSON, the same answers from either, and what is refused."""

import sys

sys.dont_write_bytecode = True

import json
import shutil
import subprocess
import unittest

from program import DONE, PROGRAM, USER_ERROR, ProgramTest, environment, small_study, strict_json, timeless

try:
    import h5py
    import numpy
except ImportError:
    h5py = None

STUDY = small_study(
    cases=["conduction/slab-dirichlet", {"id": "hydro/riemann", "parameters": {"final_time": 0.02}}],
    formulations=["conduction/brookshaw", "momentum/p-rho2"],
    discretisation={"layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2]}]},
    resolution=[10, 14, 20],
    measure=["error", "conservation", "cost", "profile", "history"],
)
GATES = {"schema": "sphverify-gates/1",
         "gates": [{"name": "error", "select": {"case": "conduction/slab-dirichlet"},
                    "measure": "error", "field": "temperature", "maximum": 1.0}]}  # fmt: skip


class Hdf5Results(ProgramTest):
    def setUp(self):
        super().setUp()
        document = self.write("study.json", STUDY)
        self.part = self.folder / "part.h5"
        result = self.run_program("study", document, "--part", "1/1", "-o", self.part, "--format", "hdf5")
        if "built without libhdf5-dev" in result.stderr:
            self.assertEqual(result.returncode, USER_ERROR)
            self.skipTest("the program was built without HDF5")
        self.assertEqual(result.returncode, DONE, result.stderr)
        # From one and the same part, so that times are the same, too.
        self.json, self.hdf5 = self.folder / "results.json", self.folder / "results.data"
        self.succeed("merge", self.part, "-o", self.json)
        self.succeed("merge", self.part, "-o", self.hdf5, "--format", "hdf5")
        self.results = strict_json(self.json.read_text())

    def run_bytes(self, *arguments, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True, cwd=self.folder, env=environment(), **options)

    def test_either_is_what_one_process_computes(self):
        self.assertEqual(timeless(self.results), timeless(self.study(STUDY, "whole.json")))
        self.assert_valid("sphverify-results-1", self.results)
        self.assertEqual(self.hdf5.read_bytes()[:8], b"\x89HDF\r\n\x1a\n")

    def test_every_command_says_the_same_of_either(self):
        gates = self.write("gates.json", GATES)
        for command in (["compare", "RESULTS"], ["compare", "RESULTS", "--section", "levels", "--format", "csv"],
                        ["compare", "RESULTS", "--format", "json"], ["report", "RESULTS"], ["gate", "RESULTS", gates]):  # fmt: skip
            said = []
            for source in (self.json, self.hdf5):
                place = self.folder / "results"
                shutil.copy(source, place)
                said.append(self.succeed(*[place if word == "RESULTS" else word for word in command]))
            self.assertEqual(said[0], said[1], command)
            self.assertGreater(len(said[0]), 20)
        for source in (self.json, self.hdf5):
            self.assertIn("to the bit", self.run_program("repeat", source, "3").stderr)
        changes = self.succeed("compare", self.json, self.hdf5, "--section", "changes")
        self.assertIn("no", changes.lower())

    def test_standard_input_and_output_take_it(self):
        written = self.run_bytes("merge", self.part, "--format", "hdf5")
        self.assertEqual(written.stdout, self.hdf5.read_bytes())
        said = self.run_bytes("compare", "-", input=written.stdout).stdout
        self.assertEqual(said, self.run_bytes("compare", "-", input=self.json.read_bytes()).stdout)

    def test_a_new_baseline_is_of_the_format_of_the_old_and_json_again_is_the_same_text(self):
        gate = dict(GATES["gates"][0], within={"relative": 0.1}, baseline="baseline")
        del gate["maximum"]
        gates = self.write("gates.json", GATES | {"gates": [gate]})
        baseline = self.folder / "baseline"
        self.succeed("gate", self.hdf5, gates, "--rebaseline")
        self.assertEqual(baseline.read_bytes(), self.json.read_bytes())
        shutil.copy(self.hdf5, baseline)
        self.succeed("gate", self.json, gates, "--rebaseline")
        self.assertEqual(baseline.read_bytes(), self.hdf5.read_bytes())

    @unittest.skipUnless(h5py, "python3-h5py is missing")
    def test_names_and_numbers_are_those_of_json(self):
        with h5py.File(self.hdf5) as file:
            runs = file["runs"]
            records = self.results["runs"]
            self.assertEqual(json.loads(file["study"][()]), self.results["study"])
            self.assertEqual(list(runs["case"].asstr()[:]), [run["case"] for run in records])
            self.assertEqual(list(runs["resolution"][:]), [run["resolution"] for run in records])
            error = runs["errors/temperature/all/l2"][:]
            starts = runs["profile/position@starts"][:]
            for k, run in enumerate(records):
                if "temperature" in run["errors"]:
                    self.assertEqual(error[k], run["errors"]["temperature"]["all"]["l2"])
                else:
                    self.assertTrue(numpy.isnan(error[k]))
                position = runs["profile/position"][starts[k] : starts[k + 1]]
                self.assertEqual(position.tolist(), run["profile"]["position"])
            self.assertTrue(any("temperature" not in run["errors"] for run in records))
            orders = file["series/orders"]
            first = file["series/orders@starts"][:]
            for k, series in enumerate(self.results["series"]):
                fields = list(orders["field"].asstr()[first[k] : first[k + 1]])
                self.assertEqual(fields, [order["field"] for order in series["orders"]])

    def test_what_cannot_be_read_is_refused_in_one_line(self):
        cut = self.folder / "cut.h5"
        cut.write_bytes(self.hdf5.read_bytes()[:-100])
        self.assert_user_error(self.run_program("compare", cut), "cut.h5: found an HDF5 file that cannot be opened (cut short?)")
        self.succeed("particles", "hydro/gresho", "-n", "12", "--format", "hdf5", "-o", self.folder / "snap.h5")
        for command in (["compare"], ["report"], ["merge"]):
            self.assert_user_error(self.run_program(*command, self.folder / "snap.h5"), "an HDF5 file of another kind, expected results of sphverify")
        self.assert_user_error(self.run_program("merge", self.part, "--format", "xml"), "--format: found 'xml', expected one of json, hdf5")

    @unittest.skipUnless(h5py, "python3-h5py is missing")
    def test_what_somebody_changed_is_refused_where_it_stands(self):
        changed = self.folder / "changed.h5"

        def change(name, values):
            shutil.copy(self.hdf5, changed)
            with h5py.File(changed, "r+") as file:
                del file[name]
                if values is not None:
                    file[name] = values

        n = len(self.results["runs"])
        change("runs/resolution", numpy.arange(n - 1))
        self.assert_user_error(self.run_program("compare", changed), f"runs/resolution: found {n - 1} entries, expected {n}")
        change("runs/spacing", -numpy.ones(n))
        self.assert_user_error(self.run_program("compare", changed), "runs[0].spacing: found -1.0, expected")
        change("runs/status", None)
        self.assert_user_error(self.run_program("compare", changed), "runs[0].status: found nothing")
        change("runs/label", h5py.SoftLink("/runs/status"))
        self.assert_user_error(self.run_program("compare", changed), "runs/label: found a link to somewhere else")
        change("runs/history", h5py.SoftLink("/"))
        self.assert_user_error(self.run_program("compare", changed), "runs/history: found a link to somewhere else")


if __name__ == "__main__":
    unittest.main()
