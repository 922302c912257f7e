# SPDX-License-Identifier: GPL-3.0-or-later
"""`evaluate` on particles with smoothing lengths of their own, from files, with viscosity; and somebody's rates beside ours."""

import sys

sys.dont_write_bytecode = True

import json
import math
import random
import unittest

from program import GATE_FAILED, USER_ERROR, ProgramTest, complaints, strict_json
from test_codes import write_csv

GAMMA, ALPHA, BETA = 1.4, 0.7, 1.3
COUNT = 30


def slope(r, h):
    """dW/dr of the cubic spline in one dimension."""
    q = r / h
    shape = -3 * q + 2.25 * q * q if q < 1 else -0.75 * (2 - q) ** 2 if q < 2 else 0.0
    return 2 / (3 * h * h) * shape


class OwnRates(ProgramTest):
    def setUp(self):
        super().setUp()
        draw = random.Random(4)
        x = sorted((i + 0.5 + draw.uniform(-0.3, 0.3)) / COUNT for i in range(COUNT))
        self.x, self.h = x, [(1.2 + 0.5 * draw.random()) / COUNT for _ in x]
        self.m = [draw.uniform(0.8, 1.2) / COUNT for _ in x]
        self.rho = [draw.uniform(0.5, 2.0) for _ in x]
        self.e = [draw.uniform(1.0, 3.0) for _ in x]
        self.v = [draw.uniform(-1.0, 1.0) for _ in x]
        self.T = [draw.uniform(1.0, 2.0) for _ in x]
        self.K = [draw.uniform(0.5, 2.0) for _ in x]

    def state(self, particles=None, **changes):
        particles = particles or {
            "position": [[x] for x in self.x], "velocity": [[v] for v in self.v], "mass": self.m, "density": self.rho,
            "smoothing_length": self.h, "internal_energy": self.e, "temperature": self.T, "conductivity": self.K,
        }  # fmt: skip
        document = {"schema": "sphverify-state/1", "dimension": 1, "gamma": GAMMA, "viscosity": {"alpha": ALPHA, "beta": BETA},
                    "time": 0.25, "particles": particles, **changes}  # fmt: skip
        self.assertEqual(complaints("sphverify-state-1", document), [])
        return self.write("state.json", document)

    def sums(self):
        """Dense sums with the mean smoothing length of each pair."""
        n = range(COUNT)
        P = [(GAMMA - 1) * self.rho[i] * self.e[i] for i in n]
        c = [math.sqrt(GAMMA * P[i] / self.rho[i]) for i in n]
        acceleration, viscous, viscous_heating, conduction = ([0.0] * COUNT for _ in range(4))
        for i in n:
            for j in n:
                if i == j:
                    continue
                d = self.x[i] - self.x[j]
                r, h = abs(d), 0.5 * (self.h[i] + self.h[j])
                gradient = slope(r, h) * (1 if d > 0 else -1)
                dv = self.v[i] - self.v[j]
                mu = h * min(dv * d, 0.0) / (d * d + 0.01 * h * h)
                rho = 0.5 * (self.rho[i] + self.rho[j])
                Pi = (-ALPHA * 0.5 * (c[i] + c[j]) * mu + BETA * mu * mu) / rho
                acceleration[i] -= self.m[j] * (P[i] / self.rho[i] ** 2 + P[j] / self.rho[j] ** 2) * gradient
                viscous[i] -= self.m[j] * Pi * gradient
                viscous_heating[i] += 0.5 * self.m[j] * Pi * dv * gradient
                conduction[i] += (self.m[j] * (self.K[i] + self.K[j]) / (self.rho[i] * self.rho[j])
                                  * (self.T[i] - self.T[j]) * slope(r, h) / r)  # fmt: skip
        return {
            "momentum/p-rho2": {"acceleration": [[a] for a in acceleration]},
            "viscosity/monaghan": {"acceleration": [[a] for a in viscous], "heating": viscous_heating},
            "conduction/brookshaw": {"heating": conduction},
        }

    def against(self, state, rates, *options):
        theirs = self.write("theirs.json", {"rates": rates})
        return self.run_program("evaluate", state, "--against", theirs, *options)

    def test_own_smoothing_lengths_viscosity_and_pressure_from_energy_are_dense_sums(self):
        document = strict_json(self.succeed("evaluate", self.state()))
        self.assert_valid("sphverify-rates-1", document)
        done = self.against(self.state(), self.sums(), "-o", self.folder / "rates.json")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(done.stdout.count("passed "), 4)
        ours = strict_json((self.folder / "rates.json").read_text())
        self.assert_valid("sphverify-rates-1", ours)
        # What nobody asked for is not computed.
        self.assertEqual(set(ours["rates"]), {"momentum/p-rho2", "viscosity/monaghan", "conduction/brookshaw"})
        for one in ours["against"]["lists"]:
            self.assertTrue(one["holds"])
            self.assertLess(one["linf"], 1e-13)
        for scheme in ours["rates"]:
            self.assertEqual(ours["rates"][scheme], document["rates"][scheme])

    def test_what_is_off_is_named_with_its_worst_particle(self):
        rates = self.sums()
        largest = max(abs(a[0]) for a in rates["momentum/p-rho2"]["acceleration"])
        rates["momentum/p-rho2"]["acceleration"][7][0] += 0.02 * largest
        rates["momentum/p-rho2"]["acceleration"][9][0] -= 0.01 * largest
        done = self.against(self.state(), rates, "-o", self.folder / "rates.json")
        self.assertEqual(done.returncode, GATE_FAILED)
        self.assertIn("failed momentum/p-rho2 acceleration: off by", done.stdout)
        self.assertIn("worst is particle 7", done.stdout)
        (off,) = [one for one in strict_json((self.folder / "rates.json").read_text())["against"]["lists"] if not one["holds"]]
        self.assertAlmostEqual(off["linf"], 0.02, delta=1e-10)
        self.assertAlmostEqual(off["l1"], 0.03 / COUNT, delta=1e-10)
        self.assertAlmostEqual(off["l2"], math.hypot(0.02, 0.01) / math.sqrt(COUNT), delta=1e-10)
        self.assertEqual(off["worst"]["particle"], 7)
        self.assertAlmostEqual(off["worst"]["theirs"][0] - off["worst"]["ours"][0], 0.02 * largest, delta=1e-9 * largest)
        self.assertEqual(self.against(self.state(), rates, "--limit", "0.021").returncode, 0)
        self.assertEqual(self.against(self.state(), rates, "--limit", "0.019").returncode, GATE_FAILED)

    def test_single_precision_is_given_its_digits(self):
        rates = self.sums()
        largest = max(abs(a) for a in rates["conduction/brookshaw"]["heating"])
        rates = {"conduction/brookshaw": {"heating": [a + 1e-6 * largest for a in rates["conduction/brookshaw"]["heating"]]}}
        self.assertEqual(self.against(self.state(), rates).returncode, GATE_FAILED)
        self.assertEqual(self.against(self.state(precision="single"), rates).returncode, 0)

    def test_lists_that_cannot_be_compared_fail_with_the_reason(self):
        heating = self.sums()["conduction/brookshaw"]["heating"]
        for rates, words in (
            ({"conduction/brookshav": {"heating": heating}}, "no such rates: one of `sphverify list formulations` (did you mean 'conduction/brookshaw'?"),
            ({"conduction/brookshaw": {"cooling": heating}}, "sphverify gives heating"),
            ({"conduction/brookshaw": {"heating": heating[:-1]}}, "29 particles, expected 30"),
            ({"conduction/brookshaw": {"heating": [[a] * 2 for a in heating]}}, "2 components"),
        ):
            done = self.against(self.state(), rates)
            self.assertEqual(done.returncode, GATE_FAILED, rates.keys())
            self.assertIn(words, done.stdout)
        for rates, words in (
            ({}, "one scheme or more"),
            ({"conduction/brookshaw": {}}, "lists of rates"),
            ({"conduction/brookshaw": {"heating": ["a"]}}, "heating[0]"),
        ):
            self.assert_user_error(self.against(self.state(), rates), "theirs.json", words)

    def test_particles_come_from_a_file_beside_the_document(self):
        columns = {"x": self.x, "vx": self.v, "m": self.m, "rho": self.rho, "h": self.h, "e": self.e, "T": self.T, "K": self.K}
        write_csv(self.folder / "particles.csv", columns)
        self.assertEqual(self.against(self.state({"file": "particles.csv"}), self.sums()).returncode, 0)
        # What the document gives goes before the file.
        state = self.state({"file": "particles.csv", "smoothing_length": 0.05})
        self.assertEqual(self.against(state, self.sums()).returncode, GATE_FAILED)
        for positions in ([[x] for x in self.x[:-1]], [[x] for x in self.x] + [[1.5]]):
            done = self.run_program("evaluate", self.state({"file": "particles.csv", "position": positions}))
            self.assert_user_error(done, "particles.csv", "30 particles", str(len(positions)))
        plain = strict_json(self.succeed("evaluate", self.state({"file": "particles.csv", "density": "summation"})))
        listed = {"position": [[x] for x in self.x], "mass": self.m, "density": "summation", "smoothing_length": self.h}
        self.assertEqual(plain["density"], strict_json(self.succeed("evaluate", self.state(listed)))["density"])
        for change, words in (
            ({"m": None}, ["particles.mass", "nothing"]),
            ({"h": None}, ["particles.smoothing_length"]),
            ({"h": [0.0] + self.h[1:]}, ["h: found 0 of particle 0"]),
            ({"m": [-1.0] + self.m[1:]}, ["m: found -1 of particle 0"]),
            ({"T": [math.nan] + self.T[1:]}, ["T: found nan of particle 0"]),
        ):
            changed = {name: values for name, values in {**columns, **change}.items() if values is not None}
            write_csv(self.folder / "particles.csv", changed)
            self.assert_user_error(self.run_program("evaluate", self.state({"file": "particles.csv"})), *words[:1])

    def test_rates_that_cancel_are_held_to_the_rounding_of_their_terms(self):
        """A gas at almost the same pressure everywhere: sums of terms of order 1/h, of which a part in 10^5 is left."""
        n = 40
        x = [(i + 0.5) / n for i in range(n)]
        P = [1 + 1e-5 * math.sin(2 * math.pi * one) for one in x]
        particles = {"position": [[one] for one in x], "mass": [1 / n] * n, "density": [1.0] * n, "pressure": P,
                     "smoothing_length": 1.2 / n}  # fmt: skip
        state = self.state(particles, periodic=[[0, 1]])
        rates = []
        for i in range(n):
            sums = 0.0
            for j in range(n):
                d = (x[i] - x[j] + 0.5) % 1 - 0.5
                if j != i and abs(d) < 2.4 / n:
                    sums -= (P[i] + P[j]) / n * slope(abs(d), 1.2 / n) * (1 if d > 0 else -1)
            rates.append([sums])
        done = self.against(state, {"momentum/p-rho2": {"acceleration": rates}}, "--limit", "1e-15", "-o", self.folder / "rates.json")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("off by no more than rounding of its terms", done.stdout)
        document = strict_json((self.folder / "rates.json").read_text())
        self.assert_valid("sphverify-rates-1", document)
        # 128 roundings of P/(rho h), 2^-53 each.
        self.assertAlmostEqual(document["round_off"]["momentum/p-rho2"], 2.0**-46 * max(P) * n / 1.2, delta=1e-14)
        rates[3][0] += 2 * document["round_off"]["momentum/p-rho2"]
        done = self.against(state, {"momentum/p-rho2": {"acceleration": rates}}, "--limit", "1e-15")
        self.assertEqual(done.returncode, GATE_FAILED)
        self.assertIn("worst is particle 3", done.stdout)

    def test_walls_take_part_in_viscosity_and_leave_with_their_terms(self):
        walls = [{"point": [0.0], "outward_normal": [-1.0], "velocity": [0.3], "pressure": 1.0},
                 {"point": [1.0], "outward_normal": [1.0], "velocity": [-0.3], "pressure": 1.0}]  # fmt: skip
        with_walls = strict_json(self.succeed("evaluate", self.state(walls=walls)))["rates"]
        plain = strict_json(self.succeed("evaluate", self.state()))["rates"]
        self.assertEqual(with_walls["viscosity/monaghan-no-walls"], plain["viscosity/monaghan"])
        differ = [i for i in range(COUNT)
                  if with_walls["viscosity/monaghan"]["acceleration"][i] != plain["viscosity/monaghan"]["acceleration"][i]]  # fmt: skip
        self.assertTrue(differ)
        for i in differ:  # within the support of a wall, towards which it moves
            self.assertLess(min(self.x[i], 1 - self.x[i]), 2 * self.h[i])

    def test_who_has_nobody_near_is_counted_by_its_own_length(self):
        particles = {"position": [[(i + 0.5) / 20] for i in range(20)], "mass": [0.05] * 20, "density": [1.0] * 20,
                     "temperature": [1.0] * 20, "conductivity": [1.0] * 20, "smoothing_length": [0.01] * 19 + [0.08]}  # fmt: skip
        remarks = strict_json(self.succeed("evaluate", self.state(particles)))["remarks"]
        self.assertTrue(any(one.startswith("18 of 20 particles") for one in remarks), remarks)

    def test_words_that_are_nothing_are_refused(self):
        state = self.state()
        for words, said in (
            (["--only", "conduction/brookshav"], "did you mean 'conduction/brookshaw'"), (["--only", ""], "--only"),
        ):  # fmt: skip
            self.assert_user_error(self.run_program("evaluate", state, *words), said)
        self.assert_user_error(self.against(state, {"conduction/brookshaw": {"heating": None}}), "no list that is not null")
        self.assert_user_error(self.against(state, self.sums(), "--limit", "nan"), "--limit")
        done = self.run_program("evaluate", state, "--against", self.write("t.json", {"rates": self.sums()}), "-o", self.folder / "t.json")
        self.assert_user_error(done, "t.json")
        huge = {"conduction/brookshaw": {"heating": [1e308] * COUNT}}
        done = self.against(state, huge, "-o", self.folder / "rates.json")
        self.assertEqual(done.returncode, GATE_FAILED)
        self.assert_valid("sphverify-rates-1", strict_json((self.folder / "rates.json").read_text()))

    def test_one_length_for_all_is_a_list_of_equal_ones(self):
        particles = {"position": [[x] for x in self.x], "mass": self.m, "density": "normalised", "temperature": self.T,
                     "conductivity": self.K}  # fmt: skip
        walls = [{"point": [0.0], "outward_normal": [-1.0], "temperature": 1.0, "conductivity": 1.0}]
        alike = [
            strict_json(self.succeed("evaluate", self.state({**particles, "smoothing_length": h}, walls=walls)))
            for h in (0.05, [0.05] * COUNT)
        ]
        self.assertEqual(alike[0]["walls"], alike[1]["walls"])
        self.assertEqual(alike[0]["density"], alike[1]["density"])
        for scheme, lists in alike[0]["rates"].items():
            for a, b in zip(lists.get("heating", []), alike[1]["rates"][scheme].get("heating", [])):
                self.assertAlmostEqual(a, b, delta=1e-10 * abs(a) + 1e-12)

    def test_bad_keys_are_refused(self):
        for changes, words in (
            ({"gamma": 1}, "gamma"), ({"viscosity": {"alpha": 1}}, "viscosity.beta"), ({"precision": "half"}, "precision"),
            ({"gamma": None}, "gamma"),
        ):  # fmt: skip
            document = json.loads(self.state().read_text())
            document.update(changes)
            document = {key: value for key, value in document.items() if value is not None}
            self.assert_user_error(self.run_program("evaluate", self.write("bad.json", document)), words)
        document["particles"]["smoothing_length"] = self.h[:-1]
        self.assert_user_error(self.run_program("evaluate", self.write("bad.json", document)), "smoothing_length", "30")


if __name__ == "__main__":
    unittest.main()
