# SPDX-License-Identifier: GPL-3.0-or-later
"""Forms of heat conduction beside the report's: what each is good for, what it does not tell, and what is refused."""

import sys

sys.dont_write_bytecode = True

import math
import unittest

import program
from program import ProgramTest, strict_json

JITTER = {"id": "jittered", "amplitude": 0.3, "seeds": [1, 2, 3]}
SLAB = {"id": "conduction/slab-dirichlet", "parameters": {"final_time": 0.02}}
GMLS = "conduction/gmls"


class Comparators(ProgramTest):
    def results(self, cases, formulations, resolution, discretisation=None, **keys):
        document = {"schema": "sphverify-study/1", "name": "comparators", "cases": cases, "formulations": formulations,
                    "resolution": resolution, "measure": ["error", "conservation"], "discretisation": discretisation or {}, **keys}
        results = strict_json(self.succeed("study", self.write("study.json", document)))
        self.assertEqual(program.complaints("sphverify-results-1", results), [])
        return results

    def errors(self, results, resolution, norm="l2"):
        """Largest over seeds, by formulation and pair weight."""
        worst = {}
        for run in results["runs"]:
            if run["resolution"] != resolution:
                continue
            self.assertEqual(run["status"], "ok", run["reason"])
            key = run["label"].removeprefix("conduction/"), run["discretisation"]["pair_weight"]
            worst[key] = max(worst.get(key, 0.0), run["errors"]["temperature"]["all"][norm])
        return worst

    def test_least_squares_are_of_second_order_on_disorder_between_walls_of_either_kind(self):
        for case, resolution, most in ((SLAB, [25, 50, 100], 3e-4), ("conduction/slab-insulated", [25, 50, 100], 1e-4),
                                       ({"id": "conduction/square", "parameters": {"walls": "mixed"}}, [8, 16, 24], 2e-3)):  # fmt: skip
            results = self.results(case, [GMLS, {"id": GMLS, "walls": "mirror"}], resolution, {"layout": JITTER})
            coarse, fine = self.errors(results, resolution[0]), self.errors(results, resolution[-1])
            for key, error in fine.items():
                self.assertLess(error, most, (case, key))
                order = math.log(coarse[key] / error) / math.log(resolution[-1] / resolution[0])
                self.assertGreater(order, 1.4, (case, key))

    def test_the_harmonic_mean_on_faces_of_cells_carries_flux_across_jumps(self):
        case = {"id": "extreme/conductivity-contrast", "parameters": {"contrast": 1e6}}
        results = self.results(case, ["conduction/brookshaw", "conduction/cleary-monaghan"], [50, 100],
                               {"pair_weight": ["kernel", "voronoi"], "layout": JITTER})  # fmt: skip
        errors = self.errors(results, 100)
        self.assertLess(10 * errors["cleary-monaghan", "voronoi"], errors["brookshaw", "voronoi"])
        self.assertLess(3 * errors["brookshaw", "voronoi"], errors["brookshaw", "kernel"])
        for run in results["runs"]:
            self.assertLess(abs(run["conservation"]["energy"]["pair_drift"]), 1e-12)

    def test_the_harmonic_mean_starts_no_front_into_what_does_not_conduct(self):
        results = self.results({"id": "conduction/marshak"}, ["conduction/brookshaw", "conduction/cleary-monaghan"], [50])
        found = {run["formulation"]: run for run in results["runs"]}
        self.assertLess(found["conduction/brookshaw"]["errors"]["temperature"]["all"]["l2"], 0.03)
        stuck = found["conduction/cleary-monaghan"]
        self.assertEqual(stuck["status"], "ok")
        self.assertEqual(stuck["conservation"]["energy"]["final"], stuck["conservation"]["energy"]["initial"])

    def test_gamma_halves_the_error_beside_insulated_walls_on_a_lattice(self):
        results = self.results({"id": "conduction/square", "parameters": {"walls": "mixed"}},
                               ["conduction/brookshaw", "conduction/gamma-brookshaw"], [24])  # fmt: skip
        errors = self.errors(results, 24)
        self.assertLess(1.5 * errors["gamma-brookshaw", "kernel"], errors["brookshaw", "kernel"])
        passes = {r["formulation"]: r["scene"]["pass_counts"] for r in results["runs"]}
        self.assertEqual(passes["conduction/gamma-brookshaw"]["gamma"], 1)  # on particles at rest

    def test_what_crosses_a_wall_is_not_made_up(self):
        forms = ["conduction/gamma-brookshaw", GMLS, "conduction/corrected-flux"]
        formulations = [*forms, *({"id": form, "walls": "dummy"} for form in forms), "conduction/brookshaw"]
        results = self.results([SLAB, "conduction/slab-insulated", "conduction/slab-flux"], formulations, [30],
                               {"layout": JITTER | {"seeds": [1]}}, measure=["error", "conservation", "history", "second-law"])
        for run in results["runs"]:
            energy, flux, law = run["conservation"]["energy"], run["wall_flux"], run["second_law"]
            if run["formulation"] == "conduction/brookshaw":
                self.assertEqual(len(flux), 2)
                self.assertIsNotNone(energy["exchanged"])
                continue
            self.assertEqual(flux, [])
            self.assertIsNone(energy["wall_budget_defect"])
            if run["case"] != SLAB["id"]:  # walls tell: insulated, or a flux of 1 for 0.05
                self.assertAlmostEqual(energy["exchanged"], 0.05 if run["case"] == "conduction/slab-flux" else 0.0, 12)
                self.assertGreater(abs(energy["pair_drift"]), 1e-8)  # they conserve nothing
                self.assertEqual(law["smallest_entropy_production"] is None, run["case"] == "conduction/slab-flux", run["label"])
            else:
                self.assertEqual((energy["exchanged"], energy["drift"], energy["pair_drift"]), (None, None, None))
                self.assertEqual(set(run["history"]["exchanged"]), {None})
                self.assertIsNone(law["smallest_entropy_production"])
                self.assertIn("what crosses the walls", law["remark"])

    def test_corrected_gradients_are_exact_beside_walls_with_any_face_weight(self):
        for dimension in (1, 2):
            case = {"id": "operator/polynomial", "parameters": {"degree": 1, "dimension": dimension}}
            results = self.results(case, "conduction/corrected-flux", [16],
                                   {"face_weight": ["exact", "balanced"], "smoothing_ratio": [1.0, 1.2], "closure": "one-sided"}, measure="error")  # fmt: skip
            for run in results["runs"]:
                self.assertEqual(run["status"], "ok", run["reason"])
                self.assertLess(run["errors"]["heating"]["all"]["linf"], 1e-10)

    def test_every_wall_has_its_flux_though_no_particle_is_near(self):
        layout = {"id": "random", "seeds": list(range(1, 21))}
        results = self.results({"id": "conduction/slab-dirichlet"}, "conduction/brookshaw", [20],
                               {"layout": layout, "pair_weight": ["kernel", "voronoi"]})  # fmt: skip
        for run in results["runs"]:
            self.assertEqual(len(run["wall_flux"]), 2)
            self.assertAlmostEqual(run["wall_flux"][0]["exact"], -2.9734497, 6)
        alone = [r["wall_flux"][0]["error"] for r in results["runs"] if r["wall_flux"][0]["measured"] == 0.0]
        self.assertTrue(alone)  # on some nothing is within reach of the first wall

    def test_runs_of_rates_that_all_fail_are_still_of_rates(self):
        results = self.results("operator/sine", [GMLS, "conduction/brookshaw"], [20],
                               {"layout": {"id": "random", "seed": 1}, "smoothing_ratio": 0.8}, measure="error")  # fmt: skip
        self.assertEqual({run["status"] for run in results["runs"]}, {"ok", "invalid"})
        self.assertEqual({order["field"] for series in results["series"] for order in series["orders"]}, {"heating"})

    def test_masses_of_cells_are_a_layouts_own_on_a_line(self):
        layout = [{"id": "random", "seed": 1}, {"id": "random", "seed": 1, "masses": "voronoi"}]
        results = self.results(SLAB, "conduction/brookshaw", [20], {"layout": layout})
        self.assertEqual(len(results["runs"]), 1)
        self.assertEqual({s["reason"] for s in results["skipped"]}, {"Voronoi masses are a layout's own in one dimension"})

    def test_particles_with_too_few_partners_are_named(self):
        layout = {"id": "random", "seed": 1}
        results = self.results(SLAB, [GMLS, "conduction/brookshaw"], [40], {"layout": layout, "smoothing_ratio": 0.8})
        found = {run["formulation"]: run for run in results["runs"]}
        self.assertEqual(found[GMLS]["status"], "invalid")
        self.assertRegex(found[GMLS]["reason"], r"^particle \d+: too few partners within its support for a quadratic: take a larger h/dx$")

    def test_a_gas_that_loses_partners_on_its_way_says_when(self):
        """Without walls the gas runs away from the ends, where the outermost particle is left with one partner."""
        results = self.results("coupled/manufactured", [{"id": "momentum/p-rho2", "conduction": GMLS, "walls": "off"}], [25],
                               {"density": "summation"}, time_budget=20)  # fmt: skip
        (run,) = results["runs"]
        self.assertEqual(run["status"], "unstable")
        self.assertRegex(run["reason"], r"^at t = 0\.\d+ particle \d+: too few partners within its support for a quadratic: take a larger h/dx")

    def test_weights_of_its_own_stand_beside_no_others(self):
        results = self.results(SLAB, [GMLS, "conduction/gamma-brookshaw", "conduction/brookshaw"], [20],
                               {"pair_weight": ["kernel", "voronoi"], "face_weight": ["exact", "balanced"]})  # fmt: skip
        reasons = {s["reason"] for s in results["skipped"]}
        self.assertIn("pair weight voronoi: conduction/gmls brings pair weights of its own along", reasons)
        self.assertIn("pair weight voronoi: conduction/gamma-brookshaw reads the kernel's value, which Voronoi pair weights do not have", reasons)
        self.assertIn("face weight balanced changes nothing in conduction/gmls, which weighs foot points by least squares", reasons)
        self.assertEqual(sum(run["formulation"] == GMLS for run in results["runs"]), 1)

    def test_every_form_heats_a_gas_that_moves(self):
        forms = ["brookshaw", "cleary-monaghan", "gamma-brookshaw", "gmls", "corrected-flux"]
        results = self.results("coupled/hot-wall", [{"id": "momentum/p-rho2", "conduction": "conduction/" + f} for f in forms], [25],
                               {"density": "normalised", "closure": "one-sided"})  # fmt: skip
        for run in results["runs"]:
            self.assertEqual(run["status"], "ok", run["reason"])
            self.assertLess(run["errors"]["temperature"]["all"]["l2"], 0.03, run["label"])
            is_known = run["conduction"] in ("conduction/brookshaw", "conduction/cleary-monaghan")
            self.assertEqual(run["conservation"]["energy"]["exchanged"] is not None, is_known, run["label"])
            self.assertEqual("quadratic-weights" in run["scene"]["passes"], run["conduction"] == GMLS)

    def test_random_places_are_a_layout(self):
        layout = {"id": "random", "seeds": [1, 2], "masses": "voronoi"}
        results = self.results("conduction/square", "conduction/brookshaw", [8, 16], {"pair_weight": "voronoi", "layout": layout})
        errors = {(r["resolution"], r["discretisation"]["layout"]["seed"]): r["errors"]["temperature"]["all"]["l2"] for r in results["runs"]}
        self.assertEqual(len(errors), 4)
        self.assertNotEqual(errors[8, 1], errors[8, 2])
        self.assertLess(max(errors[16, 1], errors[16, 2]), 5e-3)
        line = self.results(SLAB, "conduction/brookshaw", [30], {"pair_weight": "voronoi", "layout": layout | {"seeds": [3]}},
                            measure=["error", "profile"])  # fmt: skip
        places = [x[0] for x in line["runs"][0]["profile"]["position"]]
        self.assertEqual(places, sorted(places))
        gaps = [b - a for a, b in zip(places, places[1:])]
        self.assertGreater(max(gaps), 3 * 1 / 30 * 0.7)  # no lattice
        bad = {"schema": "sphverify-study/1", "name": "bad", "cases": "conduction/square", "formulations": "conduction/brookshaw",
               "resolution": 8, "discretisation": {"layout": "random"}}  # fmt: skip
        done = self.run_program("study", self.write("bad.json", bad))
        self.assertEqual(done.returncode, 2)
        self.assertIn('{"id": "random", "seed": ...}', done.stderr)


if __name__ == "__main__":
    unittest.main()
