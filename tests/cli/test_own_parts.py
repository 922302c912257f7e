# SPDX-License-Identifier: GPL-3.0-or-later
"""A program with parts of its own (examples/own-parts): they are listed, run and compared like ours, at the same exactness."""

import sys

sys.dont_write_bytecode = True

import math
import os
import pathlib
import subprocess
import unittest

import program
from program import SOURCE_DIR, ProgramTest, strict_json

program.PROGRAM = os.path.abspath(os.environ["SPHVERIFY_WITH_OWN_PARTS"])
EXAMPLE = SOURCE_DIR / "examples" / "own-parts"


def flat(values):
    return [x for value in values for x in (value if isinstance(value, list) else [value])]


class OwnParts(ProgramTest):
    def study(self, **keys):
        document = {"schema": "sphverify-study/1", "name": "own parts", **keys}
        return strict_json(self.succeed("study", self.write("study.json", document)))

    def test_they_are_listed_and_described_beside_ours(self):
        for kind, ids in (("formulations", {"momentum/gdf", "work/gdf", "momentum/linear-gradient", "momentum/p-rho2"}),
                          ("cases", {"conduction/decaying-wave", "hydro/noh"}), ("kernels", {"lucy", "cubic-spline"}),
                          ("walls", {"nearest", "mirror", "dummy"})):  # fmt: skip
            listed = strict_json(self.succeed("list", kind, "--json"))[kind]
            self.assertLessEqual(ids, {one["id"] for one in listed})
        described = strict_json(self.succeed("describe", "momentum/linear-gradient", "--json"))
        self.assertEqual(described["passes"], ["matrix", "rate"])
        self.assertIn("made with sphverify", self.succeed("--version"))

    def test_a_misspelt_identifier_is_answered_with_the_nearest_of_all(self):
        done = self.run_program("describe", "momentum/gfd")
        self.assertEqual(done.returncode, 2)
        self.assertTrue(done.stderr.startswith("my-verify: "), done.stderr)
        self.assertIn("momentum/gdf", done.stderr)

    def test_results_name_the_program_and_its_added_parts(self):
        results = self.study(cases="conduction/decaying-wave", formulations="conduction/brookshaw", resolution=[10])
        self.assertEqual(results["context"]["program"], "my-verify")
        self.assertEqual(set(results["context"]["added"]), {"momentum/gdf", "work/gdf", "momentum/linear-gradient", "lucy", "nearest",
                                                            "conduction/geometric", "conduction/decaying-wave"})
        self.assertEqual(program.complaints("sphverify-results-1", results), [])

    def test_walls_of_its_own_stand_behind_every_form(self):
        results = self.study(cases="conduction/slab-dirichlet", resolution=[20, 40],
                             formulations=[{"id": form, "walls": walls} for form in ("conduction/brookshaw", "conduction/geometric")
                                           for walls in ("on", "mirror", "nearest")])  # fmt: skip
        self.assertEqual(program.complaints("sphverify-results-1", results), [])
        self.assertEqual({(r["status"], r["walls"]) for r in results["runs"]}, {("ok", w) for w in ("on", "mirror", "nearest")})
        errors = {(r["formulation"], r["walls"], r["resolution"]): r["errors"]["temperature"]["all"]["l2"] for r in results["runs"]}
        for error in errors.values():
            self.assertLess(error, 0.02)
        for run in results["runs"]:
            self.assertEqual("nearest" in run["scene"]["passes"], run["walls"] == "nearest")

    def test_the_study_of_the_example_runs_and_its_case_is_solved(self):
        results = strict_json(self.succeed("study", EXAMPLE / "study.json"))
        self.assertEqual({r["status"] for r in results["runs"]}, {"ok"})
        self.assertEqual({r["formulation"] for r in results["runs"]},
                         {"conduction/brookshaw", "momentum/p-rho2", "momentum/gdf", "momentum/linear-gradient"})
        self.assertEqual({r["discretisation"]["kernel"] for r in results["runs"]}, {"cubic-spline", "lucy"})
        # 1.5 dx: within 5% of the wave that is left, of which conduction took 96%.
        for run in results["runs"]:
            if run["case"] == "conduction/decaying-wave" and run["resolution"] == 200:
                error = run["errors"]["temperature"]["all"]
                left = math.exp(-(4 * math.pi) ** 2 * 0.02)
                self.assertAlmostEqual(error["scale"]["l2"], (2.0**2 + left**2 / 2) ** 0.5, 6)
                self.assertLess(error["l2"], 0.05 * left * 2 ** -0.5)

    def test_what_the_added_forms_say_to_conserve_is_conserved(self):
        results = self.study(cases="hydro/acoustic", formulations=["momentum/gdf"], resolution=[50],
                             measure=["conservation"])
        run = results["runs"][0]
        self.assertEqual(run["work"], "work/gdf")
        self.assertLess(abs(run["conservation"]["momentum"]["drift"][0]), 1e-14)
        self.assertLess(abs(run["conservation"]["energy"]["pair_drift"]), 1e-15 * run["conservation"]["energy"]["initial"])

    def test_a_form_with_a_matrix_of_its_own_is_exact_where_pressure_is_linear_to_the_walls(self):
        for dimension, resolution in ((1, 20), (2, 10), (3, 7)):
            for layout in ("lattice", {"id": "jittered", "amplitude": 0.2, "seed": 4}):
                results = self.study(cases={"id": "operator/polynomial", "parameters": {"degree": 1, "dimension": dimension}},
                                     formulations=["momentum/linear-gradient", "momentum/p-rho2"],
                                     discretisation={"layout": layout, "kernel": ["cubic-spline", "lucy"],
                                                     "smoothing_ratio": 1.4},
                                     resolution=[resolution], measure=["error"])
                for run in results["runs"]:
                    error = run["errors"]["acceleration"]["all"]
                    if run["formulation"] == "momentum/linear-gradient":
                        self.assertLess(error["linf"], 1e-11 * error["scale"]["linf"], (dimension, layout))
                    else:
                        self.assertGreater(error["linf"], 1e-3 * error["scale"]["linf"])

    def test_lucys_kernel_is_wendlands_c2_in_one_dimension(self):
        state = strict_json((SOURCE_DIR / "tests" / "data" / "operators-1d.json").read_text())[0]["state"]
        rates = {}
        for kernel in ("lucy", "wendland-c2"):
            rates[kernel] = strict_json(self.succeed("evaluate", self.write("state.json", {**state, "kernel": kernel})))
        for scheme, outputs in rates["wendland-c2"]["rates"].items():
            if "reason" in outputs:  # some particle has too few partners for it
                self.assertIn(scheme.removesuffix("-no-walls"), ("conduction/gmls", "conduction/corrected-flux"))
                continue
            for key, values in outputs.items():
                found, expected = flat(rates["lucy"]["rates"][scheme][key]), flat(values)
                largest = max(map(abs, expected)) or 1.0
                for f, e in zip(found, expected):
                    self.assertLess(abs(f - e), 1e-13 * largest, scheme)
        self.assertIn("momentum/gdf", rates["lucy"]["rates"])

    def test_sums_of_the_added_form_are_those_of_its_equation(self):
        state = strict_json((SOURCE_DIR / "tests" / "data" / "operators-2d.json").read_text())[0]["state"]
        state["kernel"] = "lucy"
        p = state["particles"]
        found = strict_json(self.succeed("evaluate", self.write("state.json", {**state, "walls": []})))
        density = found["density"]
        h, n = p["smoothing_length"], len(p["mass"])
        for i in (0, n // 2, n - 1):
            a = [0.0, 0.0]
            for j in range(n):
                r = [x - y for x, y in zip(p["position"][i], p["position"][j])]
                q = (r[0] ** 2 + r[1] ** 2) ** 0.5 / h
                if j == i or q >= 2.0:
                    continue
                slope = 5.0 / (4.0 * 3.141592653589793) / h ** 4 * -3.0 * (1.0 - 0.5 * q) ** 2
                strength = -p["mass"][j] * (p["pressure"][i] + p["pressure"][j]) / (density[i] * density[j]) * slope
                a = [a[k] + strength * r[k] for k in range(2)]
            for x, y in zip(found["rates"]["momentum/gdf"]["acceleration"][i], a):
                self.assertAlmostEqual(x, y, 10)


class Claims(ProgramTest):
    def test_added_forms_keep_their_claims_with_every_kernel(self):
        document = strict_json(self.succeed("claims", "--json", "momentum/gdf", "work/gdf", "momentum/linear-gradient",
                                             "conduction/geometric"))
        claims = {(id, one["claim"]): one for id, all in document["formulations"].items() for one in all}
        self.assertTrue(all(one["holds"] for one in claims.values() if one["claimed"]))
        self.assertTrue(claims["momentum/gdf", "pairs conserve energy together with work/gdf"]["holds"])
        self.assertTrue(claims["momentum/linear-gradient", "linear fields: the exact derivative on a lattice"]["holds"])
        self.assertFalse(claims["momentum/linear-gradient", "pairs conserve momentum"]["holds"])
        # A mean that we do not use is as good as ours.
        self.assertTrue(claims["conduction/geometric", "pairs conduct by the geometric mean"]["holds"])


class WhatTheCompilerSays(unittest.TestCase):
    def complaint(self, scheme):
        text = f'#include "formulations/scheme_operator.hpp"\nusing namespace sphverify;\n{scheme}\nSchemePart part() {{ return scheme_part<Mine>(); }}\n'
        done = subprocess.run(["c++", "-std=c++20", "-fsyntax-only", "-I", SOURCE_DIR, "-isystem", "/usr/include/eigen3", "-x",
                               "c++", "-"], input=text, capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        return done.stderr

    def test_a_scheme_without_info_or_with_passes_that_do_not_fit_is_told_what_a_scheme_has(self):
        for scheme, word in (("struct Mine {};", "HasSchemeInfo"),
                             ('struct Mine { static constexpr SchemeInfo info{.id = "a/b", .rate = Rate::acceleration,'
                              ' .first_passes = {{.name = "one", .writes = Field::pass_number}}}; };', "HasItsFirstPasses"),
                             ('struct Mine { static constexpr SchemeInfo info{.id = "a/b", .rate = Rate::acceleration,'
                              ' .reads = {Field::pass_number}}; };', "ReadsWhatIsWritten")):
            said = self.complaint(scheme)
            self.assertIn("a scheme has a constexpr `info`", said)
            self.assertIn(word, said)


if __name__ == "__main__":
    unittest.main()
