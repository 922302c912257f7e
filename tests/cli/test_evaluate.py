# SPDX-License-Identifier: GPL-3.0-or-later
"""`sphverify evaluate` reproduces the prototype's rates on all reference states."""

import sys

sys.dont_write_bytecode = True

import json
import unittest

from program import SOURCE_DIR, ProgramTest, strict_json

TOLERANCE = 1e-10  # relative to the largest rate


def flat(values):
    return [x for value in values for x in (value if isinstance(value, list) else [value])]


# Left out beside weights of the kernel.
OF_CELLS = {form + walls for form in ("momentum/voronoi", "work/voronoi") for walls in ("", "-no-walls")}


class ReferenceStates(ProgramTest):
    def assert_same_numbers(self, found, expected, what):
        found, expected = flat(found), flat(expected)
        self.assertEqual(len(found), len(expected), what)
        largest = max(map(abs, expected)) or 1.0
        worst = max(abs(f - e) for f, e in zip(found, expected)) / largest
        self.assertLessEqual(worst, TOLERANCE, what)

    def assert_reproduced(self, rates, expected):
        self.assert_same_numbers(rates["density"], expected["density"], "density")
        self.assertEqual(len(rates["walls"]), len(expected["walls"]))
        for w, wall in enumerate(expected["walls"]):
            for key, values in wall.items():
                self.assert_same_numbers(rates["walls"][w][key], values, f"walls[{w}].{key}")
        for scheme, outputs in expected["rates"].items():
            for key, values in outputs.items():
                self.assert_same_numbers(rates["rates"][scheme][key], values, f"{scheme}: {key}")

    def check_dimension(self, dimension, count):
        path = SOURCE_DIR / "tests" / "data" / f"operators-{dimension}d.json"
        references = strict_json(path.read_text())
        self.assertEqual(len(references), count)
        for number, reference in enumerate(references):
            with self.subTest(state=number):
                state = self.write("state.json", reference["state"])
                rates = strict_json(self.succeed("evaluate", state))
                self.assertEqual(rates["schema"], "sphverify-rates/1")
                self.assert_reproduced(rates, reference["expected"])

    def test_every_rate_in_1d_matches_the_prototype(self):
        self.check_dimension(1, 4)

    def test_every_rate_in_2d_matches_the_prototype(self):
        self.check_dimension(2, 2)

    def test_every_rate_in_3d_matches_the_prototype(self):
        self.check_dimension(3, 2)


class InputAndOutput(ProgramTest):
    def setUp(self):
        super().setUp()
        path = SOURCE_DIR / "tests" / "data" / "operators-1d.json"
        self.state = strict_json(path.read_text())[0]["state"]
        self.path = self.write("state.json", self.state)
        self.expected = self.succeed("evaluate", self.path)

    def test_a_state_on_standard_input_gives_the_same_rates(self):
        self.assertEqual(self.succeed("evaluate", "-", text=json.dumps(self.state)), self.expected)

    def test_output_option_writes_the_same_rates_to_a_file_and_nothing_to_standard_output(self):
        for option in ("-o", "--output"):
            with self.subTest(option=option):
                target = self.folder / f"rates{option}.json"
                self.assertEqual(self.succeed("evaluate", self.path, option, target), "")
                self.assertEqual(target.read_text(), self.expected)

    def test_output_replaces_an_older_file_and_leaves_no_other_behind(self):
        target = self.write("rates.json", "old")
        before = sorted(self.folder.iterdir())
        self.succeed("evaluate", self.path, "-o", target)
        self.assertEqual(target.read_text(), self.expected)
        self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_a_scheme_without_the_fields_that_it_reads_is_left_out_with_the_reason(self):
        del self.state["particles"]["pressure"]
        document = strict_json(self.succeed("evaluate", "-", text=json.dumps(self.state)))
        rates = document["rates"]
        self.assertTrue(rates)
        self.assertIn("pressure", document["left_out"]["momentum/p-rho2"])
        self.assertEqual(set(rates) & set(document["left_out"]), set())
        self.assertEqual((set(rates) | set(document["left_out"])) - OF_CELLS, set(strict_json(self.expected)["rates"]))
        self.assertTrue(all(scheme.startswith("conduction/") for scheme in rates), list(rates))

    def test_walls_that_do_not_close_are_said_and_where(self):
        self.assertIsNone(strict_json(self.expected)["open_towards"])
        del self.state["walls"][1]
        path = self.write("open.json", self.state)
        result = self.run_program("evaluate", path)
        self.assertEqual(result.returncode, 0)
        self.assertEqual(strict_json(result.stdout)["open_towards"], [1.0])
        self.assert_valid("sphverify-rates-1", strict_json(result.stdout))
        line = f"{path}: walls: they do not close: nothing bounds the particles towards [1.0]\n"
        self.assertEqual(result.stderr, line)

    def test_smoothing_lengths_that_make_no_sense_are_remarked(self):
        self.assertEqual(strict_json(self.expected)["remarks"], [])
        count = len(self.state["particles"]["position"])
        for h, said in ((1e-9, f"{count} of {count} particles have no other within their support, 2h = 2e-09 m"),
                        (1e9, "the support, 2h = 2e+09 m, is wider than all particles together")):  # fmt: skip
            self.state["particles"]["smoothing_length"] = h
            path = self.write("absurd.json", self.state)
            result = self.run_program("evaluate", path)
            self.assertEqual(result.returncode, 0)
            self.assert_valid("sphverify-rates-1", strict_json(result.stdout))
            self.assertEqual(len(strict_json(result.stdout)["remarks"]), 1)
            self.assertIn(said, strict_json(result.stdout)["remarks"][0])
            self.assertTrue(result.stderr.startswith(f"{path}: particles.smoothing_length: {said}"), result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1)

    def test_rates_that_are_no_numbers_are_null_with_a_reason(self):
        self.state["particles"]["pressure"][3] = 1.5e308
        self.state["particles"]["mass"][3] = 1e300
        document = strict_json(self.succeed("evaluate", "-", text=json.dumps(self.state)))
        self.assert_valid("sphverify-rates-1", document)
        self.assertIsNone(document["rates"]["momentum/p-rho2"]["acceleration"])
        self.assertRegex(document["rates"]["momentum/p-rho2"]["reason"], "acceleration of particle [0-9]+ is not finite")

    def test_every_scheme_has_its_control_without_walls(self):
        rates = strict_json(self.expected)["rates"]
        schemes = {scheme for scheme in rates if not scheme.endswith("-no-walls")}
        self.assertEqual(set(rates) - schemes, {f"{scheme}-no-walls" for scheme in schemes})
        self.assertIn("work/sqrt-p", schemes)

    def test_negative_pressure_makes_sqrt_p_null_with_a_reason_and_no_other(self):
        self.state["particles"]["pressure"][3] = -1.0
        rates = strict_json(self.succeed("evaluate", "-", text=json.dumps(self.state)))["rates"]
        self.assertIsNone(rates["momentum/sqrt-p"]["acceleration"])
        self.assertIn("pressure", rates["momentum/sqrt-p"]["reason"])
        self.assertNotIn("reason", rates["momentum/p-rho2"])
        self.assertNotIn(None, flat(rates["momentum/p-rho2"]["acceleration"]))


    def test_grad_h_terms_want_a_density_that_is_summed_where_each_particle_has_its_own_h(self):
        form, partner = "momentum/p-rho2-grad-h", "work/p-rho2-grad-h"
        rates = strict_json(self.expected)["rates"]  # one h for all
        largest = max(map(abs, flat(rates["momentum/p-rho2"]["acceleration"])))
        for found, expected in zip(flat(rates[form]["acceleration"]), flat(rates["momentum/p-rho2"]["acceleration"])):
            self.assertAlmostEqual(found, expected, delta=1e-12 * largest)
        particles = self.state["particles"]
        h = particles["smoothing_length"]
        particles["smoothing_length"] = [h * (1 + 0.1 * (n % 3)) for n in range(len(particles["position"]))]
        given = strict_json(self.succeed("evaluate", "-", text=json.dumps(self.state)))
        for density in ("summation", "normalised"):
            particles["density"] = density
            summed = strict_json(self.succeed("evaluate", "-", text=json.dumps(self.state)))
            self.assertEqual(set(summed["left_out"]), OF_CELLS)
            differs = [abs(a - b) for a, b in zip(flat(summed["rates"][form]["acceleration"]),
                                                   flat(summed["rates"]["momentum/p-rho2"]["acceleration"]))]  # fmt: skip
            self.assertGreater(max(differs), 1e-3 * largest)
        for one in (form, partner, form + "-no-walls"):
            self.assertIn("summation and normalised only", given["left_out"][one])
            self.assertNotIn(one, given["rates"])


class Example(ProgramTest):
    def test_the_example_gives_every_rate_and_those_in_the_middle_are_those_of_its_fields(self):
        path = SOURCE_DIR / "examples" / "state.json"
        self.assert_valid("sphverify-state-1", strict_json(path.read_text()))
        document = strict_json(self.succeed("evaluate", path))
        self.assert_valid("sphverify-rates-1", document)
        self.assertEqual(set(document["left_out"]), OF_CELLS)
        rates = document["rates"]
        middle = len(document["density"]) // 2
        # Uniform pressure 1, velocity x/10, temperature 1 + x.
        self.assertAlmostEqual(rates["momentum/p-rho2"]["acceleration"][middle][0], 0, delta=0.01)
        self.assertAlmostEqual(rates["work/internal-energy"]["heating"][middle], -0.1, delta=0.01)
        self.assertAlmostEqual(rates["conduction/brookshaw"]["heating"][middle], 0, delta=0.01)


if __name__ == "__main__":
    unittest.main(verbosity=2)
