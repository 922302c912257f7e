# SPDX-License-Identifier: GPL-3.0-or-later
"""A results document as data frames."""

import os

import pandas

from .columns import FLAG, IDENTITY, NUMBER, TEXT, WHOLE, Columns, flatten, identity
from .details import DETAILS, detail_frame, take_details
from .errors import Error
from .pieces import pieces

SCHEMA = "sphverify-results/1"
NORMS = ("l1", "l2", "linf")

COST = {
    **dict.fromkeys(("cost.seconds", "cost.cpu_seconds", "cost.setup_seconds", "cost.median_seconds"), NUMBER),
    **dict.fromkeys(("cost.low_seconds", "cost.high_seconds", "cost.busy", "cost.repeats", "cost.batch"), NUMBER),
    **{"cost.warm_up": FLAG, "cost.machine": TEXT, "cost.occasion": TEXT},
    **dict.fromkeys(("cost.steps", "cost.rate_evaluations", "cost.pair_interactions", "cost.peak_bytes"), NUMBER),
}
RUN = {
    "series": WHOLE,
    **IDENTITY,
    "layout.seed": WHOLE,
    **dict.fromkeys(("resolution", "particles"), WHOLE),
    **dict.fromkeys(("spacing", "smoothing_length"), NUMBER),
    **dict.fromkeys(("status", "reason"), TEXT),
    **COST,
}
WHERE = {"series": WHOLE, **dict.fromkeys(("field", "region", "norm"), TEXT)}
LEVEL = {
    "run": WHOLE,
    **dict.fromkeys(("field", "region", "norm"), TEXT),
    **dict.fromkeys(("error", "scale", "initial", "mean", "round_off", "allowed"), NUMBER),
}
ORDER = {
    **WHERE,
    **dict.fromkeys(("order", "interval.lower", "interval.upper"), NUMBER),
    **dict.fromkeys(("verdict", "reason"), TEXT),
    **dict.fromkeys(("floor.value", "floor.interval.lower", "floor.interval.upper", "allowed"), NUMBER),
    "model": TEXT,
    **dict.fromkeys(("law.floor", "law.coefficient", "law.exponent", "law.next_coefficient", "law.next_exponent"), NUMBER),
    "pairwise": TEXT,
}
TIMES = dict.fromkeys(("seconds", "median_seconds", "low_seconds", "high_seconds"), NUMBER)
RUNG = {
    **WHERE,
    **dict.fromkeys(("resolution", "replicates"), WHOLE),
    **dict.fromkeys(("spacing", "error", "spread", "mean"), NUMBER),
    **TIMES,
}
TARGET = {**WHERE, **dict.fromkeys(("error", "relative", "N"), NUMBER), "remark": TEXT}
TIME_TO_ERROR = {**WHERE, **dict.fromkeys(("relative", "error"), NUMBER), **TIMES, "is_bound": FLAG}
ENVELOPE = {
    **{name: kind for name, kind in IDENTITY.items() if name != "smoothing_exponent"},
    **{"layout.seed": WHOLE, "resolution": WHOLE, "parameter": TEXT, "scale": TEXT, "held": NUMBER, "failed": NUMBER},
    **{"status": TEXT, "reason": TEXT, "points": TEXT},
}
SKIPPED = dict.fromkeys(("case", "formulation", "reason"), TEXT)


class Results:
    """Data frames of one results document; docs/python.md says what each holds.

    `document` has the rest of it as it stands: `context`, `study`, `part`, `shares`, `surfaces`.
    """

    def __init__(self, name, document, frames, details):
        self.name = name
        self.document = document
        self.runs = frames["runs"]
        self.levels = frames["levels"]
        self.series = frames["series"]
        self.ladders = frames["ladders"]
        self.targets = frames["targets"]
        self.time_to_error = frames["time_to_error"]
        self.envelopes = frames["envelopes"]
        self.skipped = frames["skipped"]
        self._details = details

    def __repr__(self):
        counts = ", ".join(f"{count} {status}" for status, count in self.runs["status"].value_counts().items())
        part = "a part of a study: " if "part" in self.document else ""
        return f"<{self.name}: {part}{len(self.runs)} runs ({counts}), {self.series['series'].nunique()} series>"

    def history(self, run):
        """The budgets of a run over time."""
        return self._detail("history", run)

    def profile(self, run):
        """The fields of a run along its particles at the final time, computed and exact."""
        return self._detail("profile", run)

    def spectrum(self, run):
        """The eigenvalues of the linearised rate of heat conduction."""
        return self._detail("spectrum", run)

    def modes(self, run):
        """The modes of a gas about rest."""
        return self._detail("modes", run)

    def _detail(self, kind, run):
        if run not in self.runs.index:
            raise Error(f"{self.name}: found no run {run}, expected one of 0 to {len(self.runs) - 1}")
        if run not in self._details[kind]:
            raise Error(f"{self.name}: run {run} has no {kind}: its study did not ask for one, or it has none")
        return detail_frame(kind, self._details[kind][run])


def load(path):
    """Reads a results document, or a part of one."""
    path = os.fspath(path)
    reader = _Reader(path)
    for key, index, value in pieces(path, ("runs", "series")):
        if key == "schema":
            reader.check_schema(value)
        elif index is None:
            reader.document[key] = value
        else:
            reader.read(key, index, value)
    try:
        return reader.results()
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise Error(f"{path}: not as in {SCHEMA}: {error}") from None


class _Reader:
    def __init__(self, path):
        self.path = path
        self.schema = None
        self.document = {}
        self.runs, self.levels = Columns(RUN), Columns(LEVEL)
        self.series, self.orders, self.ladders = Columns(IDENTITY), Columns(ORDER), Columns(RUNG)
        self.targets, self.times = Columns(TARGET), Columns(TIME_TO_ERROR)
        self.details = {kind: {} for kind in DETAILS}
        self.series_of = {}

    def check_schema(self, schema):
        self.schema = schema
        if schema != SCHEMA:
            raise Error(f"{self.path}: schema: found {schema!r}, expected {SCHEMA!r}")

    def read(self, key, index, record):
        try:
            self.read_run(index, record) if key == "runs" else self.read_series(index, record)
        except KeyError as error:
            raise Error(f"{self.path}: {key}[{index}]: found no key {error}") from None
        except (AttributeError, TypeError, ValueError) as error:
            raise Error(f"{self.path}: {key}[{index}]: not as in {SCHEMA}: {error}") from None

    def read_run(self, index, run):
        row = identity(run)
        for key in ("resolution", "particles", "status"):
            row[key] = run[key]
        take_details(run, index, self.details)
        rest = {key: value for key, value in run.items() if key not in ("errors", "parameters", "discretisation")}
        flatten({key: value for key, value in rest.items() if key not in row}, "", row)
        self.runs.add(row)
        is_there = False
        for field, regions in run["errors"].items():
            for region, error in regions.items():
                for norm in NORMS:
                    is_there = True
                    self.levels.add({
                        "run": index, "field": field, "region": region, "norm": norm, "error": error[norm],
                        "scale": error["scale"][norm], "initial": error.get("initial", {}).get(norm),
                        "mean": error.get("mean"), "round_off": error.get("round_off"),
                        "allowed": error.get("allowed", {}).get(norm),
                    })  # fmt: skip
        if not is_there:  # so that a run without errors is not forgotten
            self.levels.add({"run": index})

    def read_series(self, index, series):
        row = identity(series)
        row["runs"] = tuple(series["runs"])
        row["discontinuous"] = series["discontinuous"]
        row["is_timed_apart"] = series.get("is_timed_apart", False)
        self.series.add(row)
        for run in row["runs"]:
            if run in self.series_of:
                raise ValueError(f"run {run} is in series[{self.series_of[run]}] too")
            self.series_of[run] = index
        for order in series["orders"]:
            where = {"series": index, **{key: order[key] for key in ("field", "region", "norm")}}
            flat = dict(where)
            flatten({key: order[key] for key in order if key not in ("levels", "targets")}, "", flat)
            self.orders.add(flat)
            for rung in order.get("levels", ()):
                self.ladders.add({**where, **rung})
            for target in order.get("targets", ()):
                self.targets.add({**where, **target})
        if not series["orders"]:
            self.orders.add({"series": index})
        for time in series["time_to_error"]:
            self.times.add({"series": index, **time})

    def results(self):
        if self.schema is None:
            raise Error(f"{self.path}: found no key 'schema', expected {SCHEMA!r}")
        for key in ("context", "study", "skipped"):
            if key not in self.document:
                raise Error(f"{self.path}: found no key '{key}'")
        if self.series_of and max(self.series_of) >= self.runs.rows:
            raise Error(f"{self.path}: series: found run {max(self.series_of)}, expected less than {self.runs.rows}")
        self.runs.values["series"] = [self.series_of.get(run) for run in range(self.runs.rows)]
        runs, series = self.runs.frame(), self.series.frame()
        runs.index.name = "run"
        own = [name for name in runs if name in RUN and not name.startswith("cost.") and name != "reason"]
        own += [name for name in runs if name.startswith(("parameters.", "layout.", "viscosity."))]
        of_run = runs[list(dict.fromkeys(own))]
        envelopes, skipped = Columns(ENVELOPE), Columns(SKIPPED)
        for envelope in self.document.pop("envelopes", ()):
            row = identity(envelope)
            flatten({k: v for k, v in envelope.items() if k not in row and k != "discretisation"}, "", row)
            envelopes.add(row)
        for one in self.document.pop("skipped"):
            skipped.add(one)
        frames = {
            "runs": runs,
            "levels": _beside(of_run, self.levels.frame(), "run"),
            "series": _beside(series, self.orders.frame(), "series"),
            "ladders": _beside(series, self.ladders.frame(), "series"),
            "targets": _beside(series, self.targets.frame(), "series"),
            "time_to_error": _beside(series, self.times.frame(), "series"),
            "envelopes": envelopes.frame(),
            "skipped": skipped.frame(),
        }
        return Results(self.path, self.document, frames, self.details)


def _beside(whole, parts, key):
    """The parts, each behind what the whole is that it belongs to."""
    heads = whole.take(parts[key]).reset_index(drop=True)
    heads.insert(0, key, parts[key])
    return pandas.concat([heads, parts.drop(columns=key)], axis=1)
