# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever is asked for and changes nothing is refused; defaults may be written out."""

import sys

sys.dont_write_bytecode = True

import json
import unittest

from program import DONE, ProgramTest, small_study

SLAB = {"id": "conduction/slab-dirichlet", "parameters": {"final_time": 1e-4}}
SINE = {"id": "operator/sine"}
ACOUSTIC = {"id": "hydro/acoustic", "parameters": {"final_time": 1e-3}}
TUBE = {"id": "hydro/riemann", "parameters": {"final_time": 1e-3}}
PERIODIC = {"id": "hydro/acoustic", "parameters": {"final_time": 1e-3, "boundary": "periodic"}}
GAS = "momentum/p-rho2"
HEAT = "conduction/brookshaw"
OFF = {"id": HEAT, "walls": "off"}
STRONG = {"alpha": 1, "beta": 2}


def asking(case, formulation=HEAT, **changes):
    formulations = formulation if isinstance(formulation, list) else [formulation]
    study = {"discretisation": None, "resolution": [8, 12]} | changes
    return small_study(cases=[case] if isinstance(case, dict) else case, formulations=formulations, **study)


class Studies(ProgramTest):
    def refuse(self, study, *words):
        path = self.write("study.json", study)
        self.assert_user_error(self.run_program("study", path), f"{path}: ", "expected", *words)

    def test_a_choice_that_changes_no_run_is_refused_where_it_stands(self):
        for case, formulation, key, value, found in (
            (SLAB, HEAT, "viscosity", STRONG, "discretisation.viscosity: found an object"),
            (SLAB, HEAT, "viscosity", "off", "discretisation.viscosity: found 'off'"),
            (SLAB, HEAT, "viscosity", ["auto", STRONG], "discretisation.viscosity[1]: found an object"),
            (SINE, GAS, "viscosity", STRONG, "discretisation.viscosity: found an object"),
            (ACOUSTIC, GAS, "viscosity", ["auto", "off"], "discretisation.viscosity[1]: found 'off'"),
            (ACOUSTIC, GAS, "viscosity", [STRONG, "auto", "off"], "discretisation.viscosity[2]: found 'off'"),
            (SLAB, HEAT, "viscosity", [STRONG, "off"], "discretisation.viscosity[1]: found 'off'"),
            (SLAB, HEAT, "smoothing", "adaptive", "discretisation.smoothing: found 'adaptive'"),
            (SLAB, HEAT, "smoothing", ["uniform", "adaptive"], "discretisation.smoothing[1]: found 'adaptive'"),
            (SLAB, HEAT, "wall_motion", "mass", "discretisation.wall_motion: found 'mass'"),
            (ACOUSTIC, GAS, "wall_motion", "mass", "discretisation.wall_motion: found 'mass'"),
            (SINE, GAS, "integrator", "runge-kutta", "discretisation.integrator: found 'runge-kutta'"),
            (TUBE, GAS, "integrator", ["auto", "leapfrog"], "discretisation.integrator[1]: found 'leapfrog'"),
            (SLAB, OFF, "face_weight", "campbell", "discretisation.face_weight: found 'campbell'"),
            (SLAB, OFF, "closure", "one-sided", "discretisation.closure: found 'one-sided'"),
            (PERIODIC, GAS, "closure", "one-sided", "discretisation.closure: found 'one-sided'"),
            (SLAB, HEAT, "density", ["given", "continuity"], "discretisation.density[1]: found 'continuity'"),
        ):  # fmt: skip
            with self.subTest(key=key, value=value):
                self.refuse(asking(case, formulation, discretisation={key: value}), found, "what changes a run")

    def test_a_choice_at_the_top_of_the_document_likewise(self):
        self.refuse(asking(SLAB, viscosity=STRONG), "json: viscosity: found an object")

    def test_an_exponent_of_a_single_resolution_is_refused(self):
        for exponent, found in ((0.5, "smoothing_exponent: found 0.5"), ([0, 0.5], "smoothing_exponent[1]: found 0.5")):
            with self.subTest(exponent=exponent):
                self.refuse(asking(SLAB, resolution=20, smoothing_exponent=exponent), found, "only one")

    def test_a_measure_that_no_case_has_is_refused(self):
        for case, formulation, measure in (
            (SINE, HEAT, "stability"), (SINE, HEAT, "spectrum"), (SINE, HEAT, "stable-step"), (SINE, HEAT, "history"),
            (ACOUSTIC, GAS, "second-law"), (SLAB, HEAT, "energy-routes"),
        ):  # fmt: skip
            with self.subTest(measure=measure):
                self.refuse(asking(case, formulation, measure=["error", measure]), f"measure[1]: found '{measure}'")

    def test_what_is_named_twice_is_refused(self):
        self.refuse(asking(SLAB, measure=["error", "cost", "error"]), "measure[2]: found 'error'", "only once")
        partner = {"id": GAS, "work": "work/internal-energy"}
        self.refuse(asking(ACOUSTIC, [GAS, partner]), "formulations[1]: found an object")
        self.refuse(asking(PERIODIC, [GAS, {"id": GAS, "walls": "off"}]), "formulations[1]: found an object")

    def test_repeats_of_what_is_not_timed_are_refused(self):
        self.refuse(asking(SLAB, measure=["error"], repeat=3), "repeat: found 3", "cost")

    def test_what_an_envelope_drives_is_not_also_given(self):
        envelope = {"parameter": "smoothing_ratio", "from": 1.2, "to": 1.5, "bisections": 0}
        self.refuse(asking(SLAB, envelope=envelope, discretisation={"smoothing_ratio": 2}),
                    "discretisation.smoothing_ratio: found 2", "envelope")  # fmt: skip
        driven = {"parameter": "final_time", "from": 1e-4, "to": 2e-4, "bisections": 0}
        self.refuse(asking(SLAB, envelope=driven), "envelope.parameter: found 'final_time'")

    def test_keys_of_another_layout_are_refused(self):
        layout = {"id": "jittered", "amplitude": 0.1, "seed": 1, "gap": 0.1}
        self.refuse(asking(SLAB, discretisation={"layout": layout}), "discretisation.layout.gap: found an unknown key")

    def test_what_changes_a_run_of_one_case_is_taken(self):
        for study in (
            asking([SLAB, ACOUSTIC], [HEAT, GAS], discretisation={"viscosity": STRONG}),
            asking([ACOUSTIC, TUBE], GAS, discretisation={"viscosity": ["auto", "off"]}),
            asking(SLAB, [HEAT, OFF], discretisation={"closure": "one-sided", "face_weight": ["exact", "campbell"]}),
            asking(SLAB, smoothing_exponent=[0, 0.5]),
            asking(SLAB, resolution=8, smoothing_exponent=0),
            # What the runs do anyway may be said.
            asking(ACOUSTIC, GAS, discretisation={"integrator": "runge-kutta", "viscosity": "off", "density": "continuity"}),
            asking(TUBE, GAS, discretisation={"integrator": "leapfrog", "viscosity": STRONG}),
            asking(SLAB, discretisation={"integrator": "bdf"}),
        ):
            with self.subTest(study=study):
                self.assertEqual(self.run_program("study", self.write("study.json", study)).returncode, DONE)

    def test_the_study_as_run_may_be_run_again(self):
        for study in (asking(SLAB), asking([SLAB, SINE, ACOUSTIC], [HEAT, GAS]), asking(SINE, HEAT)):
            with self.subTest(study=study):
                as_run = self.study(study)["study"]
                result = self.run_program("study", self.write("again.json", as_run))
                self.assertEqual(result.returncode, DONE, result.stderr)

    def test_a_choice_that_is_skipped_with_its_reason_is_taken(self):
        study = asking(SLAB, discretisation={"density": ["given", "summation", "continuity"]})
        skipped = self.study(study)["skipped"]
        self.assertEqual([one["reason"] for one in skipped], ["continuity density needs particles that move"])


class Exact(ProgramTest):
    def test_a_final_time_beside_the_time_is_refused(self):
        for time in ("0", "0.01", "0.04"):
            with self.subTest(time=time):
                result = self.run_program("exact", "conduction/slab-dirichlet", "--parameter", "final_time=0.04",
                                          "--time", time, "--points", "0.5")  # fmt: skip
                self.assert_user_error(result, "--parameter final_time: found 0.04", "takes its place")

    def test_it_is_said_once_and_with_the_name_of_the_case(self):
        result = self.run_program("exact", "conduction/marshak", "--time", "100", "--points", "0.5")
        self.assert_user_error(result, "exact: conduction/marshak: --time: found 100, expected")


if __name__ == "__main__":
    unittest.main(verbosity=2)
