# SPDX-License-Identifier: GPL-3.0-or-later
"""Plug-ins: the examples in C and Fortran give the rates of our own forms, and what is wrong with one is said in a line."""

import sys

sys.dont_write_bytecode = True

import shutil
import subprocess
import tempfile
import pathlib
import unittest

import program
from program import SOURCE_DIR, ProgramTest, strict_json

HEADER = SOURCE_DIR / "include"
EXAMPLES = SOURCE_DIR / "examples"

# One that is right, of which each bad one changes a line or two.
SOUND = """
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "sphverify/plugin.h"
int sphverify_plugin_abi(void) { return SPHVERIFY_PLUGIN_ABI; }
void sphverify_plugin_describe(sphverify_description* d) {
  strcpy(d->name, "constant");
  d->rate = SPHVERIFY_CONDUCTION_HEATING;
  d->reads = SPHVERIFY_TEMPERATURE;
}
int sphverify_plugin_rates(sphverify_state const* s, sphverify_rates* r) {
  for (size_t i = 0; i < s->count; ++i) r->pairs[0][i] = 0.0;
  return 0;
}
"""


def flat(values):
    return [x for value in values for x in (value if isinstance(value, list) else [value])]


def largest_difference(found, expected):
    found, expected = flat(found), flat(expected)
    assert len(found) == len(expected)
    return max(abs(f - e) for f, e in zip(found, expected)) / (max(map(abs, expected)) or 1.0)


class PluginTest(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.libraries = pathlib.Path(tempfile.mkdtemp())
        cls.in_c = cls.compiled("cc", [EXAMPLES / "plugin-c" / "p_rho2.c"], "libp_rho2.so", "-lm")
        fortran = EXAMPLES / "plugin-fortran"
        cls.in_fortran = cls.compiled("gfortran", [fortran / "sphverify_plugin.f90", fortran / "brookshaw.f90"],
                                      "libbrookshaw.so", f"-J{cls.libraries}")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.libraries)

    @classmethod
    def compiled(cls, compiler, sources, name, *options):
        target = cls.libraries / name
        subprocess.run([compiler, "-O2", "-fPIC", "-shared", "-I", HEADER, *sources, "-o", target, *options], check=True)
        return target

    def changed(self, file, **replacements):
        """A library of SOUND with texts replaced."""
        text = SOUND
        for before, after in replacements.items():
            before = {"abi": "SPHVERIFY_PLUGIN_ABI;", "name": '"constant"', "describe": "d->reads = SPHVERIFY_TEMPERATURE;",
                      "rates": "return 0;", "symbol": "int sphverify_plugin_rates(",
                      "rate": "r->pairs[0][i] = 0.0"}[before]
            self.assertIn(before, text)
            text = text.replace(before, after)
        source = self.write(f"{file}.c", text)
        return self.compiled("cc", [source], f"lib{file}.so", "-lm")

    def states(self, dimension):
        for reference in strict_json((SOURCE_DIR / "tests" / "data" / f"operators-{dimension}d.json").read_text()):
            yield reference["state"]

    def slab(self, formulations, **more):
        return self.write("study.json", {
            "schema": "sphverify-study/1", "name": "plug-in", "cases": "conduction/slab-dirichlet",
            "formulations": formulations, "discretisation": {"smoothing_ratio": 1.2}, "resolution": [20, 40],
            "measure": ["error", "conservation"], **more})


class SameRates(PluginTest):
    def test_examples_have_the_rates_of_our_own_forms_on_every_reference_state(self):
        seen = 0
        for dimension in (1, 2, 3):
            for state in self.states(dimension):
                document = strict_json(self.succeed("evaluate", self.write("state.json", state), "--plugin", self.in_c,
                                                    "--plugin", self.in_fortran))
                self.assertEqual(program.complaints("sphverify-rates-1", document), [])
                rates = document["rates"]
                for end in ("", "-no-walls"):
                    for plugin, ours, key in (("plugin/p-rho2-in-c", "momentum/p-rho2", "acceleration"),
                                              ("plugin/brookshaw-in-fortran", "conduction/brookshaw", "heating")):
                        self.assertEqual(plugin + end in rates, ours + end in rates)
                        if ours + end not in rates:
                            continue  # the state gives no temperature, or no pressure
                        self.assertLess(largest_difference(rates[plugin + end][key], rates[ours + end][key]), 1e-12,
                                        (dimension, plugin + end))
                        seen += 1
        self.assertGreaterEqual(seen, 2 * 8)

    def test_a_run_of_moving_gas_is_that_of_our_own_form(self):
        study = self.write("gas.json", {
            "schema": "sphverify-study/1", "name": "gas", "cases": ["hydro/acoustic", "hydro/piston-velocity"],
            "formulations": ["momentum/p-rho2", {"id": "plugin/p-rho2-in-c", "library": str(self.in_c)}],
            "resolution": [25, 50], "measure": ["error", "conservation"]})
        results = strict_json(self.succeed("study", study))
        ours = {(r["case"], r["resolution"]): r for r in results["runs"] if r["formulation"] == "momentum/p-rho2"}
        theirs = {(r["case"], r["resolution"]): r for r in results["runs"] if r["formulation"].startswith("plugin/")}
        self.assertEqual(sorted(ours), sorted(theirs))
        self.assertEqual(len(ours), 4)
        for key, run in theirs.items():
            same = ours[key]
            self.assertEqual(run["status"], "ok", run["reason"])
            self.assertEqual(run["work"], "work/internal-energy")
            for field in ("velocity", "density", "pressure"):
                self.assertAlmostEqual(run["errors"][field]["all"]["l2"] / same["errors"][field]["all"]["l2"], 1.0, 6, key)
            for budget in ("momentum", "energy"):
                for part in ("final", "exchanged"):
                    size = max(abs(x) for x in flat([same["conservation"]["energy"]["final"]]))
                    for found, expected in zip(flat([run["conservation"][budget][part]]),
                                               flat([same["conservation"][budget][part]])):
                        self.assertAlmostEqual(found / size, expected / size, 8, (key, budget, part))

    def test_a_run_of_conduction_is_that_of_our_own_form(self):
        study = self.slab(["conduction/brookshaw", {"id": "plugin/brookshaw-in-fortran", "library": str(self.in_fortran)}])
        results = strict_json(self.succeed("study", study))
        ours, theirs = results["runs"][:2], results["runs"][2:]
        self.assertEqual([r["formulation"] for r in theirs], ["plugin/brookshaw-in-fortran"] * 2)
        for run, same in zip(theirs, ours):
            self.assertAlmostEqual(run["errors"]["temperature"]["all"]["l2"] / same["errors"]["temperature"]["all"]["l2"], 1.0, 6)
            self.assertAlmostEqual(run["conservation"]["energy"]["exchanged"], same["conservation"]["energy"]["exchanged"], 8)
            for found, expected in zip(run["wall_flux"], same["wall_flux"]):
                self.assertAlmostEqual(found["measured"], expected["measured"], 8)
        self.assertEqual(results["context"]["added"], ["plugin/brookshaw-in-fortran"])
        # The document names the library, so that it can be repeated.
        path = self.write("results.json", results)
        again = strict_json(self.succeed("repeat", path, "3"))
        self.assertEqual(again["errors"], theirs[1]["errors"])

    def test_a_plug_in_without_our_neighbours_or_walls_gets_none_of_them(self):
        library = self.changed("counts", rate="r->pairs[0][i] = (s->first ? 100.0 : 0.0) + (double)s->walls + s->temperature[0] * 0.0"
                                              " + (s->pressure ? 1000.0 : 0.0)")
        state = next(self.states(1))
        rates = strict_json(self.succeed("evaluate", self.write("state.json", state), "--plugin", library))["rates"]
        self.assertEqual(set(rates["plugin/constant"]["heating"]), {float(len(state["walls"]))})
        self.assertEqual(set(rates["plugin/constant-no-walls"]["heating"]), {0.0})


class TheirClaims(PluginTest):
    def claims(self, library, status):
        done = self.run_program("claims", "--json", "--plugin", library)
        self.assertEqual(done.returncode, status, done.stderr)
        document = strict_json(done.stdout)
        self.assertEqual(program.complaints("sphverify-claims-1", document), [])
        ((_, claims),) = document["formulations"].items()
        return {one["claim"]: one for one in claims}

    def test_a_plug_in_is_held_to_what_it_says(self):
        claims = self.claims(self.in_c, program.DONE)
        self.assertTrue(claims["pairs conserve momentum"]["holds"])
        self.assertTrue(claims["pairs conserve energy together with work/internal-energy"]["holds"])
        self.assertTrue(claims["particles gain what the walls give"]["holds"])
        self.assertIn("cubic-spline", claims["pairs conserve momentum"]["where"])  # it refuses all others
        claims = self.claims(self.in_fortran, program.DONE)
        self.assertTrue(claims["pairs conserve energy"]["claimed"])

    def test_each_question_can_be_answered_with_no(self):
        work = "d->rate = SPHVERIFY_INTERNAL_WORK; d->reads = SPHVERIFY_VELOCITY;"
        counts = "d->wants_neighbours = 1; d->reads = SPHVERIFY_TEMPERATURE;"
        for number, (claim, rate, describe) in enumerate((
                ("the order of the particles does not matter", "(double)i", None),
                ("moving, turning and mirroring all changes nothing", "s->position[0][i]", None),
                ("a uniform state is steady on a lattice", "s->temperature[i]", None),
                ("linear fields: the derivative times the lattice's factor", "0.0", None),
                ("continuous where a neighbour leaves the support", "(double)(s->first[i + 1] - s->first[i])", counts),
                ("a common velocity changes nothing", "s->velocity[0][i]", work))):
            changes = {"rate": f"r->pairs[0][i] = {rate}"}
            if describe:
                changes["describe"] = describe
            found = self.claims(self.changed(f"wrong{number}", **changes), program.GATE_FAILED)[claim]
            self.assertTrue(found["claimed"], claim)
            self.assertFalse(found["holds"], claim)

    def test_what_cannot_be_looked_at_is_not_kept(self):
        for name, change in (("refuses", {"rates": "return 7;"}), ("nan", {"rate": "r->pairs[0][i] = sqrt(-1.0)"})):
            claims = self.claims(self.changed(name, **change), program.GATE_FAILED)
            self.assertFalse(any(one["holds"] for one in claims.values()))

    def test_one_that_claims_too_much_fails_by_name(self):
        library = self.changed("liar", describe="d->reads = SPHVERIFY_TEMPERATURE; d->conserves = SPHVERIFY_CONSERVES_ENERGY;",
                               rate="r->pairs[0][i] = s->temperature[i]")
        claim = self.claims(library, program.GATE_FAILED)["pairs conserve energy"]
        self.assertFalse(claim["holds"])
        self.assertGreater(claim["found"], 0.1)
        done = self.run_program("claims", "--plugin", library)
        self.assertEqual(done.returncode, program.GATE_FAILED)
        self.assertRegex(done.stdout, "plugin/constant")
        self.assertRegex(done.stdout, r"FAILS +[0-9.e]+ +pairs conserve energy \(")


class WhatIsWrong(PluginTest):
    def refused(self, library, *words):
        """In a study and with evaluate: one line, exit status 2."""
        state = self.write("state.json", next(self.states(1)))
        study = self.slab([{"id": "plugin/constant", "library": str(library)}])
        for arguments in (("study", study), ("evaluate", state, "--plugin", library)):
            done = self.run_program(*arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            for word in words:
                self.assertIn(word, done.stderr)
            self.assertEqual(done.stdout, "")

    def test_what_is_no_plug_in_of_this_version_is_refused_in_one_line(self):
        self.refused(self.libraries / "libnone.so", "no such file", "libnone.so")
        self.refused(self.write("libtext.so", "no library"), "cannot be loaded", "libtext.so")
        self.refused(self.changed("abi", abi="SPHVERIFY_PLUGIN_ABI + 1;"), "version 2", "version 1")
        self.refused(self.changed("symbol", symbol="int sphverify_plugin_rate("), "sphverify_plugin_rates", "libsymbol.so")
        self.refused(self.changed("name", name='"Not A Name"'), "'Not A Name'", "hyphens")
        self.refused(self.changed("empty", name='""'), "hyphens")
        self.refused(self.changed("long", describe='memset(d->title, 65, sizeof d->title);'), "title", "159")
        self.refused(self.changed("bits", describe="d->reads = 1024;"), "reads = 1024")
        self.refused(self.changed("kind", describe="d->rate = 9;"), "rate = 9")
        self.refused(self.changed("partner", describe='strcpy(d->work_partner, "work/sqrt-p");'), "work_partner")

    def test_a_crash_inside_ends_the_program_with_one_line_that_names_the_plug_in(self):
        for name, slip, words in (("segv", "return *(volatile int*)0;", "crashed: segmentation fault"),
                                  ("abort", "abort();", "crashed: abort"),
                                  ("stop", "exit(0);", "ended the program")):
            with self.subTest(name):
                library = self.changed(name, rates=slip)
                target = self.folder / f"{name}.json"
                done = self.run_program("study", self.slab(["conduction/brookshaw",
                                                            {"id": "plugin/constant", "library": str(library)}]),
                                        "-o", target, "--jobs", "1")
                self.assertEqual(done.returncode, 3, done.stderr)
                last = done.stderr.splitlines()[-1]
                self.assertIn("plugin/constant", last)
                self.assertIn(words, last)
                self.assertIn(str(library), last)
                # What was finished before is not lost.
                journal = target.with_name(target.name + ".journal")
                self.assertEqual(len(journal.read_text().splitlines()), 3)

    def test_a_plug_in_that_reads_nothing_runs_wherever_its_rate_makes_sense(self):
        # What the harness itself looks at is there all the same.
        nothing = "d->reads = 0;"
        for number, rate in enumerate(("SPHVERIFY_CONDUCTION_HEATING", "SPHVERIFY_ACCELERATION")):
            library = str(self.changed(f"blind{number}", describe=f'd->rate = {rate}; {nothing}',
                                       name=f'"blind{number}"'))
            formulation = {"id": f"plugin/blind{number}", "library": library}
            cases = ["conduction/slab-dirichlet", "conduction/slab-insulated"]
            if number == 1:
                formulation["work"] = {"id": "plugin/blindwork", "library": str(self.changed(
                    "blindwork", describe=f"d->rate = SPHVERIFY_INTERNAL_WORK; {nothing}", name='"blindwork"'))}
                cases = ["hydro/piston-velocity", "hydro/piston-pressure"]
            study = self.write("blind.json", {
                "schema": "sphverify-study/1", "name": "blind", "cases": cases, "formulations": [formulation],
                "discretisation": {"density": ["summation"]}, "resolution": [20]})
            runs = strict_json(self.succeed("study", study))["runs"]
            self.assertEqual(len(runs), 2)

    def test_a_form_that_reads_what_a_case_does_not_have_is_skipped_with_the_reason(self):
        for number, (slip, word) in enumerate((("d->reads = SPHVERIFY_SOUND_SPEED;", "sound_speed"),
                                               ("d->reads = SPHVERIFY_PRESSURE;", "pressure"),
                                               # A wall that does not prescribe it has it of the particles.
                                               ("d->reads_at_walls = SPHVERIFY_VELOCITY;", "velocity"))):
            library = self.changed(f"curious{number}", describe=slip)
            study = self.slab(["conduction/brookshaw", {"id": "plugin/constant", "library": str(library)}])
            results = strict_json(self.succeed("study", study))
            self.assertEqual({r["formulation"] for r in results["runs"]}, {"conduction/brookshaw"})
            self.assertEqual([s["reason"] for s in results["skipped"]],
                             [f"plugin/constant reads the {word}, which the case does not have"])

    def test_a_wall_s_part_in_a_particle_that_it_does_not_reach_is_refused(self):
        library = self.changed("reaching", rates="if (s->walls) r->wall[0][0][s->count / 2] = 0.5; return 0;")
        results = strict_json(self.succeed("study", self.slab([{"id": "plugin/constant", "library": str(library)}])))
        self.assertEqual([r["status"] for r in results["runs"]], ["invalid", "invalid"])
        self.assertIn("particle 10, which is no contact of it", results["runs"][0]["reason"])

    def test_a_rounding_mode_that_is_left_behind_changes_nobody_else_s_rates(self):
        library = self.changed("upward", rates="fesetround(FE_UPWARD); return 0;", symbol="#include <fenv.h>\nint sphverify_plugin_rates(")
        path = self.write("state.json", next(self.states(1)))
        alone = strict_json(self.succeed("evaluate", path))["rates"]
        beside = strict_json(self.succeed("evaluate", path, "--plugin", library))["rates"]
        self.assertEqual({id: beside[id] for id in alone}, alone)

    def test_a_stack_that_runs_out_is_named_in_every_thread(self):
        # Page by page: what jumps over the page that guards the stack may find other memory there.
        deep = "for (;;) { volatile char* page = __builtin_alloca(4096); page[0] = 1; }"
        library = self.changed("deep", rates=deep, describe="d->thread_safe = 1; d->reads = SPHVERIFY_TEMPERATURE;")
        study = self.slab([{"id": "plugin/constant", "library": str(library)}])
        for jobs in ("1", "2"):
            done = self.run_program("study", study, "--jobs", jobs)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("plugin/constant", done.stderr.splitlines()[-1])
            self.assertIn("crashed: segmentation fault", done.stderr.splitlines()[-1])

    def test_a_study_goes_on_with_the_same_plug_in(self):
        library = self.changed("moody", rates='if (s->count == 40 && getenv("MOODY")) abort(); return 0;')
        target = self.folder / "moody.json"
        study = self.slab([{"id": "plugin/constant", "library": str(library)}])
        done = self.run_program("study", study, "-o", target, "--jobs", "1", env={**program.environment(), "MOODY": "1"})
        self.assertEqual(done.returncode, 3, done.stderr)
        done = self.run_program("study", study, "-o", target, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1 of them done before", done.stderr)
        self.assertEqual([r["status"] for r in strict_json(target.read_text())["runs"]], ["ok", "ok"])

    def test_a_study_is_not_gone_on_with_after_the_plug_in_has_changed(self):
        # The first of these crashes: a journal is left.
        library = self.changed("swap", rates="abort();")
        target = self.folder / "swap.json"
        study = self.slab(["conduction/brookshaw", {"id": "plugin/constant", "library": str(library)}])
        self.assertEqual(self.run_program("study", study, "-o", target).returncode, 3)
        self.assertEqual(self.changed("swap"), library)
        done = self.run_program("study", study, "-o", target, "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("another build", done.stderr)
        self.assertEqual(self.run_program("study", study, "-o", target).returncode, 0)

    def test_a_plug_in_that_fails_or_gives_nan_is_a_finding_of_its_runs_alone(self):
        for name, change, status, word in (("fails", {"rates": "return 7;"}, "invalid", "status 7"),
                                           ("nan", {"rate": "r->pairs[0][i] = i == 3 ? sqrt(-1.0) : 0.0"}, "non-finite", "not finite")):
            with self.subTest(name):
                library = self.changed(name, **change)
                results = strict_json(self.succeed("study", self.slab(
                    ["conduction/brookshaw", {"id": "plugin/constant", "library": str(library)}])))
                self.assertEqual([r["status"] for r in results["runs"]], ["ok", "ok", status, status])
                self.assertIn(word, results["runs"][2]["reason"].lower())
                rates = strict_json(self.succeed("evaluate", self.write("state.json", next(self.states(1))), "--plugin", library))
                self.assertIsNone(rates["rates"]["plugin/constant"]["heating"])
                self.assertIn(word, rates["rates"]["plugin/constant"]["reason"].lower())

    def test_names_that_do_not_fit_the_library_are_refused(self):
        sound = str(self.changed("sound"))
        for formulation, word in (({"id": "plugin/other", "library": sound}, "plugin/constant"),
                                  ("plugin/constant", "library"),
                                  ({"id": "conduction/brookshaw", "library": sound}, "plugin/constant"),
                                  ({"id": "plugin/constant", "library": 3}, "library")):
            done = self.run_program("study", self.slab([formulation]))
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(word, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        other = self.changed("second")
        done = self.run_program("study", self.slab([{"id": "plugin/constant", "library": sound},
                                                    {"id": "plugin/constant", "library": str(other)}]))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("second", done.stderr)

    def test_a_momentum_form_without_an_energy_equation_is_skipped_on_moving_gas_with_the_reason(self):
        library = self.changed("force", describe="d->rate = SPHVERIFY_ACCELERATION;")
        study = self.write("gas.json", {
            "schema": "sphverify-study/1", "name": "gas", "cases": "hydro/acoustic",
            "formulations": [{"id": "plugin/constant", "library": str(library)}], "resolution": [25]})
        done = self.run_program("study", study)
        self.assertEqual(done.returncode, 2)
        self.assertIn("plugin/constant on hydro/acoustic: it names no energy equation of its own", done.stderr)


if __name__ == "__main__":
    unittest.main()
