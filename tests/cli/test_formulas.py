# SPDX-License-Identifier: GPL-3.0-or-later
"""What a formula may use gives the numbers that it says: schemes of tests/formulas beside ours, and beside sums in Python."""

import sys

sys.dont_write_bytecode = True

import math
import os
import unittest

import program
from program import SOURCE_DIR, ProgramTest, strict_json

program.PROGRAM = os.path.abspath(os.environ["SPHVERIFY_WITH_FORMULAS"])


KERNELS = ("cubic-spline", "quintic-spline", "wendland-c2", "wendland-c4", "wendland-c6")


def flat(values):
    return [x for value in values for x in (value if isinstance(value, list) else [value])]


class Pairs:
    """The particles of a state without walls, with the cubic spline."""

    sigma = {1: 2 / 3, 2: 10 / (7 * math.pi), 3: 1 / math.pi}

    def __init__(self, state, density):
        self.p, self.rho = state["particles"], density
        self.dim, self.h = state["dimension"], state["particles"]["smoothing_length"]
        self.n = len(density)

    def kernel(self, r):
        q = r / self.h
        w = 1 - 1.5 * q**2 + 0.75 * q**3 if q < 1 else 0.25 * (2 - q) ** 3 if q < 2 else 0.0
        return self.sigma[self.dim] / self.h**self.dim * w

    def slope(self, r):
        q = r / self.h
        w = -3 + 2.25 * q if q < 1 else -0.75 * (2 - q) ** 2 / q if q < 2 else 0.0
        return self.sigma[self.dim] / self.h ** (self.dim + 2) * w

    def neighbours(self, i):
        for j in range(self.n):
            r = [x - y for x, y in zip(self.p["position"][i], self.p["position"][j])]
            length = math.sqrt(sum(x * x for x in r))
            if j != i and length < 2 * self.h:
                yield j, r, length


class Formulas(ProgramTest):
    def states(self):
        for dimension in (1, 2, 3):
            for reference in strict_json((SOURCE_DIR / "tests" / "data" / f"operators-{dimension}d.json").read_text()):
                if "velocity" in reference["state"]["particles"]:
                    yield reference["state"]

    def evaluate(self, state):
        return strict_json(self.succeed("evaluate", self.write("state.json", state)))

    def assert_near(self, found, expected, tolerance, what):
        found, expected = flat(found), flat(expected)
        self.assertEqual(len(found), len(expected))
        largest = max(map(abs, expected))
        self.assertGreater(largest, 0.0)
        self.assertLess(max(abs(f - e) for f, e in zip(found, expected)), tolerance * largest, what)

    def test_forms_in_passes_have_the_rates_of_those_in_one_with_every_kernel(self):
        for state in self.states():
            for kernel in KERNELS:
                rates = self.evaluate({**state, "kernel": kernel})["rates"]
                for end in ("", "-no-walls"):
                    for ours, theirs, key in (("momentum/p-rho2", "momentum/by-passes", "acceleration"),
                                              ("work/internal-energy", "work/by-passes", "heating")):
                        self.assert_near(rates[theirs + end][key], rates[ours + end][key], 1e-13, (theirs, kernel))

    def test_they_move_a_gas_as_those_in_one_though_both_write_the_same_fields(self):
        # Uniform smoothing lengths take loops made for one form, own ones the general loop.
        for smoothing in ("uniform", "adaptive"):
            results = strict_json(self.succeed("study", self.write("study.json", {
                "schema": "sphverify-study/1", "name": "passes", "cases": ["hydro/acoustic", "hydro/piston-velocity"],
                "formulations": ["momentum/p-rho2", "momentum/by-passes"], "resolution": [30],
                "discretisation": {"smoothing": smoothing, "density": "continuity"},
                "measure": ["error", "conservation"]})))
            runs = {(r["case"], r["formulation"]): r for r in results["runs"]}
            self.assertEqual(len(runs), 4)
            for case in ("hydro/acoustic", "hydro/piston-velocity"):
                ours, theirs = runs[case, "momentum/p-rho2"], runs[case, "momentum/by-passes"]
                self.assertEqual(theirs["status"], "ok", theirs["reason"])
                self.assertEqual(theirs["work"], "work/by-passes")
                for field in ("velocity", "density"):
                    self.assertAlmostEqual(theirs["errors"][field]["all"]["l2"] / ours["errors"][field]["all"]["l2"], 1.0, 6)
                self.assertAlmostEqual(theirs["conservation"]["energy"]["final"], ours["conservation"]["energy"]["final"], 9)

    def test_a_pass_over_the_kernel_s_own_value_is_its_dense_sum(self):
        for state in self.states():
            document = self.evaluate({**state, "kernel": "cubic-spline"})
            pairs = Pairs(state, document["density"])
            p, rho = pairs.p, pairs.rho
            volume = [m / r for m, r in zip(p["mass"], rho)]
            smoothed = []
            for i in range(pairs.n):
                weight, sum = volume[i] * pairs.kernel(0.0), volume[i] * pairs.kernel(0.0) * p["pressure"][i]
                for j, _, r in pairs.neighbours(i):
                    weight += volume[j] * pairs.kernel(r)
                    sum += volume[j] * pairs.kernel(r) * p["pressure"][j]
                smoothed.append(sum / weight)
            expected = []
            for i in range(pairs.n):
                a = [0.0] * pairs.dim
                for j, r_ij, r in pairs.neighbours(i):
                    strength = -p["mass"][j] * (smoothed[i] + smoothed[j]) / (rho[i] * rho[j]) * pairs.slope(r)
                    a = [x + strength * y for x, y in zip(a, r_ij)]
                expected.append(a)
            self.assert_near(document["rates"]["momentum/smoothed-pressure"]["acceleration"], expected, 1e-12, pairs.dim)

    def test_they_keep_their_claims(self):
        for scheme in ("momentum/by-passes", "work/by-passes", "momentum/smoothed-pressure"):
            self.succeed("claims", scheme)

    def test_every_operation_is_what_it_says(self):
        for state in self.states():
            for key in ("temperature", "conductivity"):  # where some are alike < is not <=
                state["particles"][key][::3] = [state["particles"][key][0]] * len(state["particles"][key][::3])
            document = self.evaluate({**state, "kernel": "cubic-spline"})
            pairs = Pairs(state, document["density"])
            p, rho = pairs.p, pairs.rho
            expected = []
            for i in range(pairs.n):
                total = 0.0
                for j, r_ij, r in pairs.neighbours(i):
                    T, U, K, L = (p[key][k] for key, k in (("temperature", i), ("temperature", j), ("conductivity", i),
                                                           ("conductivity", j)))
                    R, S = rho[i], rho[j]
                    a = math.exp(-T) + math.log(U) + K**U + L ** (1 / 3) + math.tanh(T - U) + abs(T - U)
                    b = ((2 * T if T < U else 3) + (1 if T <= U else L) + (K if K > L else 0.5) + (0.25 if K >= L else U)
                         + min(T, L) + max(K, U) + (T if T == U else 2) + (T if T != U else 3))
                    c = (math.sqrt(R) + R**1.5 + S ** (1 / 3) + math.log(S) + math.exp(-R) + 2 * R - (R - S) + max(R, S)
                         - min(R, S) + R / S + 1 / R + (T if R < S else 2) + (R + S) * T + (T - S) + (T if R <= S else 2) + (T if R > S else 3)
                         + (T if R >= S else 4) + (T if R == S else 5) + (T if R != S else 6) + (T if R > 1 else 7)
                         + abs(R) + math.tanh(S) + max(R, 1) + min(S, T) + 2**R + (R if T < U else S))
                    v = [-x + 2 * y - y / 3 + x * U for x, y in zip(p["velocity"][i], p["velocity"][j])]
                    gradient = [pairs.slope(r) * x for x in r_ij]
                    dot = lambda x, y: sum(s * t for s, t in zip(x, y))
                    d = dot(v, r_ij) + dot(v, v) + pairs.h
                    g = dot(gradient, gradient)
                    e = (dot(r_ij, v) * dot(gradient, v) + 2 * dot(r_ij, gradient) + dot(r_ij, v) * g
                         + 2 * dot(r_ij, gradient) - dot(r_ij, gradient) + 4 * dot(gradient, v) + g + dot(r_ij, gradient))
                    total += p["mass"][j] * ((a + b + c + d) * pairs.kernel(r) + e + dot(gradient, v)
                                             + r * pairs.slope(r))
                expected.append(total)
            self.assert_near(document["rates"]["conduction/operations"]["heating"], expected, 1e-12, pairs.dim)


if __name__ == "__main__":
    unittest.main()
