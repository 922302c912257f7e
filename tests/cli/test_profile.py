# SPDX-License-Identifier: GPL-3.0-or-later
"""Every error of a results document can be recomputed from the profile beside it, by the definition alone."""

import sys

sys.dont_write_bytecode = True

import math
import unittest

from program import ProgramTest, small_study


def norms(values, weights):
    """l1, l2 and linf of numbers, with weights that are made to sum to 1."""
    total = math.fsum(weights)
    return {
        "l1": math.fsum(w / total * abs(v) for w, v in zip(weights, values)),
        "l2": math.sqrt(math.fsum(w / total * v * v for w, v in zip(weights, values))),
        "linf": max(map(abs, values)),
    }


def length(vector):
    return math.sqrt(math.fsum(c * c for c in vector))


class Profiles(ProgramTest):
    def check(self, run):
        self.assertEqual(run["status"], "ok", run["reason"])
        profile = run["profile"]
        self.assertEqual(len(profile["weight"]), run["particles"])
        self.assertEqual(set(profile["computed"]), set(run["errors"]))
        self.assertEqual(set(profile["exact"]), set(run["errors"]))
        for field, by_region in run["errors"].items():
            self.assertEqual(set(by_region), set(profile["regions"]))
            for region, stored in by_region.items():
                particles = profile["regions"][region]
                self.assertTrue(particles)
                computed = [profile["computed"][field][i] for i in particles]
                exact = [profile["exact"][field][i] for i in particles]
                weights = [profile["weight"][i] for i in particles]
                differences = [length(c - e for c, e in zip(x, y)) for x, y in zip(computed, exact)]
                for norm, value in norms(differences, weights).items():
                    with self.subTest(case=run["case"], field=field, region=region, norm=norm):
                        self.assertAlmostEqual(stored[norm], value, delta=1e-12 * value)
                for norm, value in norms(list(map(length, exact)), weights).items():
                    with self.subTest(case=run["case"], field=field, region=region, norm=norm, of="scale"):
                        self.assertAlmostEqual(stored["scale"][norm], value, delta=1e-12 * value)

    def profiles_of(self, fields, **changes):
        study = small_study(resolution=[20], measure=["error", "profile"], **changes)
        results = self.study(study)
        self.assert_valid("sphverify-results-1", results)
        self.assertTrue(results["runs"])
        for run in results["runs"]:
            self.check(run)
        self.assertEqual({tuple(sorted(run["errors"])) for run in results["runs"]}, fields)

    def test_rates_at_an_instant(self):
        jitter = {"density": "summation", "layout": {"id": "jittered", "amplitude": 0.1, "seed": 1}}
        self.profiles_of(
            {("heating",), ("flux", "heating"), ("acceleration",)},
            cases=["operator/sine", {"id": "operator/sine", "parameters": {"dimension": 2}}],
            formulations=["conduction/brookshaw", "conduction/lucy-flux", "momentum/p-rho2", "work/total-energy"],
            discretisation=jitter,
        )  # fmt: skip

    def test_conduction(self):
        self.profiles_of(
            {("temperature",), ("flux", "temperature")}, formulations=["conduction/brookshaw", "conduction/lucy-flux"]
        )

    def test_a_gas(self):
        gas = {"id": "momentum/p-rho2", "conduction": "conduction/brookshaw"}
        names = ("density", "internal_energy", "pressure", "velocity")
        self.profiles_of({names}, cases=["hydro/acoustic", "hydro/piston-velocity"], formulations=["momentum/p-rho2"],
                         discretisation=None)  # fmt: skip
        self.profiles_of({tuple(sorted((*names, "temperature")))}, cases=["coupled/manufactured"], formulations=[gas],
                         discretisation=None)  # fmt: skip


if __name__ == "__main__":
    unittest.main(verbosity=2)
