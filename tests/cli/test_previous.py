# SPDX-License-Identifier: GPL-3.0-or-later
"""Documents, identifiers and plug-ins of versions before (tests/data/previous) serve the program of today: docs/versions.md
promises it."""

import sys

sys.dont_write_bytecode = True

import os
import shutil
import subprocess
import unittest

from program import DONE, GATE_FAILED, SOURCE_DIR, ProgramTest, strict_json

PREVIOUS = SOURCE_DIR / "tests" / "data" / "previous"
VERSIONS = sorted(path for path in PREVIOUS.iterdir() if path.is_dir())
STUDIES = ("heat", "gas", "limits")

# What another compiler or processor may change in a number that went through an adaptive integrator.
AGREEMENT = 1e-6


def documents(version):
    return {path.name: strict_json(path.read_text()) for path in sorted(version.glob("*.json"))}


def number_at_leaves(value, path=()):
    """Every number of nested lists and objects with where it stands."""
    if isinstance(value, dict):
        for key, one in value.items():
            yield from number_at_leaves(one, path + (key,))
    elif isinstance(value, list):
        for index, one in enumerate(value):
            yield from number_at_leaves(one, path + (index,))
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield path, value


class Previous(ProgramTest):
    """Of one version; `load_tests` makes a suite of each."""

    version = VERSIONS[0]

    def path(self, name):
        return self.version / name

    def document(self, name):
        return strict_json(self.path(name).read_text())

    def assert_numbers_agree(self, found, expected):
        found, expected = dict(number_at_leaves(found)), dict(number_at_leaves(expected))
        self.assertGreater(len(expected), 0)
        for path, value in expected.items():
            self.assertIn(path, found)
            self.assertLessEqual(abs(found[path] - value), AGREEMENT * abs(value) + 1e-13, f"{path}: {found[path]}, {value}")

    def test_every_document_keeps_to_the_schema_of_its_name(self):
        found = documents(self.version)
        self.assertGreaterEqual(len(found), 19)
        for name, document in found.items():
            with self.subTest(name):
                self.assert_valid(document["schema"].replace("/", "-"), document)

    def test_identifiers_are_still_there(self):
        now = strict_json(self.succeed("list", "--json"))
        for kind, entries in self.document("list.json").items():
            if kind == "schema":
                continue
            there = {entry["id"] for entry in now[kind]}
            self.assertEqual({entry["id"] for entry in entries} - there, set(), kind)

    def test_results_are_compared_and_drawn(self):
        old = self.document("comparison.json")
        now = strict_json(self.succeed("compare", self.path("heat.results.json"), "--format", "json"))
        self.assertEqual(now["summary"][0]["scenes"], old["summary"][0]["scenes"])
        for name in STUDIES:
            results = self.path(f"{name}.results.json")
            self.succeed("compare", results)
            self.succeed("compare", results, "--section", "levels", "--format", "csv")
            self.assertIn("sphverify", self.succeed("report", results, "-o", "-"))
        self.succeed("report", *(self.path(f"{name}.results.json") for name in STUDIES), "-o", "-")
        self.succeed("compare", self.path("assessed.results.json"))

    def test_gates_judge_as_they_did(self):
        for name, status, verdicts in (
            ("heat", GATE_FAILED, ["passed", "failed", "passed", "passed", "expected-failure"]),
            ("gas", DONE, ["passed", "passed", "expected-failure", "passed"]),
        ):
            result = self.run_program("gate", self.path(f"{name}.results.json"), self.path(f"{name}.gates.json"))
            self.assertEqual(result.returncode, status, result.stderr)
            lines = result.stdout.splitlines()[: len(verdicts)]
            self.assertEqual([line.split()[0] for line in lines], verdicts)

    def test_studies_give_the_numbers_that_they_gave(self):
        for name in STUDIES:
            self.succeed("study", self.path(f"{name}.study.json"), "-o", self.folder / "now.json")
            now, old = strict_json((self.folder / "now.json").read_text()), self.document(f"{name}.results.json")
            for key in ("case", "formulation", "work", "conduction", "walls", "resolution", "status", "particles"):
                self.assertEqual([run[key] for run in now["runs"]], [run[key] for run in old["runs"]], key)
            for key in ("errors", "spacing", "smoothing_length", "discretisation", "parameters"):
                self.assert_numbers_agree([run[key] for run in now["runs"]], [run[key] for run in old["runs"]])
            self.assertEqual([one["verdict"] for s in now["series"] for one in s["orders"]],
                             [one["verdict"] for s in old["series"] for one in s["orders"]])
            changes = self.succeed("compare", self.path(f"{name}.results.json"), self.folder / "now.json", "--section", "changes")
            self.assertIn(f"version {self.version.name}", changes)
        old, now = self.document("limits.results.json")["envelopes"], now["envelopes"]
        self.assert_numbers_agree([[e["held"], e["failed"]] for e in now], [[e["held"], e["failed"]] for e in old])

    def test_a_run_is_repeated(self):
        for name, run in (("heat", 4), ("gas", 3)):
            result = self.run_program("repeat", self.path(f"{name}.results.json"), run)
            self.assertEqual(result.returncode, DONE, result.stderr)
            self.assertRegex(result.stderr, "numbers +all")

    def test_orders_rates_and_exact_solutions_are_what_they_were(self):
        orders = strict_json(self.succeed("order", self.path("table.csv"), "--format", "json"))
        self.assert_numbers_agree(orders, self.document("orders.json"))
        self.succeed("evaluate", self.path("state.json"), "--against", self.path("rates.json"))
        exact = strict_json(self.succeed("exact", "conduction/slab-dirichlet", "--time", "0.02", "--points", "0.25,0.5"))
        self.assert_numbers_agree(exact, self.document("exact.json"))

    def test_snapshots_are_assessed(self):
        self.succeed("assess", self.path("snapshots.json"), "-o", self.folder / "now.json")
        now = strict_json((self.folder / "now.json").read_text())["runs"]
        self.assert_numbers_agree([run["errors"] for run in now],
                                  [run["errors"] for run in self.document("assessed.results.json")["runs"]])

    def test_claims_still_stand(self):
        for formulation, old in self.document("claims.json")["formulations"].items():
            now = strict_json(self.succeed("claims", formulation, "--json"))["formulations"][formulation]
            held = {claim["claim"] for claim in now if claim["claimed"] and claim["holds"]}
            self.assertEqual({claim["claim"] for claim in old if claim["claimed"]} - held, set())

    @unittest.skipUnless(shutil.which("cc"), "no C compiler")
    @unittest.skipIf(os.environ.get("SPHVERIFY", "").endswith("-emulated"), "what is compiled here is for another machine")
    def test_a_plugin_compiled_then_is_loaded(self):
        plugin, library = self.version / "plugin", self.folder / "libold.so"
        subprocess.run(["cc", "-O2", "-fPIC", "-shared", plugin / "p_rho2.c", "-I", plugin, "-o", library, "-lm"], check=True)
        now = strict_json(self.succeed("evaluate", self.path("state.json"), "--plugin", library))
        ours = self.document("rates.json")["rates"]["momentum/p-rho2"]
        self.assert_numbers_agree(now["rates"]["plugin/p-rho2-in-c"], ours)


def load_tests(loader, _tests, _pattern):
    suite = unittest.TestSuite()
    for version in VERSIONS:
        one = type(f"Version_{version.name.replace('.', '_')}", (Previous,), {"version": version})
        suite.addTests(loader.loadTestsFromTestCase(one))
    return suite


if __name__ == "__main__":
    unittest.main()
