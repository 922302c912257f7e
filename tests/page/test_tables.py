# SPDX-License-Identifier: GPL-3.0-or-later
"""Every column of every sortable table of the report page, against numbers computed here from the results document.
The documents are scrambled (tests/cli/scrambled.py), so that a number of another run, level or column is seen. The
columns are those that the page shows: one that is new fails until it is covered here."""

import math
import re
import unittest

from browser import BrowserTest

# Those of tests/cli, where the browser's module looks.
import reductions
from reductions import entry_of, finest_of, layout_text, leading_entry, parameters_text, runs_of, seed_of, target_of
from scrambled import DRIVEN, GAS, GRID, HEAT, LAYOUTS, break_run, scrambled

UNITS = {"s": 1.0, "ms": 1e-3, "µs": 1e-6}
STUDIES = (HEAT | {"discretisation": {"layout": LAYOUTS}}, GAS, GRID, DRIVEN)
NONE = "–"
NOT_KNOWN = ("", NONE, "not known")
# The page holds five digits of every number.
HELD = 1e-4
READ_TABLES = """
return [...document.querySelectorAll("div.table")].map((table) => ({
  title: table.querySelector("caption").textContent,
  count: table.querySelector("output.count").textContent,
  heads: [...table.querySelectorAll("thead th")].map((cell) => cell.textContent),
  rows: [...table.querySelectorAll("tbody tr")].map((row) => [...row.children].map((cell) => cell.textContent)),
  failed: [...table.querySelectorAll("tbody tr")].map((row) => row.classList.contains("failed")),
}));
"""


# What a cell must show: a text, in which numbers stand as pairs of value and kind.


def as_number(text, value):
    """Three digits, or two of a very small or large one."""
    size = abs(value)
    is_plain = 1e-4 <= size < 1e5
    digits = 0.005 if is_plain else 0.05
    near_the_limit = min(abs(size / limit - 1) for limit in (1e-4, 1e5)) < HELD
    return ("e" not in text) == is_plain or near_the_limit, float(text), value, digits * size


def as_percent(text, value):
    return text.endswith("%"), float(text[:-1]), 100 * value, 0.05 * abs(100 * value)


def as_seconds(text, value):
    number, unit = text.split(" ")
    return unit in UNITS, float(number) * UNITS[unit], value, 0.005 * value


def as_order(text, value):
    return re.fullmatch(r"-?\d+\.\d\d", text), float(text), value, 0.005


def as_ratio(text, value):
    return True, float(text), value, 0.005 * max(value, 1.0 if value < 9.95 else value)


def as_count(text, value):
    """The next whole number, of what the page holds."""
    return text.isdigit(), float(text), math.ceil(value), HELD * value + 1


def as_difference(text, value):
    """With its sign."""
    text = text.replace("−", "-")
    is_signed = text[0] in "+-" or text == "0%"
    return is_signed and text.endswith("%"), float(text[:-1]), 100 * value, 0.05 * abs(100 * value) + 100 * HELD


def number(value):
    return [NONE if value is None else "0" if value == 0 else (value, as_number)]


def percent(value):
    return [NONE if value is None else "0%" if abs(value) < 1e-11 else (value, as_percent)]


def seconds(value):
    return [NONE if value is None else (value, as_seconds)]


def text(value):
    return [NONE if value is None else str(value)]


def between(kind, value, ends):
    """A number with its interval."""
    if ends is None or None in ends:
        return [(value, kind)]
    return [(value, kind), " [", (ends[0], kind), ", ", (ends[1], kind), "]"]


def estimate(value, kind=as_number):
    return ["not known"] if value["value"] is None else between(kind, value["value"], value["interval"])


def time_of(entry, is_bound=False):
    """A median with its interval, else the shortest; nothing of what was not timed."""
    if entry is None or entry["seconds"] is None:
        return [NONE]
    bound = ["≤ "] if is_bound else []
    if entry["median_seconds"] is None:
        return bound + seconds(entry["seconds"])
    return bound + between(as_seconds, entry["median_seconds"], (entry["low_seconds"], entry["high_seconds"]))


def complaint(cell, parts):
    """Why a cell is not what it must be; empty if it is."""
    pattern = "".join(re.escape(part) if isinstance(part, str) else "(.+?)" for part in parts)
    match = re.fullmatch(pattern, cell)
    if not match:
        return f"{cell!r} is not {parts}"
    for shown, (value, kind) in zip(match.groups(), [part for part in parts if not isinstance(part, str)]):
        try:
            is_formed, found, meant, tolerance = kind(shown, value)
        except (ValueError, KeyError):
            return f"{shown!r} in {cell!r} is no number {kind.__name__}"
        if not is_formed or abs(found - meant) > tolerance + 0.5 * HELD * abs(meant):
            return f"{shown!r} in {cell!r} is not {meant}"
    return ""


# Names.


def names_of(document):
    """Of formulations, by the identity of their entries: a partner, or a room, only where it tells two apart."""
    entries = [*document["series"], *document.get("envelopes", []), *document.get("surfaces", [])]
    bare = lambda id: re.sub("-energy$", "", id.split("/", 1)[1])  # noqa: E731
    names = {}
    for entry in entries:
        id = entry["formulation"]
        name = id if len({e["formulation"] for e in entries if bare(e["formulation"]) == bare(id)}) > 1 else bare(id)
        for kind in ("work", "conduction"):
            if entry[kind] and len({e[kind] for e in entries if e["formulation"] == id and e[kind]}) > 1:
                name += f" + {bare(entry[kind])}"
        names[id_of(entry)] = name if entry["walls"] == "on" else f"{name} (walls off)"
    return names


def id_of(entry):
    return (entry["formulation"], entry["work"], entry["conduction"], entry["walls"])


def case_of(entry):
    """Rates of different equations are cases of their own."""
    operator = ""
    if entry["case"].startswith("operator/"):
        operator = entry["formulation"].split("/")[0]
    return entry["case"], parameters_text(entry["parameters"]), operator


def settings_of(document, entry):
    """By the names of the page's columns."""
    d = entry["discretisation"]
    keys = {"density": "density", "closure": "closure", "face weight": "face_weight", "smoothing": "smoothing",
            "wall motion": "wall_motion", "integrator": "integrator", "kernel": "kernel", "pair weight": "pair_weight"}  # fmt: skip
    settings = {name: d[key] for name, key in keys.items()}
    v = d["viscosity"]
    settings["viscosity"] = v if v == "off" else f"alpha {v['alpha']:g}, beta {v['beta']:g}"
    settings["layout"] = layout_text(d["layout"])
    if "runs" in entry:  # a surface has all h/dx
        first = min(run["resolution"] for run in runs_of(document, entry))
        exponent = entry["smoothing_exponent"]
        path = f" (N/{first})^{exponent:g}" if exponent else ""
        settings["h/dx"] = f"{d['smoothing_ratio']:g}{path}"
    return settings


SETTING_COLUMNS = ("density", "closure", "face weight", "layout", "h/dx", "smoothing", "viscosity", "wall motion",
                   "integrator", "kernel", "pair weight")  # fmt: skip


class View:
    """What the page shows under some choices."""

    def __init__(self, document, case, choice, is_all=False):
        self.document, self.case, self.choice, self.is_all = document, case, choice, is_all
        self.names = names_of(document)
        self.of_case = [s for s in document["series"] if case_of(s) == case]
        self.in_tables = document["series"] if is_all else self.of_case
        self.series_of = {index: s for s in document["series"] for index in s["runs"]}
        self.numbers = {}

    def name(self, entry):
        return self.names[id_of(entry)]

    def case_name(self, entry):
        id, _, operator = case_of(entry)
        others = {case_of(s): s["parameters"] for s in self.document["series"] if s["case"] == id}
        own = [f"{key}={reductions.value_text(value)}" for key, value in sorted(entry["parameters"].items())
               if any(other.get(key) != value for other in others.values())]  # fmt: skip
        return ", ".join(filter(None, [id, operator, *own]))

    def row(self, series):
        """The numbers of a ladder, reduced once."""
        key = id(series)
        if key not in self.numbers:
            self.numbers[key] = reductions.series_numbers(self.document, series)
        return self.numbers[key]

    def setting_columns(self, series, of):
        """Settings in which ladders differ, of what the rows are of."""
        all_settings = [settings_of(self.document, s) for s in series]
        varying = [key for key in SETTING_COLUMNS if len({s.get(key) for s in all_settings}) > 1]
        get = lambda row, key: settings_of(self.document, of(row)).get(key) if of(row) else None  # noqa: E731
        return {key: lambda row, key=key: text(get(row, key)) for key in varying}

    # Ladders.

    def entry(self, series):
        return entry_of(series, *self.choice) or leading_entry(series)

    def ladders(self):
        def error(series):
            entry = self.entry(series)
            finest = max(run["resolution"] for run in runs_of(self.document, series))
            return next((lv["error"] for lv in entry["levels"] if lv["resolution"] == finest), None) if entry else None

        def scale(series):
            return reductions.scale_of(self.document, series, self.entry(series))

        def floor(series):
            entry = self.entry(series)
            if not entry or not entry["floor"]:
                return ["not known"]
            unit, kind = (scale(series), as_percent) if scale(series) > 0 else (1.0, as_number)
            return between(kind, entry["floor"]["value"] / unit, [end / unit for end in entry["floor"]["interval"]])

        def resolution(series, relative):
            targets = self.entry(series)["targets"] if self.entry(series) else []
            target = next((t for t in targets if t["relative"] == relative), None)
            if target is None or target["N"] is None:
                return text((target or {}).get("remark") or "not known")
            remark = [f", {target['remark']}"] if target["remark"] else []
            return ["N = ", (target["N"], as_count), *remark]

        def order(series):
            entry = self.entry(series)
            is_known = entry and entry["order"] is not None
            return between(as_order, entry["order"], entry["interval"]) if is_known else [NONE]

        def time_to(series, relative):
            entry = leading_entry(series)
            target = target_of(series, entry, relative) if entry else None
            return time_of(target, target and target["is_bound"])

        of_entry = lambda key: lambda s: text((self.entry(s) or {}).get(key) or None)  # noqa: E731
        relative = lambda s: error(s) / scale(s) if error(s) is not None and scale(s) > 0 else None  # noqa: E731
        row = lambda kind, key: lambda s: kind(self.row(s)[key])  # noqa: E731
        columns = {
            "formulation": lambda s: text(self.name(s)),
            "case": lambda s: text(self.case_name(s)),
            **self.setting_columns(self.in_tables, lambda s: s),
            "finest N": lambda s: text(finest_of(self.document, s)[0]["resolution"]),
            "failures": lambda s: text(reductions.failures_of(finest_of(self.document, s))),
            **{name: of_entry(key) for name, key in (("field", "field"), ("region", "region"), ("verdict", "verdict"),
                                                     ("because", "reason"), ("model", "model"))},
            "error": lambda s: number(error(s)),
            "relative error": lambda s: percent(relative(s)),
            "order [95%]": order,
            "floor [95%]": floor,
            "N to 1%": lambda s: resolution(s, 0.01),
            "N to 0.1%": lambda s: resolution(s, 0.001),
            "run time": lambda s: time_of(self.row(s)),
            "time to 1% (all)": lambda s: time_to(s, 0.01),
            "time to 0.1% (all)": lambda s: time_to(s, 0.001),
            "wall flux error": row(percent, "wall_flux_error"),
            "energy drift / energy": row(number, "energy_drift"),
            "wall budget defect / energy": row(number, "wall_budget_defect"),
            "error of the plateau pressure": row(percent, "plateau_pressure_error"),
            "wall heating": row(percent, "wall_heating"),
            "wall impulse defect": row(percent, "wall_impulse_defect"),
            "momentum drift": row(number, "momentum_drift"),
            "time error share": row(number, "time_error_share"),
        }  # fmt: skip
        failed = lambda s: bool(reductions.failures_of(finest_of(self.document, s)))  # noqa: E731
        return self.in_tables, columns, failed

    # Runs.

    def run_columns(self, series, of_run):
        """What rows of one case have in common."""
        return {
            "formulation": lambda row: text(self.name(self.of(of_run(row)))),
            **self.setting_columns(series, lambda row: self.of(of_run(row))),
            "N": lambda row: text(of_run(row)["resolution"]),
            "seed": lambda row: text(seed_of(of_run(row)["discretisation"]["layout"])),
        }

    def of(self, run):
        return self.series_of.get(next(k for k, one in enumerate(self.document["runs"]) if one is run))

    def shown_name(self, run):
        return self.name(self.of(run)) if self.of(run) else run["label"]

    def shown_case(self, run):
        return self.case_name(self.of(run)) if self.of(run) else run["case"]

    def runs(self):
        shown = {index for series in self.in_tables for index in series["runs"]}
        rows = [run for index, run in enumerate(self.document["runs"]) if index in shown or index not in self.series_of]
        cost = lambda key: lambda r: number(r["cost"][key] if r["cost"] else None)  # noqa: E731
        stability = lambda kind, key: lambda r: kind(r["stability"][key] if r["stability"] else None)  # noqa: E731
        size = reductions.magnitude
        columns = {
            "formulation": lambda r: text(self.shown_name(r)),
            "case": lambda r: text(self.shown_case(r)),
            **self.setting_columns(self.in_tables, self.of),
            "N": lambda r: text(r["resolution"]),
            "particles": lambda r: text(r["particles"]),
            "seed": lambda r: text(seed_of(r["discretisation"]["layout"])),
            "status": lambda r: text(r["status"]),
            "reason": lambda r: text(r["reason"]),
            "h [m]": lambda r: number(r["smoothing_length"]),
            "run time": lambda r: time_of(r["cost"]),
            "steps": cost("steps"),
            "rate evaluations": cost("rate_evaluations"),
            "pair interactions": cost("pair_interactions"),
            "memory [bytes]": cost("peak_bytes"),
            "energy drift / energy": lambda r: number(size(reductions.energy_part(r, "drift"))),
            "wall budget defect / energy": lambda r: number(size(reductions.energy_part(r, "wall_budget_defect"))),
            "wall flux error": lambda r: percent(reductions.flux_error(r)),
            "time error share": lambda r: number(reductions.share_of(r)),
            "spectral abscissa [1/s]": stability(number, "spectral_abscissa"),
            "spectral radius [1/s]": stability(number, "spectral_radius"),
            "longest stable Euler step": stability(seconds, "largest_stable_step"),
        }
        return rows, columns, lambda r: r["status"] != "ok"

    def failures(self):
        rows = [run for run in self.document["runs"] if run["status"] != "ok"]
        _, columns, failed = self.runs()
        kept = ("formulation", "case", "N", "seed", "status", "reason")
        settings = self.setting_columns(self.document["series"], self.of)
        return rows, settings | {key: columns[key] for key in kept}, failed

    def skipped(self):
        columns = {key: lambda s, key=key: text(s[key]) for key in ("formulation", "case", "reason")}
        return self.document["skipped"], columns, lambda s: False

    # Spectra and steps of each ladder's finest resolution that tells of them, every replicate.

    def told(self, holds):
        rows = []
        for series in self.of_case:
            runs = [run for run in runs_of(self.document, series) if holds(run)]
            finest = max((run["resolution"] for run in runs), default=0)
            rows += [run for run in runs if run["resolution"] == finest]
        return rows

    def stabilities(self):
        tells = lambda stability: stability["worst_mode"] or stability["stable_steps"]  # noqa: E731
        return self.told(lambda run: run["stability"] and tells(run["stability"]))

    @staticmethod
    def grows(stability):
        growing = stability["growing_modes"]
        return growing > 0 if growing is not None else stability["worst_mode"] is not None

    def growing_text(self, stability):
        if stability["growing_modes"] is not None:
            return text(stability["growing_modes"])
        return text("at least 1" if self.grows(stability) else "not known")

    def steps(self):
        rows = [(run, method, step) for run in self.stabilities()
                for method, step in sorted(run["stability"]["stable_steps"].items())]  # fmt: skip

        def difference(step):
            return step["measured"] / step["theory"] - 1 if step["theory"] and step["measured"] is not None else None

        def agreement(run, step):
            if difference(step) is None:
                return ""
            stability = run["stability"]
            is_known = stability["growing_modes"] is not None or stability["worst_mode"] is not None
            words = ", but a mode grows" if self.grows(stability) else ""
            words = words or ("" if is_known else ", but whether a mode grows is not known")
            return ("agree" if abs(difference(step)) <= 0.01 else "differ") + words

        columns = self.run_columns(self.of_case, lambda row: row[0]) | {
            "method": lambda row: text(row[1]),
            "by theory": lambda row: seconds(row[2]["theory"]),
            "by experiment": lambda row: seconds(row[2]["measured"]),
            "difference": lambda row: [NONE if difference(row[2]) is None else (difference(row[2]), as_difference)],
            "agreement": lambda row: text(agreement(row[0], row[2])),
            "growing modes": lambda row: self.growing_text(row[0]["stability"]),
            "remark": lambda row: text(row[2]["remark"] or row[0]["stability"]["remark"] or None),
        }
        no_step = lambda step, run: step["theory"] is None and (  # noqa: E731
            step["remark"] or run["stability"]["remark"]).startswith("no step is stable")  # fmt: skip
        return rows, columns, lambda row: agreement(row[0], row[2]).startswith("differ") or no_step(row[2], row[0])

    def modes(self):
        worst = lambda run, key: (run["stability"]["worst_mode"] or {}).get(key)  # noqa: E731
        over_radius = lambda run: reductions.over(worst(run, "growth"), run["stability"]["spectral_radius"])  # noqa: E731
        columns = self.run_columns(self.of_case, lambda run: run) | {
            "growth [1/s]": lambda run: number(worst(run, "growth")),
            "growth / radius": lambda run: number(over_radius(run)),
            "frequency [1/s]": lambda run: number(worst(run, "frequency")),
            "wavelength [dx]": lambda run: number(worst(run, "wavelength")),
            "part near a wall": lambda run: percent(worst(run, "wall_share")),
            "centre [m]": lambda run: place(worst(run, "centre")),
            "growing modes": lambda run: self.growing_text(run["stability"]),
            "unseen modes": lambda run: number(run["stability"]["unseen_modes"]),
            "eigenvalues by": lambda run: text(run["stability"]["method"] or None),
            "remark": lambda run: text(run["stability"]["remark"] or None),
        }
        return self.stabilities(), columns, lambda run: self.grows(run["stability"])

    def second_laws(self):
        kinds = {"heat from cold to hot": ("cold_to_hot", reductions.watched_cold_to_hot),
                 "hotter than ever before": ("overshoot", reductions.watched_bounds),
                 "colder than ever before": ("undershoot", reductions.watched_bounds)}  # fmt: skip

        def breach(run, key, watched):
            law = run["second_law"]
            return law[key] if watched(law) else None

        def breach_text(found):
            if found is None or found["size"] == 0:
                return percent(found and found["size"])
            return [*percent(found["size"]), " at t = ", *number(found["time"]), ", x = ", *place(found["position"])]

        def broken(run):
            made = run["second_law"]["smallest_entropy_production"]
            names = [name for name, kind in kinds.items() if (breach(run, *kind) or {"size": 0})["size"] > 0]
            return names + ["entropy falls"] * (made is not None and made < -1e-10)

        columns = self.run_columns(self.of_case, lambda run: run) | {
            **{name: lambda run, kind=kind: breach_text(breach(run, *kind)) for name, kind in kinds.items()},
            "smallest entropy production": lambda run: percent(run["second_law"]["smallest_entropy_production"]),
            "broken": lambda run: text("; ".join(broken(run))),
            "remark": lambda run: text(run["second_law"]["remark"] or None),
        }
        return self.told(lambda run: "second_law" in run), columns, lambda run: bool(broken(run))

    # Error surfaces.

    def surfaces(self):
        everywhere = [s for s in self.document.get("surfaces", []) if case_of(s) == self.case]
        chosen = [s for s in everywhere if (s["field"], s["region"], s["norm"]) == self.choice]
        rows = sorted(chosen or everywhere, key=lambda s: s["walls"] == "off")
        none = {"value": None, "interval": None}
        keys = [key for key in SETTING_COLUMNS if key != "h/dx"]
        varying = [key for key in keys if len({settings_of(self.document, s)[key] for s in everywhere}) > 1]

        def path(surface):
            """In run time, else in pairs."""
            paths = sorted(surface["paths"], key=lambda p: p["unit"] != "seconds")
            return paths[0] if paths else {"rules": [], "grid_exponent": None, "reason": None}

        def half(surface):
            return next((r for r in path(surface)["rules"] if r["exponent"] == 0.5), {})

        def best(surface, resolution):
            return best_text(surface, next((b for b in surface["best"] if b["resolution"] == resolution), None))

        levels = sorted({b["resolution"] for s in rows for b in s["best"]})
        columns = {
            "formulation": lambda s: text(self.name(s)),
            **{key: lambda s, key=key: text(settings_of(self.document, s)[key]) for key in varying},
            "error of": lambda s: text(f"{s['field']}, {s['region']}, {s['norm']}"),
            "model": lambda s: text(s["model"] or s["reason"] or None),
            "misfit": lambda s: percent(s["misfit"]),
            "smoothing error ~ h^p: p": lambda s: estimate(s["smoothing_exponent"]),
            "sampling error ~ (dx/h)^s: s": lambda s: estimate(s["sampling_exponent"]),
            "sampling error ~ dx^t: t": lambda s: estimate(s["spacing_exponent"]),
            **{f"best h/dx at N = {n}": lambda s, n=n: best(s, n) for n in levels},
            "neighbours ~ N^k: best k": lambda s: estimate(s["neighbour_exponent"]),
            "k of the cells": lambda s: number(path(s)["grid_exponent"]),
            "k = 0.5: error / best, same cost": lambda s: estimate(half(s).get("error_ratio", none), as_ratio),
            "k = 0.5: cost / best, same error": lambda s: estimate(half(s).get("cost_ratio", none), as_ratio),
            "remark": lambda s: text(half(s).get("remark") or path(s)["reason"]),
        }
        return rows, columns, lambda s: False


def place(position):
    """Coordinates, with a comma between them."""
    if not position:
        return [NONE]
    return [part for k, value in enumerate(position) for part in ([", "] if k else []) + number(value)]


def best_text(surface, best):
    """The law's best h/dx, unless what was measured is to be taken in its place."""
    if best is None:
        return [NONE]
    measured = best["grid_ratio"]
    if best["ratio"]["value"] is None:
        return ["not known"] if measured is None else [*number(measured), " of those tried"]
    end = {"lower": [" or less"], "upper": [" or more"]}.get(best["edge"], [])
    by_law = estimate(best["ratio"]) + end
    advice = advice_at(surface, best)
    if advice == "measured":
        return [*number(measured), " (measured; by the law ", *by_law, ", within its misfit)"]
    if advice == "untried":
        return [*number(measured), " (measured; by the law ", *by_law, ", where no error counts)"]
    return [*by_law, " (by the law; measured ", *number(measured), ")"] if advice == "apart" else by_law


def advice_at(surface, best):
    """What to take: the law's ratio if nothing that ran lies between it and the best of those that ran; that one, if the law
    does not tell the two apart, or where it points nothing ran."""
    law, measured = best["ratio"]["value"], best["grid_ratio"]
    if measured is None:
        return "law"
    cells = [c for c in surface["cells"] if c["resolution"] == best["resolution"] and c["error"] is not None]
    ratios = [c["smoothing_ratio"] for c in cells]
    if not min(ratios) * (1 - 1e-9) <= law <= max(ratios) * (1 + 1e-9):
        return "untried"
    if not any(r != measured and min(law, measured) <= r <= max(law, measured) for r in ratios):
        return "law"
    fitted = next((c["fitted"] for c in cells if c["smoothing_ratio"] == measured), None)
    if None not in (fitted, best["error"], surface["misfit"]) and fitted <= best["error"] * math.exp(surface["misfit"]):
        return "measured"
    low, high = best["ratio"]["interval"] or (math.inf, -math.inf)
    return "law" if low <= measured <= high else "apart"


TABLES = {
    "Ladders": View.ladders,
    "Runs": View.runs,
    "Failures": View.failures,
    "Skipped": View.skipped,
    "Largest stable steps": View.steps,
    "Second law": View.second_laws,
    "Worst modes": View.modes,
    "Error surfaces": View.surfaces,
}


class TablesTest(BrowserTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.documents = {}
        for study in STUDIES:
            original = cls.maker.study(study, f"{study['name']}-original.json")
            cls.documents[study["name"]] = scrambled(original, settings=True)
        cls.change_by_hand(cls.documents["heat"])
        for name, document in cls.documents.items():
            cls.maker.write(f"{name}.json", document)
            cls.maker.succeed("report", cls.place / f"{name}.json", "-o", cls.place / f"{name}.html")
        cls.start_browser()

    @staticmethod
    def change_by_hand(document):
        """Runs that failed, numbers that do not exist, a field that is 0."""
        ladders = [series["runs"] for series in document["series"] if document["runs"][series["runs"][0]]["stability"]]
        break_run(document, ladders[0][-1], "unstable")
        break_run(document, ladders[1][-2], "timed-out")
        runs = [document["runs"][index] for series in ladders for index in series[-2:]]
        for k, run in enumerate(runs[4:]):
            stability = run["stability"]
            if k % 5 == 0:
                stability |= {"growing_modes": None, "worst_mode": None, "remark": "too many unknowns"}
            if k % 5 == 1:
                stability["growing_modes"] = None
            if k % 5 == 2:
                stability["growing_modes"] = 0
            if k % 5 == 3:
                none = {"measured": None, "theory": None, "remark": "no step is stable"}
                stability["stable_steps"]["heun"] |= none
        for k, series in enumerate(document["series"]):
            for entry in series["orders"]:
                if k % 4 == 1:
                    entry["interval"] = None
                if k % 4 == 2:
                    entry |= {"floor": None, "targets": [target | {"N": None} for target in entry["targets"]]}
                if k % 4 == 3:
                    entry |= {"order": None, "interval": None, "targets": []}
            for target in series["time_to_error"][k % 5 :: 5]:
                never = dict.fromkeys(("seconds", "median_seconds", "low_seconds", "high_seconds"))
                target |= never | {"is_bound": False}
        # A whole number of particles that is enough, though hardly.
        target = next(t for t in leading_entry(document["series"][4])["targets"] if t["relative"] == 0.01)
        target |= {"N": 1149.003, "remark": ""}
        last = document["series"][-1]
        for run in runs_of(document, last):
            for regions in run["errors"].values():
                for error in regions.values():
                    error["scale"] = {"l1": 0.0, "l2": 0.0, "linf": 0.0}
            if run["cost"]:
                run["cost"] |= {"low_seconds": None, "high_seconds": None}

    def read_tables(self):
        for button in self.all("div.table button.more"):
            if button.is_displayed():
                button.click()
        return self.script(READ_TABLES)

    def check(self, table, view, known, seen):
        """Every cell of a table; notes which columns there are and which showed something."""
        title = table["title"]
        self.assertIn(title, TABLES, "nothing is known of this table")
        rows, columns, failed = TABLES[title](view)
        self.assertEqual(table["count"], f"{len(rows)} row{'' if len(rows) == 1 else 's'}", title)
        self.assertEqual(len(table["rows"]), len(rows), title)
        self.assertEqual(table["failed"], [failed(row) for row in rows], f"rows of {title} that are marked")
        wrong = []
        for k, head in enumerate(table["heads"]):
            self.assertIn(head, columns, f"nothing is known of column {head} of {title}")
            for cells, row in zip(table["rows"], rows):
                why = complaint(cells[k], columns[head](row))
                wrong += [f"{title}, {head}, row of {cells[:4]}: {why}"] if why else []
            if any(cells[k] not in NOT_KNOWN for cells in table["rows"]):
                seen.add((title, head))
        known.update((title, head) for head in columns)
        self.assertEqual(wrong[:5], [], f"{len(wrong)} cells of {title}")
        filled = [head for head, show in columns.items() if any(show(row)[0] not in NOT_KNOWN for row in rows)]
        self.assertEqual([head for head in filled if head not in table["heads"]], [], f"columns missing of {title}")

    def open_quickly(self, name):
        """Without plots, which take most of the time and are looked at elsewhere."""
        self.open(name)
        self.script("Plot.plot = () => document.createElement('div')")

    def choose_other(self, label, value):
        """What is chosen already is left alone: every choice draws the page anew."""
        chosen = (
            "return [...document.querySelectorAll('label.choice')].find((l) => l.firstChild.textContent === "
            "arguments[0]).querySelector('select').selectedOptions[0].textContent"
        )
        if self.script(chosen, label) != value:
            self.choose(label, value)

    def views(self, document):
        """Every case, the first with another choice of field, region and norm too; and in the end all cases."""
        cases = list(dict.fromkeys(case_of(series) for series in document["series"]))
        for k, case in enumerate(cases):
            own = [series for series in document["series"] if case_of(series) == case]
            self.choose_other("case", View(document, case, None).case_name(own[0]))
            entries = [(e["field"], e["region"], e["norm"]) for series in own for e in series["orders"]]
            leading = leading_entry(own[0])
            for choice in [(leading["field"], "all", leading["norm"]), *([min(entries)] if k == 0 else [])]:
                for label, value in zip(("field", "region", "norm"), choice):
                    self.choose_other(label, value)
                yield View(document, case, choice)
        self.one("section.tables > label input").click()
        yield View(document, case, choice, is_all=True)

    def test_every_column_of_every_table(self):
        known, seen = set(), set()
        for name, document in self.documents.items():
            self.open_quickly(f"{name}.html")
            # An envelope has no ladders, but failures.
            for view in self.views(document) if document["series"] else [View(document, None, None)]:
                with self.subTest(document=name, case=view.case, choice=view.choice, is_all=view.is_all):
                    for table in self.read_tables():
                        self.check(table, view, known, seen)
            self.assert_silent()
        self.assertEqual(known - seen, set(), "columns that no document here fills")
        self.assertEqual({title for title, _ in seen}, set(TABLES))

    def test_the_particles_to_an_error_are_enough(self):
        self.open_quickly("heat.html")
        (table,) = (table for table in self.read_tables() if table["title"] == "Ladders")
        self.assertEqual(table["rows"][4][table["heads"].index("N to 1%")], "N = 1150")


if __name__ == "__main__":
    unittest.main()
