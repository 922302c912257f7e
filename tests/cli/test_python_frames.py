# SPDX-License-Identifier: GPL-3.0-or-later
"""Data frames of python/sphverify: every cell is a value of the document, and every value has its cell."""

import sys

sys.dont_write_bytecode = True

import json
import re
import unittest

from program import PROGRAM, SCHEMAS, SOURCE_DIR, ProgramTest
from python_module import LARGEST_SEED, STUDIES, cells, document_of, pandas, path_of, results_of, sphverify

NORMS = ("l1", "l2", "linf")
TEXTS = ("parameters", "layout", "viscosity")  # objects, which stand as text beside their keys
ONE_CELL = ("remarks", "scene.fields", "scene.passes", "cost.round_seconds", "pairwise", "runs", "points")
OWN_FRAMES = ("errors", "profile", "history", "spectrum", "orders", "time_to_error", "levels", "targets")


def tuples(value):
    if isinstance(value, dict):
        value = list(value.values())
    return tuple(map(tuples, value)) if isinstance(value, list) else value


def expected(value, steps=()):
    """Cells of a record by the names that docs/python.md gives them."""
    name = ".".join(map(str, steps)).removeprefix("discretisation.")
    if value is None or name in OWN_FRAMES or name == "stability.modes" or name.endswith("layout.id"):
        return {}
    if name in ONE_CELL or (isinstance(value, list) and steps[0] == "parameters"):
        return {name: tuples(value)}
    if isinstance(value, dict):
        inner = value.items()
    elif isinstance(value, list):
        inner = zip(("lower", "upper"), value) if steps[-1] == "interval" else enumerate(value)
    else:
        return {name: value}
    found = {}
    for step, one in inner:
        found |= expected(one, (*steps, step))
    return found


def or_missing(value):
    return {} if value is None else value


class Frames(unittest.TestCase):
    maxDiff = 4000

    def assert_row(self, row, found):
        """All cells of a row but texts of objects are what was found in the document, and nothing else is there."""
        there = {name: value for name, value in cells(row).items() if name not in TEXTS or name in found}
        self.assertEqual(there, found)

    def test_a_run_has_a_cell_for_every_value(self):
        for name in STUDIES:
            document, results = document_of(name), results_of(name)
            self.assertEqual(list(results.runs.index), list(range(len(document["runs"]))))
            series_of = {run: index for index, series in enumerate(document["series"]) for run in series["runs"]}
            for index, run in enumerate(document["runs"]):
                with self.subTest(document=name, run=index):
                    found = expected(run) | ({"series": series_of[index]} if index in series_of else {})
                    self.assert_row(results.runs.loc[index], found)

    def test_levels_are_the_errors_of_runs(self):
        columns = ["run", "field", "region", "norm", "error", "scale", "initial", "mean", "round_off", "allowed"]
        for name in STUDIES:
            found = []
            for index, run in enumerate(document_of(name)["runs"]):
                of_run = [
                    [index, field, region, norm, e[norm], e["scale"][norm], e["initial"][norm], e.get("mean"), e["round_off"],
                     e.get("allowed", {}).get(norm)]
                    for field, regions in run["errors"].items() for region, e in regions.items() for norm in NORMS
                ]  # fmt: skip
                found += of_run or [[index] + [None] * 9]
            levels = results_of(name).levels
            rows = levels[columns].astype(object).where(levels[columns].notna(), None).values.tolist()
            self.assertEqual(rows, found, name)

    def test_levels_say_what_they_are_of(self):
        for name in STUDIES:
            results = results_of(name)
            levels = results.levels.set_index("run")
            shared = [column for column in results.runs if column in levels]
            self.assertLessEqual({"case", "label", "layout", "viscosity", "resolution", "status", "series"}, set(shared))
            for run, row in results.runs.iterrows():
                for _, level in levels.loc[[run]].iterrows():
                    self.assertEqual(cells(level[shared]), cells(row[shared]))

    def test_series_have_orders_and_ladders_as_the_document_says_them(self):
        document, results = document_of("heat"), results_of("heat")
        frames = {"series": [], "ladders": [], "targets": [], "time_to_error": []}
        for index, series in enumerate(document["series"]):
            head = expected(series) | {"series": index, "is_timed_apart": False}
            for order in series["orders"]:
                where = head | {key: order[key] for key in ("field", "region", "norm")}
                frames["series"].append(where | expected(order))
                frames["ladders"] += [where | expected(level) for level in order["levels"]]
                frames["targets"] += [where | expected(target) for target in order["targets"]]
            frames["time_to_error"] += [head | expected(time) for time in series["time_to_error"]]
        for name, rows in frames.items():
            frame = getattr(results, name)
            self.assertEqual(len(frame), len(rows))
            self.assertGreater(len(rows), 0)
            for (_, row), found in zip(frame.iterrows(), rows):
                with self.subTest(frame=name):
                    self.assert_row(row, found)

    def test_envelopes_and_what_was_skipped(self):
        envelopes = document_of("envelope")["envelopes"]
        frame = results_of("envelope").envelopes
        self.assertEqual(len(frame), len(envelopes))
        for (_, row), envelope in zip(frame.iterrows(), envelopes):
            self.assert_row(row, expected(envelope))
        self.assertEqual(frame["points"][0], tuple((p["value"], p["status"]) for p in envelopes[0]["points"]))
        self.assertEqual(len(results_of("envelope").series), 0)
        skipped = document_of("gas")["skipped"]
        self.assertGreater(len(skipped), 0)
        self.assertEqual(results_of("gas").skipped.to_dict("records"), skipped)

    def test_profiles_histories_spectra_and_modes(self):
        for name, run in (("heat", 3), ("gas", 2), ("gas", 4)):
            record, results = document_of(name)["runs"][run], results_of(name)
            profile = results.profile(run)
            vectors = {"position", "velocity"}
            told = {"position": record["profile"]["position"]}
            told |= {f"{of}.{field}": record["profile"][of][field] for of in ("computed", "exact") for field in record["profile"][of]}
            columns = {"weight": record["profile"]["weight"]}
            for path, values in told.items():
                for axis in range(len(values[0])):
                    is_vector = path.split(".")[-1] in vectors
                    columns[f"{path}.{axis}" if is_vector else path] = [of_particle[axis] for of_particle in values]
            for region, those in record["profile"]["regions"].items():
                columns[f"regions.{region}"] = [particle in those for particle in range(len(profile))]
            self.assertEqual({column: profile[column].tolist() for column in profile}, columns)

            history = results.history(run)
            columns = {}
            for key, values in record["history"].items():
                of_wall = enumerate(values) if values and isinstance(values[0], list) else ()
                columns |= {f"{key}.{wall}": list(over_time) for wall, over_time in of_wall} or {key: values}
            self.assertEqual({column: history[column].tolist() for column in history}, columns)
        spectrum = results_of("heat").spectrum(0)
        self.assertEqual(spectrum[["real", "imaginary"]].values.tolist(), document_of("heat")["runs"][0]["spectrum"])
        modes = document_of("modes")["runs"][0]["stability"]["modes"]
        self.assertGreater(len(modes), 0)
        self.assertEqual([cells(row) for _, row in results_of("modes").modes(0).iterrows()], list(map(expected, modes)))

    def test_what_a_run_does_not_have_is_said(self):
        with self.assertRaisesRegex(sphverify.Error, "gas.json: run 0 has no spectrum"):
            results_of("gas").spectrum(0)
        with self.assertRaisesRegex(sphverify.Error, "found no run 99, expected one of 0 to"):
            results_of("gas").history(99)

    def test_a_run_that_failed(self):
        results = results_of("gas")
        failed = results.runs[results.runs["status"] == "unstable"]
        self.assertGreater(len(failed), 0)
        self.assertTrue(failed["cost.seconds"].isna().all())
        self.assertRegex(failed["reason"].iloc[0], "the step collapsed")
        self.assertTrue(results.runs["reason"][results.runs["status"] == "ok"].isna().all())
        levels = results.levels[results.levels["run"].isin(failed.index)]
        self.assertEqual(list(levels["run"]), list(failed.index))
        self.assertTrue(levels[["field", "region", "norm", "error", "scale", "allowed"]].isna().all(axis=None))

    def test_numbers_are_numbers_where_all_are_missing(self):
        document = document_of("heat")
        for run in document["runs"]:
            run["cost"] = None
            for regions in run["errors"].values():
                regions["all"]["l2"] = None
        for series in document["series"]:
            for order in series["orders"]:
                order |= {"order": None, "interval": None, "floor": None, "law": None, "model": None}
                order["levels"][0]["error"] = None
        results = self.loaded(document)
        for frame, column in (
            (results.runs, "cost.seconds"), (results.runs, "cost.pair_interactions"),
            (results.levels.query("region == 'all' and norm == 'l2'"), "error"), (results.series, "order"),
            (results.series, "interval.lower"), (results.series, "floor.interval.upper"), (results.series, "law.exponent"),
            (results.ladders.query("resolution == 8"), "error"),
        ):  # fmt: skip
            self.assertEqual(frame[column].dtype, "float64", column)
            self.assertTrue(frame[column].isna().all(), column)
            self.assertGreater(len(frame), 0)
        self.assertTrue(results.runs["cost.machine"].isna().all())

    def test_a_level_that_lost_a_seed_is_no_mean_of_the_others(self):
        document = document_of("heat")
        of_series = next(series for series in document["series"] if len(series["runs"]) == 6)
        of_series["orders"][0]["levels"][1]["error"] = None
        ladders = self.loaded(document).ladders
        first = ladders[ladders["series"] == document["series"].index(of_series)].iloc[:3]
        self.assertEqual(list(first["error"].isna()), [False, True, False])

    def loaded(self, document):
        path = path_of("heat").parent / f"{self.id()}.json"
        path.write_text(json.dumps(document))
        return sphverify.load(path)

    def test_types(self):
        runs = results_of("heat").runs
        self.assertEqual(set(runs["layout.seed"].dropna()), {1, LARGEST_SEED})
        self.assertEqual(runs["layout.seed"].isna().sum(), (runs["layout"] == "lattice").sum())
        self.assertEqual(runs["resolution"].dtype, "int64")
        self.assertEqual(runs["cost.warm_up"].dtype, "bool")
        self.assertEqual(results_of("gas").runs["cost.warm_up"].dtype, "boolean")
        self.assertEqual(runs["parameters.final_time"].dtype, "float64")

    def test_objects_are_texts_that_one_can_group_by(self):
        heat, gas = results_of("heat").runs, results_of("gas").runs
        self.assertEqual(set(heat["layout"]), {"lattice", "jittered amplitude=0.3"})
        self.assertEqual(set(gas["viscosity"]), {"off", "riemann", "alpha=1 beta=2"})
        self.assertEqual(heat.groupby("series").ngroups, len(document_of("heat")["series"]))
        self.assertIn("modes=[[1, 1], [3, 0.5]]", heat["parameters"][0])
        self.assertIn("gamma=1.6666666666666667", gas["parameters"][0])  # all digits

    def test_units_and_vectors_are_those_of_the_program(self):
        told = SCHEMAS["sphverify-results-1"]["$defs"]["field"]["description"]
        self.assertEqual(sphverify.UNITS, dict(re.findall(r"(\w+) \[([^]]+)\]", told)))
        self.assertEqual(set(sphverify.UNITS), set(SCHEMAS["sphverify-results-1"]["$defs"]["field"]["enum"]))
        source = (SOURCE_DIR / "formulations" / "particles" / "field.hpp").read_text()
        vectors = set(re.findall(r'Field::(\w+), "\1", true', source))
        self.assertEqual(sphverify.units.VECTORS, vectors & set(sphverify.UNITS))


class AsTheProgramTellsThem(ProgramTest):
    """The program walks the same document for its own tables."""

    def test_levels(self):
        for name in ("heat", "gas", "modes"):
            theirs = sphverify.compare(path_of(name), section="levels", program=PROGRAM)
            ours = results_of(name).levels
            first = ours.drop_duplicates(["run", "field", "region"]).reset_index(drop=True)
            self.assertEqual(len(theirs), len(first))
            key = ["case", "formulation", "walls", "field", "region", "smoothing_ratio", "viscosity", "layout", "N"]
            first = first.rename(columns={"resolution": "N"})
            first["viscosity"] = first["viscosity"].str.replace("alpha=1 beta=2", "1 2")
            first["layout"] = first["layout"].str.replace("jittered amplitude=", "jitter ")
            for norm in NORMS:
                wide = ours[ours["norm"] == norm].set_index(["run", "field", "region"])
                for theirs_name, column in ((norm, "error"), (f"scale_{norm}", "scale"), (f"initial_{norm}", "initial")):
                    values = wide[column].reindex(pandas.MultiIndex.from_frame(first[["run", "field", "region"]]))
                    first[theirs_name] = values.to_numpy()
            columns = [*key, *NORMS, *(f"scale_{n}" for n in NORMS), *(f"initial_{n}" for n in NORMS), "mean", "round_off"]

            def comparable(frame):
                return sorted(tuple("" if pandas.isna(cell) else str(cell) for cell in row) for row in frame[columns].values)

            self.assertEqual(comparable(first), comparable(theirs))

    def test_orders(self):
        theirs = sphverify.compare(path_of("heat"), program=PROGRAM, region="wall", norm="linf")
        ours = results_of("heat").series.query("field == 'temperature' and region == 'wall' and norm == 'linf'")
        self.assertEqual(len(theirs), len(ours))
        columns = {"order": "order", "interval.lower": "order_low", "interval.upper": "order_high", "floor.value": "floor",
                   "floor.interval.lower": "floor_low", "verdict": "verdict", "smoothing_ratio": "smoothing_ratio"}  # fmt: skip
        ours = ours.rename(columns=columns)[list(columns.values())]

        def comparable(frame):
            return sorted(str(["" if pandas.isna(cell) else cell for cell in row]) for row in frame.values.tolist())

        self.assertEqual(comparable(ours), comparable(theirs[list(columns.values())]))


if __name__ == "__main__":
    unittest.main()
