# SPDX-License-Identifier: GPL-3.0-or-later
"""Pair weights of Voronoi cells, and what may stand behind walls: asked for in studies and states, reported, judged, refused."""

import sys

sys.dont_write_bytecode = True

import json
import math
import unittest

import program
from program import ProgramTest, strict_json

SLAB = {"id": "conduction/slab-dirichlet", "parameters": {"final_time": 0.02}}
HEAT = "conduction/brookshaw"
GAS = "momentum/p-rho2"
JITTER = {"id": "jittered", "amplitude": 0.3, "seeds": [1, 2, 3]}


def behind(walls, formulation=HEAT):
    return {"id": formulation, "walls": walls}


class WeightsAndWalls(ProgramTest):
    def results(self, cases, formulations, resolution, discretisation=None, **keys):
        document = {"schema": "sphverify-study/1", "name": "weights and walls", "cases": cases, "formulations": formulations,
                    "resolution": resolution, "measure": ["error", "conservation"], "discretisation": discretisation or {}, **keys}
        results = strict_json(self.succeed("study", self.write("study.json", document)))
        self.assertEqual(program.complaints("sphverify-results-1", results), [])
        return results

    def reasons(self, *arguments, **keys):
        results = self.results(*arguments, **keys)
        return {skipped["reason"] for skipped in results["skipped"]}, results

    def test_faces_of_cells_conduct_to_second_order_on_disorder_up_to_the_wall(self):
        for cases, resolution, most in ((SLAB, [25, 50, 100, 200], 5e-5), ("conduction/square", [8, 16, 32], 4e-4)):
            layout = JITTER | {"masses": "voronoi"}
            results = self.results(cases, HEAT, resolution, {"pair_weight": ["kernel", "voronoi"], "layout": layout})
            orders = {s["discretisation"]["pair_weight"]: o for s in results["series"] for o in s["orders"]
                      if (o["field"], o["region"], o["norm"]) == ("temperature", "all", "l2")}  # fmt: skip
            self.assertGreater(orders["voronoi"]["order"], 1.75)
            self.assertLess(orders["voronoi"]["order"], 2.25)
            last = [r for r in results["runs"] if r["resolution"] == resolution[-1]]
            errors = {weight: [r["errors"]["temperature"]["all"]["l2"] for r in last
                               if r["discretisation"]["pair_weight"] == weight] for weight in ("kernel", "voronoi")}  # fmt: skip
            self.assertLess(max(errors["voronoi"]), most)
            self.assertLess(10 * max(errors["voronoi"]), min(errors["kernel"]))
            for run in last:
                self.assertLess(abs(run["conservation"]["energy"]["pair_drift"]), 1e-12)

    def test_a_steady_slab_between_walls_is_exact_in_one_to_three_dimensions(self):
        for dimension, resolution in ((1, 20), (2, 10), (3, 6)):
            case = {"id": "conduction/slab-dirichlet", "parameters": {"modes": [], "dimension": dimension}}
            results = self.results(case, HEAT, resolution, {"pair_weight": "voronoi", "layout": JITTER | {"amplitude": 0.45}})
            for run in results["runs"]:
                self.assertEqual(run["status"], "ok")
                self.assertLess(run["errors"]["temperature"]["all"]["linf"], 1e-9)  # of integration in time
                for wall in run["wall_flux"]:
                    self.assertLess(abs(wall["error"]), 1e-8)

    def test_its_spectrum_is_real_and_negative_on_any_particles(self):
        results = self.results(["conduction/square", "conduction/slab-insulated"], [HEAT, behind("mirror")], 8,
                               {"pair_weight": ["kernel", "voronoi"], "layout": JITTER | {"amplitude": 0.45}},
                               measure=["error", "stability", "spectrum"])  # fmt: skip
        looked_at = 0
        for run in results["runs"]:
            looked_at += 1
            values = run["spectrum"]
            self.assertLess(max(abs(v[1]) for v in values), 1e-6 * max(abs(v[0]) for v in values))
            self.assertLess(max(v[0] for v in values), 1e-8 * max(abs(v[0]) for v in values))
        self.assertEqual(looked_at, 2 * 3 * 3)

    def test_density_and_masses_of_cells_are_independent_choices(self):
        results = self.results(SLAB, HEAT, [16, 32], {"pair_weight": ["kernel", "voronoi"], "density": ["given", "voronoi"],
                                                      "layout": ["lattice", JITTER | {"seeds": [1], "masses": "voronoi"}]})  # fmt: skip
        errors = {}
        for run in results["runs"]:
            d = run["discretisation"]
            key = d["pair_weight"], d["density"], json.dumps(d["layout"]), run["resolution"]
            errors[key] = run["errors"]["temperature"]["all"]["l2"]
            self.assertEqual("voronoi-cells" in run["scene"]["passes"], "voronoi" in (d["pair_weight"], d["density"]))
            self.assertEqual("neighbour-search" in run["scene"]["passes"], d["pair_weight"] == "kernel")
        self.assertEqual(len(errors), 16)
        path = self.write("results.json", results)
        for index, run in enumerate(results["runs"]):
            self.assertEqual(strict_json(self.succeed("repeat", path, str(index)))["errors"], run["errors"])
        # In two dimensions masses are others; what is read back has them.
        plain, of_cells = (self.results("conduction/square", HEAT, 8, {"layout": JITTER | {"seeds": [1]} | masses})
                           for masses in ({}, {"masses": "voronoi"}))  # fmt: skip
        self.assertNotEqual(plain["runs"][0]["errors"], of_cells["runs"][0]["errors"])
        again = strict_json(self.succeed("repeat", self.write("cells.json", of_cells), "0"))
        self.assertEqual(again["errors"], of_cells["runs"][0]["errors"])
        # On a lattice in one dimension all of them are the same numbers.
        for (weight, density, layout, level), error in errors.items():
            if layout != '"lattice"':
                continue
            same = errors[weight, "given", '"lattice"', level]
            self.assertTrue(math.isclose(error, same, rel_tol=1e-9), (weight, density, layout, level))

    def test_what_makes_no_sense_is_skipped_with_the_reason(self):
        reasons, _ = self.reasons([SLAB, "hydro/noh"], [HEAT, GAS], [8, 16],
                                  {"pair_weight": ["kernel", "voronoi"], "smoothing_ratio": [1.2, 1.5], "kernel": ["cubic-spline", "wendland-c2"],
                                   "face_weight": ["exact", "campbell"]}, smoothing_exponent=[0, 0.5], time_budget=0.01)  # fmt: skip
        no_length = ": Voronoi pair weights have no smoothing length: the first of a study stands for all"
        for reason in ("h/dx 1.5" + no_length, "kernel wendland-c2" + no_length, "exponent 0.5" + no_length,
                       "face weight campbell changes nothing beside Voronoi pair weights: walls have faces of cells"):  # fmt: skip
            self.assertIn(reason, reasons)
        reasons, _ = self.reasons(["hydro/uniform", {"id": "hydro/uniform", "parameters": {"boundary": "periodic"}}],
                                  [GAS, behind("mirror", GAS), behind("dummy", GAS)], 16,
                                  {"density": ["continuity", "summation", "normalised"], "pair_weight": ["kernel", "voronoi"]},
                                  time_budget=0.01)  # fmt: skip
        for reason in (
            "walls mirror change nothing where there are no walls",
            "Voronoi cells end at walls: nothing that stands behind them is seen",
            "normalised density divides by the kernel's part inside: with walls mirror take summation, which counts what is behind",
            "walls dummy take their masses from the density, which cannot be a sum over them: take given, continuity or voronoi",
        ):
            self.assertIn(reason, reasons)

    def test_gas_between_mirrors_stays_at_rest(self):
        for dimension, boundary in ((1, "pressure"), (1, "velocity"), (2, "velocity")):
            case = {"id": "hydro/uniform", "parameters": {"dimension": dimension, "boundary": boundary, "final_time": 0.3}}
            results = self.results(case, [GAS, behind("mirror", GAS), behind("dummy", GAS)], 16)
            worst = {run["walls"]: run["errors"]["velocity"]["all"]["linf"] for run in results["runs"]}
            self.assertLess(worst["mirror"], 1e-6)
            self.assertLess(worst["dummy"], 1e-6)
            self.assertGreater(worst["on"], 1e-3)
            for run in results["runs"]:
                self.assertLess(abs(run["conservation"]["energy"]["pair_drift"]), 1e-10)
            if boundary == "velocity":
                summed = self.results(case, behind("mirror", GAS), 16, {"density": "summation"})["runs"][0]
                self.assertLess(summed["errors"]["velocity"]["all"]["linf"], 1e-6)
                self.assertLess(summed["errors"]["density"]["all"]["linf"], 0.02)  # the lattice's own factor, at walls too

    def test_a_piston_is_as_good_with_images_and_its_budgets_add_up(self):
        case = {"id": "hydro/piston-velocity", "parameters": {"final_time": 0.1}}
        results = self.results(case, [GAS, behind("mirror", GAS), behind("dummy", GAS)], 40)
        errors = {run["walls"]: run["errors"]["velocity"]["all"]["l1"] for run in results["runs"]}
        for walls in ("mirror", "dummy"):
            self.assertLess(errors[walls], 1.1 * errors["on"])
        for run in results["runs"]:
            self.assertEqual(run["status"], "ok")
            energy = run["conservation"]["energy"]
            self.assertLess(abs(energy["pair_drift"]), 1e-10 * abs(energy["final"]))
            self.assertGreater(energy["exchanged"], 0.0)  # the piston does work
            self.assertLess(abs(energy["drift"]), 1e-3 * energy["exchanged"])
            momentum = run["conservation"]["momentum"]
            self.assertLess(max(abs(one) for one in momentum["pair_drift"]), 1e-10)

    def test_a_gas_that_conducts_heat_takes_them_too(self):
        case = {"id": "coupled/hot-wall", "parameters": {"final_time": 0.01}}
        forms = [{"id": GAS, "conduction": HEAT, "walls": walls} for walls in ("on", "mirror", "dummy")]
        results = self.results(case, forms, 20, {"pair_weight": ["kernel", "voronoi"], "integrator": "leapfrog"})
        self.assertEqual(len(results["runs"]), 4)
        plain = next(r for r in results["runs"] if r["walls"] == "on" and r["discretisation"]["pair_weight"] == "kernel")
        for run in results["runs"]:
            self.assertEqual(run["status"], "ok")
            self.assertLess(abs(run["conservation"]["energy"]["pair_drift"]), 1e-10)
            # A step that the conductances allow: nothing grows.
            error, bound = (r["errors"]["temperature"]["all"]["l2"] for r in (run, plain))
            self.assertLess(error, 1.5 * bound)

    def test_gates_and_tables_know_them(self):
        results = self.results(SLAB, [HEAT, behind("mirror"), behind("dummy")], [8, 16], {"pair_weight": ["kernel", "voronoi"]})
        path = self.write("results.json", results)
        gate = {"schema": "sphverify-gates/1", "gates": [
            {"name": "a", "select": {"walls": "mirror"}, "measure": "status", "equals": "ok", "runs": 2},
            {"name": "b", "select": {"discretisation": {"pair_weight": "voronoi"}}, "measure": "status", "equals": "ok", "runs": 2},
            {"name": "c", "select": {"formulation": {"id": HEAT, "walls": "dummy"}}, "measure": "status", "equals": "ok", "runs": 2},
        ]}  # fmt: skip
        self.succeed("gate", path, self.write("gates.json", gate))
        table = self.succeed("compare", path)
        for word in ("brookshaw (walls mirror)", "brookshaw (walls dummy)", "pair weight", "voronoi"):
            self.assertIn(word, " ".join(table.split()))
        for index, run in enumerate(results["runs"]):
            self.assertEqual(strict_json(self.succeed("repeat", path, str(index)))["errors"], run["errors"])

    def test_a_state_may_be_weighed_by_cells(self):
        state = {"schema": "sphverify-state/1", "dimension": 2, "pair_weight": "voronoi",
                 "particles": {"position": [[0.2, 0.3], [0.7, 0.2], [0.4, 0.8], [0.9, 0.9]], "mass": [1.0, 1.0, 1.0, 1.0],
                               "smoothing_length": 0.6, "density": "voronoi", "temperature": [0.2, 0.7, 0.4, 0.9],
                               "conductivity": [1.0, 1.0, 1.0, 1.0]}}  # fmt: skip
        walls = [{"point": p, "outward_normal": n, "temperature": p[0] if n[0] else None, "conductivity": 1.0}
                 for p, n in (([0, 0], [-1, 0]), ([1, 0], [1, 0]), ([0, 0], [0, -1]), ([0, 1], [0, 1]))]  # fmt: skip
        for wall in walls[2:]:
            del wall["temperature"], wall["conductivity"]
            wall["flux"] = [1.0, 0.0]  # along the wall: nothing crosses
        rates = strict_json(self.succeed("evaluate", self.write("state.json", state | {"walls": walls})))
        self.assertEqual(len(rates["rates"][HEAT]["heating"]), 4)
        for rate in rates["rates"][HEAT]["heating"]:
            self.assertLess(abs(rate), 1e-12)
        self.assertEqual(program.complaints("sphverify-state-1", state | {"walls": walls}), [])
        # Walls may be far away, and particles in one row: cells are as large as that.
        row = json.loads(json.dumps(state | {"walls": walls}))
        row["particles"]["position"] = [[x, 0.5] for x in (0.2, 0.4, 0.7, 0.9)]
        row["particles"]["temperature"] = [0.2, 0.4, 0.7, 0.9]
        row["walls"][3]["point"] = [0, 1e4]
        for rate in strict_json(self.succeed("evaluate", self.write("row.json", row)))["rates"][HEAT]["heating"]:
            self.assertLess(abs(rate), 1e-10)
        done = self.run_program("evaluate", self.write("open.json", state))
        self.assertEqual(done.returncode, 2)
        self.assertIn("unbounded Voronoi cell", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)

    def test_words_that_there_are_not_are_refused(self):
        for change, words in (
            ({"formulations": behind("ghosts")}, ("walls: found 'ghosts'", "mirror")),
            ({"discretisation": {"pair_weight": "cells"}}, ("pair_weight: found 'cells'", "voronoi")),
            ({"discretisation": {"layout": {"id": "lattice", "masses": "equal"}}}, ("masses: found 'equal'", "voronoi")),
            ({"discretisation": {"layout": {"id": "equal-mass", "masses": "voronoi"}}}, ("masses", "equal masses")),
            ({"discretisation": {"pair_weight": "voronoi", "face_weight": "campbell"}}, ("face_weight: found 'campbell'", "kernel's pair weights")),
        ):  # fmt: skip
            study = {"schema": "sphverify-study/1", "name": "x", "cases": SLAB, "formulations": HEAT, "resolution": [8, 16]} | change
            path = self.write("study.json", study)
            self.assert_user_error(self.run_program("study", path), f"{path}: ", "expected", *words)


if __name__ == "__main__":
    unittest.main()
