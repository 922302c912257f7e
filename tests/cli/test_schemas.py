# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program reads and writes agrees with the JSON Schemas, by a validator that is not ours."""

import sys

sys.dont_write_bytecode = True

import json
import unittest

import jsonschema

from program import (
    SCHEMAS,
    SOURCE_DIR,
    ProgramTest,
    complaints,
    mutated,
    small_study,
    strict_json,
    without,
)

ALL_MEASURES = ["error", "conservation", "cost", "stability", "profile", "history", "spectrum"]
CONDUCTION = ["conduction/brookshaw", "conduction/lucy-flux", "conduction/campbell-flux"]
MOMENTUM_AND_WORK = [
    "momentum/p-rho2", "momentum/sqrt-p", "momentum/direct-gradient",
    "work/total-energy", "work/internal-energy", "work/sqrt-p",
    "momentum/gdsph", "work/gdsph", "momentum/pressure-energy", "work/pressure-energy", "momentum/rkgc", "work/rkgc",
]  # fmt: skip
REGIONS = ["all", "corner", "wall", "interior", "smooth"]


def with_controls(formulations):
    return formulations + [{"id": f, "walls": "off"} for f in formulations]


SLAB = {"id": "conduction/slab-dirichlet", "parameters": {"final_time": 0.01}}
DISCRETISATION_STUDY = small_study(
    name="discretisations",
    cases=[SLAB],
    formulations=with_controls(CONDUCTION),
    discretisation={
        "kernel": "cubic-spline", "density": ["given", "summation", "normalised"],
        "layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2]}],
        "smoothing_ratio": 1.2, "face_weight": "balanced",
    },
    resolution=[8, 12, 16], measure=ALL_MEASURES, repeat=2, time_budget=20,
)  # fmt: skip
CASES_STUDY = small_study(
    name="cases",
    cases=[
        "conduction/slab-insulated", "conduction/slab-flux", "conduction/half-space-step",
        {"id": "conduction/barenblatt", "parameters": {"final_time": 0.05}},
        {"id": "conduction/marshak", "parameters": {"exponent": 2, "final_time": 0.02}},
        {"id": "conduction/manufactured", "parameters": {"final_time": 0.01}},
    ],
    formulations=["conduction/brookshaw", {"id": "conduction/lucy-flux", "walls": "off"}],
    discretisation={"integrator": ["bdf", "runge-kutta"]},
    resolution=[8, 16], measure=ALL_MEASURES, time_budget=20,
)  # fmt: skip
OPERATOR_STUDY = small_study(
    name="operator",
    cases=[
        "operator/polynomial",
        {"id": "operator/sine", "parameters": {"dimension": 2}},
        {"id": "operator/sine", "parameters": {"offset": 0}},  # P < 0: positivity-lost
    ],
    formulations=with_controls(CONDUCTION + MOMENTUM_AND_WORK),
    discretisation={
        "face_weight": "campbell", "closure": ["interpolated", "one-sided"],
        "layout": {"id": "jittered", "amplitude": 0.2, "seed": 7},
    },
    resolution=[8, 12, 16], smoothing_exponent=0.5, measure=["error", "cost"],
)  # fmt: skip
PLANE_STUDY = small_study(
    name="2d",
    cases=[{"id": "conduction/manufactured", "parameters": {"dimension": 2, "final_time": 0.002}}],
    formulations=CONDUCTION, resolution=[8, 10, 12], measure=ALL_MEASURES,
)  # fmt: skip
UNSTABLE_STUDY = small_study(
    name="unstable",
    cases=[{"id": "conduction/slab-dirichlet", "parameters": {"final_time": 0.3}}],
    formulations=["conduction/campbell-flux"],
    discretisation={"smoothing_ratio": 0.7, "layout": {"id": "jittered", "amplitude": 0.4, "seed": 1}},
    resolution=[20, 30, 50], measure=ALL_MEASURES,
)  # fmt: skip


REPEATS_STUDY = small_study(
    name="repeats",
    cases=[SLAB, "operator/sine", {"id": "hydro/piston-velocity", "parameters": {"final_time": 0.01}}],
    formulations=["conduction/brookshaw", "momentum/p-rho2"],
    discretisation=None,
    resolution=[8, 16], measure=["error", "cost"], repeat={"most": 9, "least": 7, "spread": 1e-9, "seconds": 100},
)  # fmt: skip


class SchemasThemselves(unittest.TestCase):
    def test_the_schemas_of_all_documents_are_there_and_valid(self):
        for document in ("study", "results", "state", "rates"):
            self.assertIn(f"sphverify-{document}-1", SCHEMAS)
        for name, schema in SCHEMAS.items():
            with self.subTest(schema=name):
                jsonschema.Draft202012Validator.check_schema(schema)
                self.assertEqual(schema["$schema"], "https://json-schema.org/draft/2020-12/schema")
                self.assertTrue(schema["$id"].endswith(f"/{name}.schema.json"))
                self.assertTrue(schema["title"] and schema["description"])

    def test_every_key_has_a_description(self):
        def walk(schema, place, definitions):
            if isinstance(schema, list):
                for one in schema:
                    walk(one, place, definitions)
            if not isinstance(schema, dict):
                return
            if schema.get("additionalProperties") is False:
                for key, value in schema.get("properties", {}).items():
                    described = "description" in value or (
                        value.get("$ref", "").startswith("#/$defs/")
                        and "description" in definitions[value["$ref"].removeprefix("#/$defs/")]
                    ) or set(value) == {"const"}
                    self.assertTrue(described, f"{place}.{key}")
            for key, value in schema.items():
                walk(value, f"{place}.{key}", definitions)

        for name, schema in SCHEMAS.items():
            walk(schema, name, schema.get("$defs", {}))


class RealDocuments(ProgramTest):
    def check_results(self, study):
        """Input and output of a study are valid, and what no schema can say of the numbers holds."""
        self.assert_valid("sphverify-study-1", study)
        results = self.study(study)
        self.assert_valid("sphverify-results-1", results)
        self.assertTrue(results["runs"] and results["series"])
        for run in results["runs"]:
            for regions in run["errors"].values():
                for error in regions.values():
                    for norms in (error, error["scale"]):
                        self.assertLessEqual(norms["l1"], norms["l2"])
                        self.assertLessEqual(norms["l2"], norms["linf"])
        listed = sorted(index for series in results["series"] for index in series["runs"])
        self.assertEqual(listed, list(range(len(results["runs"]))), "every run is in one series")
        return results

    def assert_measured(self, results):
        self.assertEqual({run["status"] for run in results["runs"]}, {"ok"})
        for run in results["runs"]:
            self.assertTrue({"profile", "history", "spectrum"} <= set(run))
            self.assertIsNotNone(run["cost"])
            self.assertIsNotNone(run["stability"])
            self.assertIsNotNone(run["conservation"]["energy"])

    def test_all_measures_with_every_conduction_form_density_and_layout(self):
        results = self.check_results(DISCRETISATION_STUDY)
        self.assertEqual(len(results["runs"]), 6 * 3 * 3 * 3)
        self.assert_measured(results)
        jittered = [s for s in results["series"] if s["discretisation"]["layout"] != "lattice"]
        self.assertTrue(all(len(series["runs"]) == 6 for series in jittered), "seeds are replicates")

    def test_all_measures_with_every_conduction_case_and_integrator(self):
        results = self.check_results(CASES_STUDY)
        self.assertEqual(len(results["runs"]), 6 * 2 * 2 * 2)
        self.assert_measured(results)

    def test_profile_history_and_spectrum_are_stored_only_when_asked_for(self):
        results = self.check_results(small_study(measure=["error", "conservation", "cost", "stability"]))
        for run in results["runs"]:
            self.assertFalse({"profile", "history", "spectrum"} & set(run))

    def test_operator_cases_in_1d_and_2d_with_all_schemes_and_a_lost_positivity(self):
        results = self.check_results(OPERATOR_STUDY)
        statuses = {run["status"] for run in results["runs"]}
        self.assertEqual(statuses, {"ok", "positivity-lost"})
        self.assertEqual({run["formulation"] for run in results["runs"]}, set(CONDUCTION + MOMENTUM_AND_WORK))
        self.assertTrue(results["skipped"])

    def test_runs_of_every_kind_are_repeated_until_the_median_is_known(self):
        results = self.check_results(REPEATS_STUDY)
        self.assertEqual(results["study"]["repeat"], REPEATS_STUDY["repeat"])
        self.assertEqual({run["case"] for run in results["runs"]},
                         {"conduction/slab-dirichlet", "operator/sine", "hydro/piston-velocity"})  # fmt: skip
        for run in results["runs"]:
            cost = run["cost"]
            self.assertEqual((cost["repeats"], cost["warm_up"]), (9, True))
            self.assertLessEqual(cost["seconds"], cost["low_seconds"])
            self.assertLess(cost["low_seconds"], cost["high_seconds"])
            self.assertTrue(cost["low_seconds"] <= cost["median_seconds"] <= cost["high_seconds"], cost)
            self.assertGreater(cost["busy"], 0)
            self.assertEqual(len(cost["round_seconds"]), 9)
            self.assertEqual(min(cost["round_seconds"]), cost["seconds"])
            self.assertEqual(cost["batch"] > 1, run["case"] == "operator/sine", "microseconds are timed together")
        # Those of one setting took turns, and no others.
        settings = {}
        for run in results["runs"]:
            setting = json.dumps([run[key] for key in ("case", "parameters", "discretisation", "smoothing_exponent", "resolution")])
            settings.setdefault(setting, []).append(run["cost"]["occasion"])
        self.assertTrue(any(len(occasions) > 1 for occasions in settings.values()))
        for occasions in settings.values():
            self.assertEqual(len(set(occasions)), 1)
            self.assertEqual(occasions[0] is None, len(occasions) == 1)
        self.assertEqual(len({occasions[0] for occasions in settings.values() if occasions[0]}),
                         sum(len(occasions) > 1 for occasions in settings.values()))  # fmt: skip
        for series in results["series"]:
            for target in series["time_to_error"]:
                if target["seconds"] is not None:
                    self.assertTrue(target["low_seconds"] <= target["median_seconds"] <= target["high_seconds"])
        table = strict_json(self.succeed("compare", self.folder / "results.json", "--format", "json"))
        self.assert_valid("sphverify-comparison-1", table)
        for row in table["series"]:
            self.assertTrue(row["low_seconds"] <= row["median_seconds"] <= row["high_seconds"])

    def test_a_grid_over_resolution_and_smoothing_ratio_has_a_surface(self):
        layouts = ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2]}]
        ratios = [0.95, 1.1, 1.3, 1.7, 2.3]
        grid = small_study(formulations=CONDUCTION,
                           discretisation={"layout": layouts, "smoothing_ratio": ratios},
                           resolution=[8, 12, 16, 24], measure=["error", "cost"])  # fmt: skip
        results = self.check_results(grid)
        fields = {(s["formulation"], s["discretisation"]["layout"] == "lattice", s["field"])
                  for s in results["surfaces"]}  # fmt: skip
        self.assertEqual(len(fields), len(results["surfaces"]))
        # The flux forms have a flux beside their temperature.
        self.assertEqual(len(fields), 2 * (1 + 2 + 2))
        for surface in results["surfaces"]:
            self.assertEqual([b["resolution"] for b in surface["best"]], [8, 12, 16, 24])
            self.assertEqual([(c["resolution"], c["smoothing_ratio"]) for c in surface["cells"]],
                             [(n, r) for n in (8, 12, 16, 24) for r in ratios])  # fmt: skip
            for best in surface["best"]:
                cells = [c for c in surface["cells"] if c["resolution"] == best["resolution"]]
                self.assertEqual(best["grid_error"], min(c["error"] for c in cells))
            self.assertTrue(surface["reason"])
            self.assertEqual(surface["law"] is None, surface["model"] is None)
        self.assertTrue(any(surface["law"] for surface in results["surfaces"]))
        compared = strict_json(self.succeed("compare", "results.json", "--format", "json"))
        self.assert_valid("sphverify-comparison-1", compared)
        self.assertEqual([s["surface"] for s in compared["surfaces"]], results["surfaces"])
        text = self.succeed("compare", "results.json", "--section", "surface")
        self.assertIn("Which h/dx at which N: l2 error of temperature, region all", text)
        csv = self.succeed("compare", "results.json", "--section", "surface", "--format", "csv").splitlines()
        self.assertEqual(len(csv), 1 + 4 * len(results["surfaces"]))
        self.assertNotIn("surfaces", self.check_results(small_study()))

    def test_few_repeats_have_a_median_but_no_interval(self):
        results = self.check_results(small_study(repeat={"most": 3}))
        for run in results["runs"]:
            self.assertEqual(run["cost"]["repeats"], 3)
            self.assertGreaterEqual(run["cost"]["median_seconds"], run["cost"]["seconds"])
            self.assertIsNone(run["cost"]["low_seconds"])

    def test_a_gas_that_is_timed_once_is_not_run_again_for_it(self):
        gas = {"cases": ["hydro/piston-velocity"], "formulations": ["momentum/p-rho2"], "discretisation": None}
        for repeat in (1, {"seconds": 1e-9}):
            for run in self.check_results(small_study(repeat=repeat, **gas))["runs"]:
                self.assertEqual((run["cost"]["repeats"], run["cost"]["warm_up"]), (1, False))
                self.assertEqual(run["cost"]["median_seconds"], run["cost"]["seconds"])

    def test_manufactured_conduction_in_2d(self):
        results = self.check_results(PLANE_STUDY)
        self.assertEqual({run["particles"] for run in results["runs"]}, {64, 100, 144})
        self.assertEqual({len(x) for run in results["runs"] for x in run["profile"]["position"]}, {2})

    def test_an_unstable_run_is_a_result_with_status_reason_and_verdict(self):
        results = self.check_results(UNSTABLE_STUDY)
        finest = results["runs"][-1]
        self.assertEqual(finest["status"], "unstable")
        self.assertTrue(finest["reason"])
        self.assertEqual(finest["errors"], {})
        self.assertGreater(finest["stability"]["spectral_abscissa"], 0)
        self.assertEqual({order["verdict"] for order in results["series"][0]["orders"]}, {"diverging"})

    def test_a_run_out_of_time_and_one_that_makes_no_sense_are_results_too(self):
        results = self.check_results(small_study(time_budget=1e-9))
        self.assertEqual({run["status"] for run in results["runs"]}, {"timed-out"})
        plane = {"id": "conduction/manufactured", "parameters": {"dimension": 2}}
        senseless = small_study(cases=[plane], resolution=[1, 2])
        results = self.check_results(senseless)
        self.assertEqual({run["status"] for run in results["runs"]}, {"invalid"})
        said = self.run_program("study", self.write("senseless.json", senseless), "-o", self.folder / "senseless.out").stderr
        for reason in {run["reason"] for run in results["runs"]}:
            count = sum(run["reason"] == reason for run in results["runs"])
            self.assertIn(f"invalid: {count} of {len(results['runs'])} runs: {reason}\n", said)

    def test_rates_that_overflow_are_null_and_their_run_not_ok(self):
        # K T/(rho dx^2) with wave numbers of a thousand: beyond 1e308.
        values = {"conductivity": 1e100, "density": 1e-100, "left": 1e100, "modes": [[1000, 1e100]], "final_time": 1e-100}
        overflow = {"id": "conduction/slab-dirichlet", "parameters": values}
        forms = ["conduction/lucy-flux", "conduction/campbell-flux"]
        results = self.study(small_study(cases=[overflow], formulations=forms, resolution=[10, 20, 40]))
        self.assert_valid("sphverify-results-1", results)
        self.assertEqual({run["status"] for run in results["runs"]}, {"non-finite"})

    def test_a_momentum_form_with_partners_is_a_valid_study_and_skipped_on_conduction(self):
        partners = {"id": "momentum/p-rho2", "work": "work/total-energy", "conduction": "conduction/brookshaw"}
        study = small_study(formulations=["conduction/brookshaw", partners])
        self.assert_valid("sphverify-study-1", study)
        results = self.study(study)
        self.assert_valid("sphverify-results-1", results)
        self.assertEqual({run["formulation"] for run in results["runs"]}, {"conduction/brookshaw"})
        self.assertEqual(len(results["skipped"]), 1)

    def test_the_study_in_the_results_runs_again_as_the_same_study(self):
        study = self.study(small_study())["study"]
        self.assert_valid("sphverify-study-1", study)
        self.assertEqual(self.study(study, "again.json")["study"], study)

    def test_the_studies_that_ship_with_the_program_are_valid(self):
        for path in sorted((SOURCE_DIR / "cases" / "studies").glob("*.json")):
            with self.subTest(study=path.name):
                self.assert_valid("sphverify-study-1", strict_json(path.read_text()))

    def test_reference_states_and_their_rates(self):
        count = 0
        for path in sorted((SOURCE_DIR / "tests" / "data").glob("operators-*.json")):
            for reference in strict_json(path.read_text()):
                self.assert_valid("sphverify-state-1", reference["state"])
                for change in ({}, {"closure": "one-sided"}, {"face_weight": "balanced"}, {"walls": []}):
                    state = reference["state"] | change
                    rates = strict_json(self.succeed("evaluate", "-", text=json.dumps(state)))
                    self.assert_valid("sphverify-rates-1", rates)
                    count += 1
        self.assertEqual(count, 4 * 8)

    def test_rates_with_an_undefined_scheme_and_with_overflow(self):
        path = SOURCE_DIR / "tests" / "data" / "operators-1d.json"
        state = strict_json(path.read_text())[0]["state"]
        for pressure in (-1.0, 1e308):
            changed = mutated(state, ("particles", "pressure", 0), pressure)
            self.assert_valid("sphverify-state-1", changed)
            rates = strict_json(self.succeed("evaluate", "-", text=json.dumps(changed)))
            self.assert_valid("sphverify-rates-1", rates)

    def test_list_and_describe(self):
        lists = strict_json(self.succeed("list", "--json"))
        self.assert_valid("sphverify-list-1", lists)
        self.assert_valid("sphverify-list-1", strict_json(self.succeed("list", "cases", "--json")))
        for kind in lists.keys() - {"schema"}:
            for entry in lists[kind]:
                with self.subTest(id=entry["id"]):
                    described = strict_json(self.succeed("describe", entry["id"], "--json"))
                    self.assert_valid("sphverify-description-1", described)

    def test_exact_and_compare(self):
        exact = self.succeed("exact", "conduction/marshak", "--time", 0.1, "--points", "0,0.5,1")
        self.assert_valid("sphverify-exact-1", strict_json(exact))
        self.study(small_study(formulations=with_controls(CONDUCTION)))
        table = self.succeed("compare", "results.json", "--format", "json")
        self.assert_valid("sphverify-comparison-1", strict_json(table))


class WrongDocumentsAreRejected(ProgramTest):
    """Each mutation breaks one rule of the contract in a document that is valid without it."""

    def assert_rejected(self, schema, document, mutations):
        self.assert_valid(schema, document)
        for what, changed in mutations.items():
            with self.subTest(mutation=what):
                self.assertTrue(complaints(schema, changed), "the schema accepts it")

    def test_results(self):
        results = self.study(small_study(resolution=[10, 14, 18], measure=ALL_MEASURES))

        def put(value, *path):
            return mutated(results, path, value)

        def drop(*path):
            return without(results, path)

        orders = ("series", 0, "orders", 0)
        error = ("runs", 0, "errors", "temperature")
        self.assert_rejected("sphverify-results-1", results, {
            "another schema": put("sphverify-results/2", "schema"),
            "no context": drop("context"),
            "no skipped": drop("skipped"),
            "a key nobody knows": put(1, "extra"),
            "runs as an object": put({}, "runs"),
            "a date without time": put("2026-11-22", "context", "date"),
            "half a core": put(0.5, "context", "cores"),
            "a status not in the list": put("crashed", "runs", 0, "status"),
            "a failure without a reason": put("unstable", "runs", 0, "status"),
            "a run without status": drop("runs", 0, "status"),
            "a run without cost": drop("runs", 0, "cost"),
            "a run with an extra key": put(1, "runs", 0, "remarks"),
            "walls as a boolean": put(True, "runs", 0, "walls"),
            "an identifier without a room": put("brookshaw", "runs", 0, "formulation"),
            "resolution as a string": put("16", "runs", 0, "resolution"),
            "a negative resolution": put(-16, "runs", 0, "resolution"),
            "half a particle": put(16.5, "runs", 0, "particles"),
            "negative spacing": put(-0.1, "runs", 0, "spacing"),
            "a list in the discretisation of a run": put(["given"], "runs", 0, "discretisation", "density"),
            "an unknown density": put("guessed", "runs", 0, "discretisation", "density"),
            "jitter without a seed": put({"id": "jittered", "amplitude": 0.1}, "runs", 0, "discretisation", "layout"),
            "jitter of a whole spacing":
                put({"id": "jittered", "amplitude": 1, "seed": 1}, "runs", 0, "discretisation", "layout"),
            "an unknown field": put({}, "runs", 0, "errors", "entropy"),
            "an unknown region": put(results["runs"][0]["errors"]["temperature"]["all"], *error, "edge"),
            "a negative error": put(-1e-3, *error, "all", "l2"),
            "an error as a string": put("1e-3", *error, "all", "l2"),
            "an error without linf": drop(*error, "all", "linf"),
            "an error without scale": drop(*error, "all", "scale"),
            "a negative scale": put(-1, *error, "all", "scale", "l1"),
            "no energy budget key": drop("runs", 0, "conservation", "energy"),
            "a budget without drift": drop("runs", 0, "conservation", "energy", "drift"),
            "an unknown budget": put(None, "runs", 0, "conservation", "charge"),
            "a wall flux without its error": drop("runs", 0, "wall_flux", 0, "error"),
            "negative seconds": put(-1, "runs", 0, "cost", "seconds"),
            "fractional steps": put(1.5, "runs", 0, "cost", "steps"),
            "a negative spectral radius": put(-1, "runs", 0, "stability", "spectral_radius"),
            "an eigenvalue without imaginary part": put([[1.0]], "runs", 0, "spectrum"),
            "passes counted zero times": put(0, "runs", 0, "scene", "pass_counts", "kernel"),
            "scene without fields": drop("runs", 0, "scene", "fields"),
            "a verdict not in the list": put("convergent", *orders, "verdict"),
            "a norm not in the list": put("l3", *orders, "norm"),
            "an interval of one number": put([1.0], *orders, "interval"),
            "an interval of null": put([None, None], *orders, "interval"),
            "order as a string": put("1", *orders, "order"),
            "a series without time_to_error": drop("series", 0, "time_to_error"),
            "a series with a seed": put(
                {"id": "jittered", "amplitude": 0.1, "seed": 1}, "series", 0, "discretisation", "layout"),
            "a series of no runs": put([], "series", 0, "runs"),
            "a run twice in a series": put([0, 0], "series", 0, "runs"),
            "a negative index": put([-1], "series", 0, "runs"),
            "a skip without a reason": put([{"case": "conduction/marshak", "formulation": "x"}], "skipped"),
            "a broken study inside": put("x", "study", "resolution"),
        })  # fmt: skip

    def test_study(self):
        study = DISCRETISATION_STUDY
        case = {"id": "conduction/slab-dirichlet"}
        self.assert_rejected("sphverify-study-1", study, {
            "another schema": study | {"schema": "sphverify-results/1"},
            "no cases": without(study, ["cases"]),
            "an empty list of cases": study | {"cases": []},
            "an unknown key": study | {"resolutions": [1]},
            "name as a number": study | {"name": 1},
            "a negative resolution": study | {"resolution": -10},
            "a fractional resolution": study | {"resolution": 10.5},
            "a resolution as a string": study | {"resolution": "10"},
            "a resolution twice": study | {"resolution": [10, 10]},
            "a case without an identifier": study | {"cases": [{"parameters": {}}]},
            "a case with an unknown key": study | {"cases": [case | {"parameter": {}}]},
            "a parameter that is null": study | {"cases": [case | {"parameters": {"left": None}}]},
            "walls as a boolean": study | {"formulations": [{"id": "conduction/brookshaw", "walls": False}]},
            "a partner from the wrong room":
                study | {"formulations": [{"id": "momentum/p-rho2", "work": "conduction/brookshaw"}]},
            "an unknown density": study | {"discretisation": {"density": "guessed"}},
            "a negative ratio": study | {"discretisation": {"smoothing_ratio": [-1]}},
            "an unknown layout": study | {"discretisation": {"layout": "quartz"}},
            "jitter without amplitude": study | {"discretisation": {"layout": {"id": "jittered", "seed": 1}}},
            "jitter with seed and seeds":
                study | {"discretisation": {"layout": {"id": "jittered", "amplitude": 0.1, "seed": 1, "seeds": [2]}}},
            "an unknown measure": study | {"measure": ["errors"]},
            "no threads": study | {"threads": 0},
            "no repeats": study | {"repeat": 0},
            "no repeats at most": study | {"repeat": {"most": 0}},
            "a spread beyond the median": study | {"repeat": {"spread": 1.5}},
            "a rule of repeats that is not known": study | {"repeat": {"maximum": 3}},
            "no time": study | {"time_budget": 0},
        })  # fmt: skip

    def test_state(self):
        state = strict_json((SOURCE_DIR / "tests" / "data" / "operators-1d.json").read_text())[0]["state"]
        particles = state["particles"]
        self.assert_rejected("sphverify-state-1", state, {
            "another schema": state | {"schema": "sphverify-rates/1"},
            "four dimensions": state | {"dimension": 4},
            "positions of another dimension": state | {"dimension": 2},
            "no particles": without(state, ["particles"]),
            "N = 0": state | {"particles": particles | {"position": [], "mass": [], "density": []}},
            "no mass": without(state, ["particles", "mass"]),
            "mass zero": mutated(state, ("particles", "mass", 0), 0),
            "negative density": mutated(state, ("particles", "density", 0), -1),
            "density by an unknown rule": mutated(state, ("particles", "density"), "given"),
            "pressure as a string": mutated(state, ("particles", "pressure", 0), "1"),
            "pressure null": mutated(state, ("particles", "pressure", 0), None),
            "a velocity that is no vector": mutated(state, ("particles", "velocity", 0), 1.0),
            "h zero": mutated(state, ("particles", "smoothing_length"), 0),
            "an unknown field": mutated(state, ("particles", "entropy"), particles["pressure"]),
            "an unknown face weight": state | {"face_weight": "approximate"},
            "a wall without a normal": without(state, ["walls", 0, "outward_normal"]),
            "a wall with temperature but no conductivity": without(state, ["walls", 0, "conductivity"]),
            "a wall flux that is no vector": mutated(state, ("walls", 0, "flux"), 0.4),
            "an unknown wall value": mutated(state, ("walls", 0, "density"), 1),
        })  # fmt: skip

    def test_rates(self):
        state = strict_json((SOURCE_DIR / "tests" / "data" / "operators-2d.json").read_text())[0]["state"]
        rates = strict_json(self.succeed("evaluate", "-", text=json.dumps(state)))
        momentum = ("rates", "momentum/p-rho2")
        self.assert_rejected("sphverify-rates-1", rates, {
            "another schema": rates | {"schema": "sphverify-state/1"},
            "no density": without(rates, ["density"]),
            "no walls": without(rates, ["walls"]),
            "an extra key": rates | {"context": {}},
            "a wall without face weights": without(rates, ["walls", 0, "face_weight"]),
            "a scheme from no room": mutated(rates, ("rates", "brookshaw"), {"heating": [0.0]}),
            "heating of a momentum form": mutated(rates, momentum, {"heating": [0.0]}),
            "acceleration as scalars": mutated(rates, (*momentum, "acceleration"), [0.0]),
            "null without a reason": mutated(rates, momentum, {"acceleration": None}),
            "a reason without null": mutated(rates, (*momentum, "reason"), "none"),
            "a number as a string": mutated(rates, ("rates", "work/total-energy", "heating", 0), "0"),
        })  # fmt: skip

    def test_the_parser_of_these_tests_refuses_nan_and_infinity(self):
        for literal in ("NaN", "Infinity", "-Infinity"):
            with self.subTest(literal=literal), self.assertRaises(ValueError):
                strict_json(f'{{"schema": "sphverify-results/1", "runs": [{literal}]}}')


if __name__ == "__main__":
    unittest.main(verbosity=2)
