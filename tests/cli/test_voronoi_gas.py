# SPDX-License-Identifier: GPL-3.0-or-later
"""Gas that is pushed through the faces of Voronoi cells: at rest, at walls, in budgets, refused with other weights."""

import sys

sys.dont_write_bytecode = True

import unittest

import program
from program import ProgramTest, strict_json

FORM = "momentum/voronoi"
CELLS = {"pair_weight": "voronoi", "density": "voronoi"}


class VoronoiGas(ProgramTest):
    def results(self, cases, formulations, resolution, discretisation, **keys):
        document = {"schema": "sphverify-study/1", "name": "voronoi gas", "cases": cases, "formulations": formulations,
                    "resolution": resolution, "measure": ["error", "conservation"], "discretisation": discretisation, **keys}  # fmt: skip
        results = strict_json(self.succeed("study", self.write("study.json", document)))
        self.assertEqual(program.complaints("sphverify-results-1", results), [])
        return results

    def test_a_uniform_gas_rests_between_walls_of_either_kind_on_any_particles(self):
        layouts = ["lattice", {"id": "jittered", "amplitude": 0.45, "seeds": [1], "masses": "voronoi"},
                   {"id": "random", "seeds": [1], "masses": "voronoi"}]  # fmt: skip
        for dimension, resolution in ((1, 20), (2, 6), (3, 4)):
            for boundary in ("pressure", "velocity"):
                case = {"id": "hydro/uniform", "parameters": {"dimension": dimension, "boundary": boundary, "final_time": 0.02}}
                results = self.results(case, FORM, resolution, CELLS | {"closure": ["quotient", "one-sided"], "integrator": "leapfrog",
                                                                        "layout": layouts})  # fmt: skip
                self.assertGreaterEqual(len(results["runs"]), 4)
                for run in results["runs"]:
                    self.assertEqual(run["status"], "ok")
                    # P/(rho dx) is the resolution.
                    self.assertLess(run["errors"]["velocity"]["all"]["linf"], 1e-12 * resolution)

    def test_walls_give_what_they_prescribe_and_budgets_add_up(self):
        case = {"id": "hydro/piston-pressure", "parameters": {"final_time": 0.2}}
        for run in self.results(case, FORM, 50, CELLS | {"closure": "one-sided", "smoothing": "adaptive"})["runs"]:
            self.assertEqual(run["status"], "ok")
            impulse = run["wall_budgets"][0]["impulse"]  # of the wall that prescribes a pressure
            self.assertLess(abs(impulse["measured"][0] - impulse["prescribed"][0]), 1e-14)
            energy = run["conservation"]["energy"]
            self.assertLess(abs(energy["pair_drift"]), 1e-13)

    def test_other_weights_and_densities_are_skipped_with_the_reason(self):
        results = self.results(["hydro/uniform", "operator/polynomial"], [FORM, {"id": "momentum/p-rho2", "work": "work/voronoi"}], 8,
                               {"pair_weight": ["kernel", "voronoi"], "density": ["continuity", "voronoi"]}, time_budget=0.01)  # fmt: skip
        reasons = {s["reason"] for s in results["skipped"]}
        for form in (FORM, "work/voronoi"):
            self.assertIn(form + " pushes through faces of cells, which a kernel does not have: take pair weight voronoi", reasons)
        self.assertIn(FORM + " works on the volumes of cells: take density voronoi, not continuity", reasons)
        self.assertTrue(all(r["discretisation"]["pair_weight"] == "voronoi" for r in results["runs"]))
        # With nothing said of weights a study says why it has no run.
        alone = self.results("hydro/uniform", [FORM, "momentum/p-rho2"], 8, {}, time_budget=0.01)
        self.assertEqual({s["formulation"] for s in alone["skipped"]}, {FORM + " + work/voronoi"})

    def test_a_state_is_evaluated_with_its_weights_and_refused_without(self):
        state = {"schema": "sphverify-state/1", "dimension": 2, "pair_weight": "voronoi",
                 "particles": {"position": [[0.2, 0.3], [0.7, 0.2], [0.4, 0.8], [0.9, 0.9]], "mass": [1.0, 2.0, 1.0, 3.0],
                               "smoothing_length": 0.6, "density": "voronoi", "pressure": [1.2, 1.7, 1.4, 1.9],
                               "velocity": [[0, 0], [1, 0], [0, 1], [1, 1]]}}  # fmt: skip
        # P = 1 + x: a = -grad P/rho up to the walls.
        walls = [{"point": p, "outward_normal": n, "pressure": 1.0 + p[0], "velocity": [0, 0]}
                 for p, n in (([0, 0], [-1, 0]), ([1, 0], [1, 0]))]  # fmt: skip
        closed = state | {"domain": {"lower": [0, 0], "upper": [1, 1], "periodic": [False, False]}}
        closed["walls"] = walls + [{"point": p, "outward_normal": n, "velocity": [0, 0]} for p, n in (([0, 0], [0, -1]), ([0, 1], [0, 1]))]
        rates = strict_json(self.succeed("evaluate", self.write("state.json", {k: v for k, v in closed.items() if k != "domain"})))
        for acceleration, rho in zip(rates["rates"][FORM]["acceleration"], rates["density"]):
            self.assertAlmostEqual(acceleration[0], -1.0 / rho, delta=0.5 / rho)  # walls along x close by interpolation
        self.assertEqual(len(rates["rates"]["work/voronoi"]["heating"]), 4)
        by_kernel = {k: v for k, v in closed.items() if k not in ("pair_weight", "domain")}
        by_kernel["particles"] = closed["particles"] | {"density": [1.0] * 4}
        left_out = strict_json(self.succeed("evaluate", self.write("kernel.json", by_kernel)))["left_out"]
        self.assertIn("take pair weight voronoi", left_out[FORM])


if __name__ == "__main__":
    unittest.main()
