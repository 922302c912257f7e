# SPDX-License-Identifier: GPL-3.0-or-later
"""Every column of every table that `sphverify compare` writes for programs, against numbers computed here from the
results documents. The documents are scrambled (scrambled.py), so that a number of another run, level or column is seen.
A column that is new fails until it is covered here."""

import sys

sys.dont_write_bytecode = True

import copy
import csv
import io
import itertools
import math
import re
import unittest

import reductions
from program import SCHEMAS, ProgramTest, environment, strict_json
from reductions import SETTINGS, leading_entry, parameters_text, setting_words
from scrambled import DRIVEN, GAS, GRID, HEAT, SLAB, break_run, scrambled

def name_of(entry, all_entries):
    """The formulation as tables name it: a partner only where the form has several of its kind."""
    bare = lambda id: re.sub("-energy$", "", id.split("/", 1)[1])  # noqa: E731
    name = bare(entry["formulation"])
    for kind in ("work", "conduction"):
        partners = {e[kind] for e in all_entries if e["formulation"] == entry["formulation"] and e[kind]}
        if entry[kind] and len(partners) > 1:
            name += f" + {bare(entry[kind])}"
    return name if entry["walls"] == "on" else f"{name} (walls off)"


class Columns(ProgramTest):
    @classmethod
    def setUpClass(cls):
        maker = cls()
        maker.setUp()
        try:
            cls.originals = {study["name"]: maker.study(study) for study in (HEAT, GAS, GRID, DRIVEN)}
        finally:
            maker.doCleanups()

    def runTest(self):
        """Lets `setUpClass` make an instance."""

    def scrambled(self, name, file=None, **options):
        """A document of ours with other numbers, written down."""
        document = scrambled(self.originals[name], **options)
        self.write(f"{file or name}.json", document)
        return document

    def tables(self, section, *arguments):
        """A section as rows of CSV and as what the JSON holds under its key."""
        text = self.succeed("compare", *arguments, "--section", section, "--format", "csv")
        rows = list(csv.reader(io.StringIO(text), strict=True))
        self.assertEqual(len(set(rows[0])), len(rows[0]), "columns have names of their own")
        document = strict_json(self.succeed("compare", *arguments, "--section", section, "--format", "json"))
        self.assert_valid("sphverify-comparison-1", document)
        key = {"surface": "surfaces"}.get(section, section)
        return [dict(zip(rows[0], row, strict=True)) for row in rows[1:]], document[key]

    def assert_cell(self, cell, value, message):
        """What CSV or JSON holds: a word, a number, or nothing where there is none."""
        if isinstance(value, bool):
            self.assertIn(cell, (value, str(value).lower()), message)
        elif isinstance(value, str):
            self.assertEqual(cell, value, message)
        elif value is None:
            self.assertIn(cell, (None, ""), message)
        else:
            is_number = re.fullmatch(r"-?[0-9.]+(e[-+]?[0-9]+)?", str(cell))
            self.assertTrue(is_number and math.isclose(float(cell), value, rel_tol=1e-12),
                            f"{message}: {cell}, expected {value}")  # fmt: skip

    def assert_rows(self, rows, expected, filled):
        """Every column of every row; notes in a set which columns were ever filled."""
        self.assertEqual(len(rows), len(expected))
        for row, numbers in zip(rows, expected):
            for column, cell in row.items():
                self.assertIn(column, numbers, f"nothing is known of column {column}")
                place = f"{column} of {' '.join(str(row[key]) for key in ('case', 'formulation', 'measure') if key in row)}"
                self.assert_cell(cell, numbers[column], place)
                if cell not in (None, ""):
                    filled.add(column)
            self.assertEqual(set(numbers), set(row), "columns are missing")

    def assert_filled(self, expected, filled):
        self.assertEqual(set(expected[0]) - filled, set(), "columns that no document here fills")

    # The ladders.

    def series_rows(self, document, name, region="all", norm=None):
        rows = []
        for series in document["series"]:
            entry = leading_entry(series, region, norm)
            finest = reductions.finest_of(document, series)
            words = {"results": name, "case": series["case"], "parameters": parameters_text(series["parameters"])}
            words |= {"formulation": series["label"], **setting_words(series)}
            words |= {"finest": str(finest[0]["resolution"]), "failures": reductions.failures_of(finest)}
            words |= {key: entry[key] if entry else "" for key in ("field", "norm", "verdict")}
            rows.append(words | reductions.series_numbers(document, series, region, norm))
        return rows

    def test_every_column_of_the_series(self):
        heat = self.scrambled("heat", settings=True)
        gas = self.scrambled("gas", settings=True)
        # Of each of two ladders a replicate of the finest level failed, of a third all.
        lost = [s["runs"] for s in heat["series"] if len(s["runs"]) == 4 and s["case"] == "conduction/slab-insulated"]
        for index, status in ((lost[0][-1], "unstable"), (lost[1][-2], "timed-out"), (lost[2][-1], "non-finite"),
                              (lost[2][-2], "unstable")):  # fmt: skip
            break_run(heat, index, status)
        # What is not known of one replicate, and where the exact field is 0.
        for key, runs in zip(("growing_modes", "spectral_abscissa", "spectral_radius", "unseen_modes"), lost[3:]):
            heat["runs"][runs[-1]]["stability"][key] = None
        for key in ("low_seconds", "busy"):
            heat["runs"][lost[0][-2]]["cost"][key] = None
        for run in heat["runs"]:
            for error in run["errors"].get("temperature", {}).values() if run["case"] == SLAB["id"] else ():
                error["scale"]["linf"], error["scale"]["l2"], error["scale"]["l1"] = 1.0, 0.0, 0.0
        self.write("heat.json", heat)
        filled = set()
        for options in ({}, {"region": "wall", "norm": "linf"}, {"region": "interior", "norm": "l1"}):
            arguments = [text for key, value in options.items() for text in (f"--{key}", value)]
            expected = self.series_rows(heat, "heat", **options) + self.series_rows(gas, "gas", **options)
            for rows in self.tables("series", "heat.json", "gas.json", *arguments):
                self.assert_rows(rows, expected, filled)
        self.assert_filled(expected, filled)

    # Every error of every run.

    def level_rows(self, document, name):
        rows = []
        for run in document["runs"]:
            errors = [(field, region, run["errors"][field][region])
                      for field in sorted(run["errors"]) for region in sorted(run["errors"][field])]  # fmt: skip
            settings = setting_words(run)
            numbers = {key: float(settings.pop(key)) for key in ("smoothing_ratio", "smoothing_exponent")}
            words = {"results": name, "case": run["case"], "label": run["label"], "formulation": run["formulation"]}
            words |= {"parameters": re.sub(" +", " ", parameters_text(run["parameters"]).replace(",", " "))}
            words |= {"work": run["work"] or "", "conduction": run["conduction"] or "", "walls": run["walls"]}
            words |= settings | {"status": run["status"]}
            numbers |= {"seed": reductions.seed_of(run["discretisation"]["layout"]), "N": run["resolution"]}
            numbers |= {key: run[key] for key in ("particles", "spacing", "smoothing_length")}
            numbers["seconds"] = run["cost"]["seconds"] if run["cost"] else None
            for field, region, error in errors or [("", "", {"scale": {}})]:
                row = words | numbers | {"field": field, "region": region}
                for norm in ("l1", "l2", "linf"):
                    row |= {norm: error.get(norm), f"scale_{norm}": error["scale"].get(norm)}
                    row[f"initial_{norm}"] = error.get("initial", {}).get(norm)
                rows.append(row | {"mean": error.get("mean"), "round_off": error.get("round_off")})
        return rows

    def test_every_column_of_the_levels(self):
        heat, gas = (self.scrambled(name, settings=True) for name in ("heat", "gas"))
        break_run(heat, 5, "unstable")
        self.write("heat.json", heat)
        expected, filled = self.level_rows(heat, "heat") + self.level_rows(gas, "gas"), set()
        for rows in self.tables("levels", "heat.json", "gas.json"):
            self.assert_rows(rows, expected, filled)
        self.assert_filled(expected, filled)

    # How far a parameter could be driven.

    def test_every_column_of_the_envelopes(self):
        driven = self.scrambled("driven")
        for envelope, (held, failed) in zip(driven["envelopes"], ((0.3, None), (None, 0.7))):
            envelope |= {"held": held, "failed": failed}
        for k, envelope in enumerate(driven["envelopes"]):
            envelope |= {"status": ("unstable", "ok", "non-finite")[k % 3], "reason": (f"reason {k}", None)[k % 2]}
            envelope["discretisation"] |= {"kernel": f"kernel-{k}", "closure": ("interpolated", "one-sided")[k % 2]}
        self.write("driven.json", driven)
        expected, filled = [], set()
        for envelope in driven["envelopes"]:
            seed = reductions.seed_of(envelope["discretisation"]["layout"]) or 0
            row = {"results": "driven", "case": envelope["case"], "parameters": parameters_text(envelope["parameters"])}
            row |= {"formulation": envelope["label"], **setting_words(envelope), "seed": str(seed)}
            row |= {"resolution": str(envelope["resolution"]), "parameter": envelope["parameter"]}
            row |= {"status": envelope["status"], "reason": envelope["reason"] or ""}
            row |= {"to": envelope["points"][0]["value"], "held": envelope["held"], "failed": envelope["failed"]}
            expected.append(row)
        for rows in self.tables("envelopes", "driven.json"):
            self.assert_rows(rows, expected, filled)
        self.assert_filled(expected, filled)

    # Which h/dx at which N.

    def surface_rows(self, document):
        rows = []
        for surface in document["surfaces"]:
            settings = setting_words(surface)
            del settings["smoothing_ratio"], settings["smoothing_exponent"]
            whole = {"results": "grid", "case": surface["case"], "parameters": parameters_text(surface["parameters"])}
            whole |= {"formulation": surface["label"], **settings, "field": surface["field"], "norm": surface["norm"]}
            whole |= {"misfit": surface["misfit"], "model": surface["model"] or "", "reason": surface["reason"]}
            for kind in ("smoothing", "sampling", "spacing", "neighbour"):
                whole |= ends_of(f"{kind}_exponent", surface[f"{kind}_exponent"])
            units, rules = ("pair_interactions", "seconds"), (("kept", 0), ("half", 0.5))
            for unit, (rule, exponent) in itertools.product(units, rules):
                path = next((p for p in surface["paths"] if p["unit"] == unit and p["points"]), {"rules": []})
                found = next((r for r in path["rules"] if r["exponent"] == exponent), {})
                for ratio in ("error_ratio", "cost_ratio"):
                    whole |= ends_of(f"{unit}_{rule}_{ratio}", found.get(ratio, {"value": None, "interval": None}))
            for best in surface["best"]:
                row = {"resolution": best["resolution"], "edge": best["edge"] or "", "error": best["error"]}
                row |= {"grid_smoothing_ratio": best["grid_ratio"], "grid_error": best["grid_error"]}
                rows.append(whole | row | ends_of("smoothing_ratio", best["ratio"]))
        return rows

    def test_every_column_of_the_surfaces(self):
        grid = self.scrambled("grid")
        self.assertTrue(any(path["rules"] for surface in grid["surfaces"] for path in surface["paths"]))
        grid["surfaces"][0]["best"][0]["ratio"] = {"value": None, "interval": None}
        grid["surfaces"][0] |= {"model": None, "reason": "none by hand"}
        self.write("grid.json", grid)
        rows, surfaces = self.tables("surface", "grid.json")
        expected, filled = self.surface_rows(grid), set()
        self.assert_rows(rows, expected, filled)
        self.assert_filled(expected, filled)
        self.assertEqual(surfaces, [{"results": "grid", "surface": surface} for surface in grid["surfaces"]])

    # The answer.

    def test_every_column_of_the_summary(self):
        for seed in (1, 2):
            heat = self.scrambled("heat", seed=seed)
            several = [series for series in heat["series"] if series["discretisation"]["layout"] == "lattice"]
            break_run(heat, several[0]["runs"][-1], "unstable")
            # What is rounding, what nobody knows, what has no order and what no run reached.
            for series, run in ((s, heat["runs"][s["runs"][-1]]) for s in several[1::3]):
                energy = run["conservation"]["energy"]
                if energy:
                    energy |= {"pair_drift": 1e-17, "drift": 2e-17, "initial": 1.0, "final": 1.0}
                for entry in series["orders"]:
                    entry |= {"order": None, "interval": None} if seed == 1 else {}
                for target in series["time_to_error"] if seed == 2 else ():
                    target |= dict.fromkeys(("seconds", "median_seconds", "low_seconds", "high_seconds"))
                if run["integration"] and seed == 2:
                    run["integration"]["time_error_share"] = None
                if run["stability"] and seed == 1:
                    run["stability"]["growing_modes"] = 0
            self.write("heat.json", heat)
            rows, groups = self.tables("summary", "heat.json")
            expected = summary_groups(heat, "heat", self.series_rows(heat, "heat"))
            self.assertEqual(len(groups), len(expected))
            filled = set()
            for group, (scenes, wanted) in zip(groups, expected):
                known = {"norm", "scenes", "sentences", "formulations"}
                self.assertEqual(set(group), known, "of other keys nothing is known")
                self.assertEqual(group["norm"], "l2")
                keys = ("case", "parameters", "layout", "field", "finest")
                self.assertEqual([tuple(scene[key] for key in keys) for scene in group["scenes"]], scenes)
                self.assertEqual({key for scene in group["scenes"] for key in scene}, set(keys))
                self.assert_rows(group["formulations"], wanted, filled)
                ranked = [row["name"] for row in wanted if not row["control"]]
                self.assertEqual([re.split(": | and | cannot", text)[0] for text in group["sentences"]], ranked)
            flat = []
            for number, (scenes, wanted) in enumerate(expected, 1):
                head = {"group": str(number), "cases": "; ".join(unique(scene[0].split("/")[1] for scene in scenes))}
                head["layouts"] = "; ".join(unique(scene[2] for scene in scenes))
                flat += [head | row for row in wanted]
            self.assert_rows(rows, flat, filled)
            self.filled = getattr(self, "filled", set()) | filled
        # Conduction alone: no wall of a moving gas gives an impulse.
        self.assert_filled(flat, self.filled | {"wall_impulse_defect"})

    def test_the_summary_of_a_moving_gas(self):
        gas = self.scrambled("gas")
        rows, groups = self.tables("summary", "gas.json")
        entries = []
        for group, (_, wanted) in zip(groups, summary_groups(gas, "gas", self.series_rows(gas, "gas")), strict=True):
            self.assert_rows(group["formulations"], wanted, set())
            self.assertTrue(all(row["wall_impulse_defect"] is not None for row in wanted))
            entries += group["formulations"]
        for row, entry in zip(rows, entries, strict=True):
            self.assert_cell(row["wall_impulse_defect"], entry["wall_impulse_defect"], "wall_impulse_defect")

    # What changed.

    def test_every_column_of_the_changes(self):
        measures, filled = set(), set()
        for name in ("heat", "gas", "driven"):
            before = self.scrambled(name, "before", seed=3)
            after = scrambled(self.originals[name], seed=4)
            for run, old in zip(after["runs"], before["runs"]):
                run["smoothing_length"] = old["smoothing_length"]
            if name == "heat":
                # One ladder's run fails, of another nobody knows the time error; a third repeats, a fourth has other
                # seeds.
                slabs = [k for k, s in enumerate(after["series"]) if s["case"] == SLAB["id"]]
                failing, reseeded, unknown, _, same = (after["series"][k] for k in slabs[:5])
                break_run(after, failing["runs"][-1], "unstable")
                after["runs"][unknown["runs"][-1]]["integration"]["time_error_share"] = None
                for index in same["runs"]:
                    after["runs"][index] = copy.deepcopy(before["runs"][index])
                after["series"][slabs[4]] = copy.deepcopy(before["series"][slabs[4]])
                self.assertEqual(len(reseeded["runs"]), 4, "two seeds on two levels")
                for index in reseeded["runs"]:
                    after["runs"][index]["discretisation"]["layout"]["seed"] += 10
                for entry, old in zip(reseeded["orders"], before["series"][slabs[1]]["orders"]):
                    for level, its in zip(entry["levels"], old["levels"]):
                        level["spread"] = its["spread"]
                # One that only one of the two has.
                del after["series"][-1]
                after["context"]["processor"] += " of another make"
            if name == "driven":
                bracket(before["envelopes"], after["envelopes"])
            self.write("before.json", before)
            self.write("after.json", after)
            rows, (changes,) = self.tables("changes", "before.json", "after.json")
            wanted = Changes(self, before, after)
            measures |= {change["measure"] for change in wanted.list}
            by_place = lambda row: [str(row[key]) for key in sorted(PLACE)]  # noqa: E731
            for found, number in ((changes["changes"], int), (rows, str)):
                head = {} if found is not rows else {"results": "after", "against": "before"}
                expected = [head | change | {"resolution": number(change["resolution"])} for change in wanted.list]
                self.assert_rows(sorted(found, key=by_place), sorted(expected, key=by_place), filled)
                sizes = [wanted.size_of(row) for row in found]
                for larger, smaller in zip(sizes, sizes[1:]):
                    self.assertGreaterEqual(larger * (1 + 1e-9), smaller, "the largest change first")
            whole = {key: value for key, value in changes.items() if key not in ("changes", "counts")}
            self.assertEqual(whole, wanted.whole)
            self.assertEqual({entry["measure"]: entry for entry in changes["counts"]}, wanted.counts)
        known = SCHEMAS["sphverify-comparison-1"]["$defs"]["measure"]["enum"]
        self.assertEqual(set(known) - measures, set(), "measures of which nothing changed here")
        self.assert_filled([expected[0]], filled)

    # The whole.

    def test_every_section_and_key_of_the_document_is_walked(self):
        known = {"summary", "series", "levels", "envelopes", "surface", "changes"}
        said = re.findall(r"(?m)^ +(\w+): ", self.succeed("compare", "--help", env=environment(COLUMNS="200")))
        self.assertEqual(set(said) - known, set(), "sections of which nothing is known")
        self.assertEqual(known - set(said), set())
        documents = {name: self.scrambled(name) for name in ("heat", "grid")}
        for k, document in enumerate(documents.values()):
            for key, value in document["context"].items():
                if isinstance(value, (int, str)):
                    document["context"][key] = value + k + 1 if isinstance(value, int) else f"{value} {key} {k}"
        for name, document in documents.items():
            self.write(f"{name}.json", document)
        arguments = ("compare", "heat.json", "grid.json", "--section", "levels", "--format", "json", "--norm")
        self.assertEqual(self.run_program(*arguments, "l1").returncode, 2, "levels are of all norms")
        table = strict_json(self.succeed(*arguments[:-1]))
        head = {"schema": "sphverify-comparison/1", "region": "all", "norm": "auto"}
        sections = {"summary", "series", "levels", "envelopes", "surfaces", "changes"}
        self.assertEqual(set(table), set(head) | sections | {"documents"}, "of other keys nothing is known")
        self.assertEqual({key: table[key] for key in head}, head)
        expected = [{"name": name, **document["context"]} for name, document in documents.items()]
        self.assertEqual(table["documents"], expected)
        options = ("--format", "json", "--norm", "linf", "--region", "wall")
        chosen = strict_json(self.succeed("compare", "heat.json", *options))
        self.assertEqual((chosen["region"], chosen["norm"]), ("wall", "linf"))


def ends_of(name, estimate):
    low, high = estimate["interval"] or (None, None)
    return {name: estimate["value"], f"{name}_low": low, f"{name}_high": high}


def unique(values):
    return list(dict.fromkeys(values))


# The answer, in plain form: docs/compare.md.


def summary_groups(document, name, series_rows):
    """The groups as (scenes, rows)."""
    series = document["series"]
    ladders = [Ladder(document, s, row) for s, row in zip(series, series_rows)]
    fields = {}  # of what failed on every level, what others have on the case
    for ladder in ladders:
        if ladder.row["field"]:
            fields.setdefault((ladder.row["case"], ladder.room), ladder.row["field"])
    for ladder in ladders:
        field = ladder.row["field"] or fields.get((ladder.row["case"], ladder.room), "")
        quantity = f"{ladder.room} {field}" if field == "heating" else field
        row = ladder.row
        ladder.scene = (row["case"], row["parameters"], row["layout"], quantity, int(row["finest"]))
        ladder.name = name_of(ladder.series, series)
    names = unique((ladder.room, ladder.name) for ladder in ladders)
    scenes = unique(ladder.scene for ladder in ladders)
    who = {scene: frozenset((ladder.room, ladder.name) for ladder in ladders
                            if ladder.scene == scene and not ladder.is_control) for scene in scenes}  # fmt: skip
    weight = lambda group: (len(group) > 1, len(group) * list(who.values()).count(group))  # noqa: E731
    groups = sorted(unique(who.values()), key=weight, reverse=True)
    result = []
    for group in groups:
        members = [scene for scene in scenes if who[scene] == group]
        rows = []
        for room, formulation in names:
            own = [ladder for ladder in ladders if (ladder.room, ladder.name) == (room, formulation)]
            if any(ladder.scene in members for ladder in own):
                rows.append(Formulation(own, scenes, members, name))
        rows.sort(key=lambda row: (row.is_control, score_of(row.ladders)))
        result.append((members, [row.words_and_numbers(rows, members) for row in rows]))
    return result


class Ladder:
    def __init__(self, document, series, row):
        self.series, self.row = series, row
        self.room = series["formulation"].split("/")[0]
        self.is_control = series["walls"] == "off"
        self.settings = {key: value for key, value in setting_words(series).items() if key != "layout"}
        finest = reductions.finest_of(document, series)
        kept = reductions.sound(finest)
        entry = leading_entry(series)
        of_field = [run["errors"][entry["field"]]["all"] for run in finest if entry and entry["field"] in run["errors"]]
        self.round_off = max((error["round_off"] for error in of_field), default=0.0)
        self.heat_crosses = any(abs(w["exact"]) > 1e-9 * w["scale"] for run in kept for w in run["wall_flux"])
        self.is_linearised = any(run["stability"] for run in finest)
        self.time_is_unknown = any(run["integration"] and reductions.share_of(run) is None for run in kept)
        self.half_width = 0.0
        levels = entry["levels"] if entry else []
        level = next((one for one in levels if one["resolution"] == int(row["finest"])), None)
        if level and level["spread"] and level["replicates"] > 1:
            n = level["replicates"]
            self.half_width = reductions.STUDENT[n - 1] * level["spread"] / math.sqrt(n)
        self.bound = reductions.target_of(series, entry, 0.01)["is_bound"] if entry else False
        self.outcome = "failed" if row["failures"] else "diverging" if row["verdict"] == "diverging" else "sound"
        self.unit = row["relative_error"] / row["error"] if row["relative_error"] is not None else 1.0
        known = self.outcome != "failed" and row["error"] is not None
        self.error = max(row["error"], self.round_off) * self.unit if known else None

    def uncertainty(self):
        share = min(self.row["time_error_share"] or 0.0, 1.0)
        return self.unit * (self.half_width + share * self.row["error"] + self.round_off)

    def against(self, other):
        """-1 where it is nearer than another by more than both intervals, 1 where it is further."""
        difference = self.error - other.error
        if self.time_is_unknown or other.time_is_unknown or abs(difference) <= self.uncertainty() + other.uncertainty():
            return 0
        return -1 if difference < 0 else 1


def score_of(ladders):
    """What did not run counts as failed."""
    errors = [math.log(ladder.error) for ladder in ladders if ladder and ladder.error is not None]
    failed = sum(ladder is None or ladder.outcome == "failed" for ladder in ladders)
    diverging = sum(ladder is not None and ladder.outcome == "diverging" for ladder in ladders)
    return failed, diverging, sum(errors) / len(errors) if errors else math.inf


class Formulation:
    """At the one setting that serves it best on all scenes."""

    def __init__(self, own, scenes, members, document_name):
        self.own, self.document_name = own, document_name
        self.is_control = own[0].is_control
        # What has one value only on a case is no choice there.
        case = lambda ladder: ladder.scene[:2]  # noqa: E731
        on_case = lambda key, of: {one.settings[key] for one in own if case(one) == case(of)}  # noqa: E731
        choices = lambda ladder: {k: v for k, v in ladder.settings.items() if len(on_case(k, ladder)) > 1}  # noqa: E731
        varied = unique(key for ladder in own for key in choices(ladder))
        best = None
        self.tried = 0
        for values in itertools.product(*(unique(ladder.settings[key] for ladder in own) for key in varied)):
            setting = dict(zip(varied, values))
            chosen = {ladder.scene: ladder for ladder in own if choices(ladder).items() <= setting.items()}
            self.tried += set(chosen) == {ladder.scene for ladder in own}
            score = score_of([chosen.get(scene) for scene in scenes])
            if best is None or score < best[0]:
                best = score, chosen
        self.ladders = [best[1].get(scene) for scene in members]

    def words_and_numbers(self, rows, scenes):
        ladders = self.ladders
        assert None not in ladders, "every setting here ran everywhere"
        first = next(iter(ladders))
        kept = [ladder for ladder in ladders if ladder.outcome != "failed"]
        get = lambda key: [ladder.row[key] for ladder in kept]  # noqa: E731
        row = {"results": self.document_name, "formulation": first.series["label"], "name": first.name, **first.settings}
        row |= {"control": self.is_control, "scenes": len(ladders), "settings_tried": self.tried, "missing": 0}
        row |= {word: sum(ladder.outcome == word for ladder in ladders) for word in ("failed", "diverging")}
        row |= self.errors(scenes) | self.against_first(rows) | self.times()
        known = [ladder.row for ladder in kept if ladder.row["order"] is not None]
        lowest = min(known, key=lambda r: r["order"]) if len(known) == len(kept) and known else {}
        row |= {key: lowest.get(key) for key in ("order", "order_low", "order_high")}
        floors = [ladder.row for ladder in kept if ladder.row["floor"] is not None]
        highest = max(floors, key=lambda r: r["floor"]) if floors else {}
        row |= {key: highest.get(key) for key in ("floor", "floor_low", "floor_high")}
        row["wall_flux_error"] = reductions.largest([one.row["wall_flux_error"] for one in kept if one.heat_crosses])
        row["wall_impulse_defect"] = reductions.largest(get("wall_impulse_defect"))
        drifts = [(abs(drift), rounding) for drift, rounding in zip(get("energy_pair_drift"), get("energy_rounding"))
                  if drift is not None]  # fmt: skip
        row["energy_pair_drift"] = reductions.largest([0.0 if d <= rounding else d for d, rounding in drifts])
        modes = [ladder.row["growing_modes"] for ladder in ladders if ladder.is_linearised]
        row["growing_modes"] = reductions.known_or_above_zero(modes)
        return row

    def errors(self, scenes):
        known = [(ladder.error, k) for k, ladder in enumerate(self.ladders) if ladder.error is not None]
        if not known:
            return {"error": None, "worst_error": None, "worst_scene": ""}
        worst, where = max(known)
        case, _, layout = scenes[where][:3]
        scene = case.split("/")[1] + (f", {layout}" if len({s[2] for s in scenes}) > 1 else "")
        mean = math.exp(sum(math.log(error) for error, _ in known) / len(known))
        return {"error": mean, "worst_error": worst, "worst_scene": scene}

    def against_first(self, rows):
        """Where both are sound; and on how many scenes it is nearer than all others but controls."""
        is_sound = lambda ladder: ladder.outcome == "sound" and ladder.error is not None  # noqa: E731
        pairs = [(a, b) for a, b in zip(self.ladders, rows[0].ladders) if is_sound(a) and is_sound(b)]
        told = [a.against(b) for a, b in pairs]
        names = (("nearer_than_first", -1), ("alike_first", 0), ("further_than_first", 1))
        result = {name: told.count(sign) for name, sign in names}
        ratios = [a.error / b.error for a, b in pairs]
        result["error_ratio"] = math.exp(sum(map(math.log, ratios)) / len(ratios)) if ratios else None
        result |= {"smallest_error_ratio": min(ratios, default=None), "largest_error_ratio": max(ratios, default=None)}
        others = [row for row in rows if row is not self and not row.is_control]
        result["nearest"] = 0 if self.is_control else sum(
            is_sound(ladder) and all(ladder.against(row.ladders[k]) < 0 for row in others if is_sound(row.ladders[k]))
            for k, ladder in enumerate(self.ladders)
        )  # fmt: skip
        return result

    def times(self):
        times = [(ladder.row["seconds_to_1_percent"], ladder.bound) for ladder in self.ladders]
        reached = [time for time in times if time[0] is not None]
        result = {"reach_1_percent": len(reached), "seconds_to_1_percent": None, "seconds_are_bound": False}
        result["resolution_of_1_percent"] = None
        if len(reached) == len(times):
            return result | dict(zip(("seconds_to_1_percent", "seconds_are_bound"), max(times)))
        missing = [ladder.row for ladder in self.ladders if ladder.row["seconds_to_1_percent"] is None]
        laws = [row["resolution_of_1_percent"] for row in missing]
        return result | {"resolution_of_1_percent": None if None in laws else max(laws)}


# What changed, in plain form: docs/compare.md.

PLACE = ("case", "parameters", "formulation", *SETTINGS, "resolution", "measure")


def bracket(before, after):
    """Envelopes of one range, asked for twice; of each pair something else is different."""
    for k, (old, new) in enumerate(zip(before, after, strict=True)):
        old |= {"held": 0.9, "failed": 0.8, "status": "unstable", "scale": "linear"}
        old["points"] = [{"value": 0.5, "status": "unstable"}, {"value": 1.2, "status": "ok"}]
        new |= copy.deepcopy({key: old[key] for key in ("held", "failed", "status", "scale", "points")})
        if k % 3 == 0:
            new["status"] = "non-finite"
        if k % 3 == 1:
            new |= {"held": 0.7, "failed": 0.62}
        if k % 3 == 2:
            old["scale"] = new["scale"] = "logarithmic"
            new |= {"held": None, "failed": 1.2}


class Changes:
    def __init__(self, test, before, after):
        self.test, self.before, self.after = test, before, after
        self.list, self.counts = [], {}
        partners = {self.key_of(series): series for series in before["series"]}
        only_before, unknown, in_both = dict(partners), [], 0
        for series in after["series"]:
            old = only_before.pop(self.key_of(series))
            in_both += 1
            if self.compare(old, series):
                unknown.append(self.title_of(series))
        for old, new in zip(before.get("envelopes", []), after.get("envelopes", [])):
            in_both += 1
            self.compare_envelopes(old, new)
        keys = ("commit", "compiler", "flags", "processor")
        builds = [[one["context"][key] for key in keys] for one in (before, after)]
        known = builds[0][0] != "unknown" and not builds[0][0].endswith("-dirty")
        self.whole = {"results": "after", "against": "before", "in_both": in_both, "only_after": [], "not_comparable": []}
        self.whole |= {"same_build_and_machine": known and builds[0] == builds[1], "unknown_noise": unknown}
        self.whole["only_before"] = [self.title_of(series) for series in only_before.values()]

    @staticmethod
    def key_of(series):
        place = (series["case"], parameters_text(series["parameters"]), series["label"])
        return (*place, *setting_words(series).values())

    @staticmethod
    def title_of(series):
        words = setting_words(series)
        case = f"{series['case']} {parameters_text(series['parameters'])}"
        return f"{case}: {series['label']}, {words['density']}, {words['layout']}"

    def count(self, measure, kind):
        zero = {"measure": measure} | dict.fromkeys(("same", "within_noise", "better", "worse", "changed"), 0)
        self.counts.setdefault(measure, zero)[kind] += 1

    def put(self, entry, resolution, measure, old, new, noise, direction):
        words = {"case": entry["case"], "parameters": parameters_text(entry["parameters"]), "measure": measure}
        words |= {"formulation": entry["label"], **setting_words(entry), "resolution": resolution}
        self.list.append(words | {"direction": direction, "before": old, "after": new, "noise": noise})
        self.count(measure, direction)

    def number(self, entry, resolution, measure, old, new, noise, more_is_better=False):
        if old is None or new is None:
            return
        if old == new or abs(new - old) <= noise:
            self.count(measure, "same" if old == new else "within_noise")
        else:
            self.put(entry, resolution, measure, old, new, noise, "better" if (new > old) == more_is_better else "worse")

    def word(self, entry, resolution, measure, old, new, direction):
        if old == new:
            self.count(measure, "same")
        else:
            self.put(entry, resolution, measure, old, new, None, direction)

    def compare(self, old, new):
        """Whether numbers differ of which nobody knows the time error."""
        documents = (self.before, self.after)
        rows = [self.test.series_rows(document | {"series": [series]}, "")[0]
                for document, series in zip(documents, (old, new))]  # fmt: skip
        finest = [reductions.finest_of(document, series) for document, series in zip(documents, (old, new))]
        resolution = finest[0][0]["resolution"]
        place = (new, resolution)
        statuses = [row["failures"] or "ok" for row in rows]
        self.word(*place, "status", *statuses,
                  "worse" if statuses[0] == "ok" else "better" if statuses[1] == "ok" else "changed")  # fmt: skip
        if statuses != ["ok", "ok"]:
            return False
        adaptive = [[run for run in runs if run["integration"] and run["integration"]["relative_tolerance"]]
                    for runs in finest]  # fmt: skip
        shares = [[reductions.share_of(run) for run in runs] for runs in adaptive]
        if any(None in one for one in shares):
            # The verdict is a word.
            self.word(*place, "verdict", rows[0]["verdict"], rows[1]["verdict"], "changed")
            return True
        share = sum(max(one, default=0.0) for one in shares)
        part = max(share, 1e-6)
        most = lambda key: max(abs(row[key] or 0.0) for row in rows)  # noqa: E731
        field = rows[0]["field"]
        round_off = sum(max(run["errors"][field]["all"]["round_off"] for run in runs) for runs in finest)
        seeds = [sorted(reductions.seed_of(run["discretisation"]["layout"]) or 0 for run in runs) for runs in finest]
        scatter = 0.0
        if seeds[0] != seeds[1]:
            # Two means over two, of equal spread: Welch's degrees of freedom are 2.
            spread = leading_entry(new)["levels"][-1]["spread"]
            scatter = reductions.STUDENT[2] * spread
        get = lambda key: [row[key] for row in rows]  # noqa: E731
        self.number(*place, "error", *get("error"), part * most("error") + round_off + scatter)
        if None not in get("order_half_width"):
            self.number(*place, "order", *get("order"), math.hypot(*get("order_half_width")), True)
        self.word(*place, "verdict", *get("verdict"), "changed")
        if seeds[0] != seeds[1]:
            return False
        sizes = lambda key: [reductions.magnitude(value) for value in get(key)]  # noqa: E731
        flux = share * max(row["relative_error"] or 0.0 for row in rows) + 1e-11
        self.number(*place, "wall flux", *sizes("wall_flux_error"), part * most("wall_flux_error") + flux)
        self.number(*place, "wall impulse", *sizes("wall_impulse_defect"), part * most("wall_impulse_defect") + 1e-11)
        plateau = "plateau_pressure_error"
        self.number(*place, "shock plateau", *sizes(plateau), part * most(plateau) + 1e-11)
        tolerances = [max((run["integration"]["relative_tolerance"] for run in runs), default=0.0) for runs in adaptive]
        steps = [reductions.furthest_from_zero([step_drift(run) for run in reductions.sound(runs)]) for runs in finest]
        step_noise = 0.0
        if sum(tolerances) > 0 and None not in steps:
            step_noise = max(sum(tolerances), 2 * min(map(abs, steps)))
        rounding = lambda key: sum(row[key] or 0.0 for row in rows)  # noqa: E731
        self.number(*place, "energy drift", *sizes("energy_drift"),
                    part * most("energy_drift") + step_noise + rounding("energy_rounding"))  # fmt: skip
        self.number(*place, "momentum drift", *sizes("momentum_drift"),
                    part * most("momentum_drift") + rounding("momentum_rounding"))  # fmt: skip
        shown = 0.01 if tolerances[0] > 0 else 0.0
        self.number(*place, "time error share", *get("time_error_share"), 1e-6 * most("time_error_share") + shown)
        return False

    def compare_envelopes(self, old, new):
        place = (new, new["resolution"])
        statuses = [one["status"] if one["failed"] is not None else "ok" for one in (old, new)]
        self.word(*place, "how it fails", *statuses, "changed")
        held = [one["held"] for one in (old, new)]
        if None in held:
            self.word(*place, "held to", *("none" if value is None else f"{value:.4g}" for value in held),
                      "worse" if held[1] is None else "better")  # fmt: skip
            return
        width = max(abs(one["held"] - one["failed"]) for one in (old, new))
        # It was driven down.
        self.number(*place, "held to", *held, width)

    @staticmethod
    def size_of(row):
        """By which changes are ordered."""
        try:
            old, new, noise = (float(row[key]) for key in ("before", "after", "noise"))
        except (TypeError, ValueError):
            return 0.0 if row["measure"] == "verdict" else math.inf
        if row["measure"] == "order":
            return abs(new - old)
        if row["measure"] == "held to":
            return abs(new - old) / noise
        return abs(math.log2(max(abs(new), noise) / max(abs(old), noise)))


def step_drift(run):
    whole, pairs = (reductions.energy_part(run, part) for part in ("drift", "pair_drift"))
    return None if pairs is None else whole - pairs


if __name__ == "__main__":
    unittest.main(verbosity=2)
