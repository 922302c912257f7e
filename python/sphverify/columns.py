# SPDX-License-Identifier: GPL-3.0-or-later
"""How records of a document become columns.

A column is named by its path in the document: keys joined by dots, elements of a list by their number from 0, the ends of
an interval `lower` and `upper`. The keys of `discretisation` stand without that word. What is null or absent is missing.
"""

import numpy
import pandas

TEXT, NUMBER, WHOLE, FLAG = "text", "number", "whole", "flag"

IDENTITY = {
    **dict.fromkeys(("case", "parameters", "formulation", "work", "conduction", "walls", "label"), TEXT),
    **dict.fromkeys(("kernel", "pair_weight", "density"), TEXT),
    "smoothing_ratio": NUMBER,
    **dict.fromkeys(("layout", "face_weight", "closure", "integrator", "smoothing", "wall_motion", "viscosity"), TEXT),
    "smoothing_exponent": NUMBER,
}

# Of varying length: one column of tuples, not a column for every element.
LISTS = {"remarks", "scene.fields", "scene.passes", "cost.round_seconds", "pairwise", "runs", "points"}


class Columns:
    """Rows of differing keys, stored by column. `known` are columns that are there though every value is missing."""

    def __init__(self, known=None):
        self.known = known or {}
        self.values = {name: [] for name in self.known}
        self.rows = 0
        self.same = {}  # one copy of every text

    def add(self, row):
        for name, value in row.items():
            if value is None:
                continue
            column = self.values.setdefault(name, [])
            column.extend([None] * (self.rows - len(column)))
            column.append(self.same.setdefault(value, value) if isinstance(value, (str, tuple)) else value)
        self.rows += 1

    def frame(self):
        for column in self.values.values():
            column.extend([None] * (self.rows - len(column)))
        columns = {name: _array(name, values, self.known.get(name)) for name, values in self.values.items()}
        return pandas.DataFrame(columns, index=pandas.RangeIndex(self.rows), copy=False)


EXPECTED = {TEXT: {str, tuple}, NUMBER: {int, float}, WHOLE: {int, float}, FLAG: {bool}}


def _array(name, values, kind):
    there = {type(value) for value in values} - {type(None)}
    if kind is None:
        kind = FLAG if there == {bool} else NUMBER if there <= {int, float} else TEXT
    elif not there <= EXPECTED[kind] or (kind == WHOLE and float in there):
        for value in values:  # numpy would make numbers of texts and truth values, and cut off fractions
            is_whole = not isinstance(value, float) or value.is_integer()
            if value is not None and (type(value) not in EXPECTED[kind] or (kind == WHOLE and not is_whole)):
                expected = {FLAG: "true or false", WHOLE: "a whole number"}.get(kind, f"a {kind}")
                raise ValueError(f"{name}: found {value!r}, expected {expected}")
    if kind == NUMBER:  # counts too: a double holds whole numbers up to 9e15, and has a NaN
        return numpy.array(values, dtype=float)
    if kind == WHOLE:  # a seed may have 19 digits
        return pandas.array(values, dtype="Int64") if None in values else numpy.array(values, dtype="int64")
    if kind == FLAG:
        return pandas.array(values, dtype="boolean") if None in values else numpy.array(values, dtype=bool)
    array = numpy.empty(len(values), dtype=object)
    array[:] = values
    return array


def flatten(value, path, row):
    """Puts a value and all that it holds into a row."""
    if isinstance(value, dict):
        for key, inner in value.items():
            flatten(inner, f"{path}.{key}" if path else key, row)
    elif path in LISTS or (isinstance(value, list) and path.startswith("parameters.")):
        row[path] = hashable(value)
    elif isinstance(value, list):
        names = ("lower", "upper") if path.rpartition(".")[2] == "interval" else range(len(value))
        for name, inner in zip(names, value):
            flatten(inner, f"{path}.{name}", row)
    elif value is not None:
        row[path] = value


def hashable(value):
    if isinstance(value, list):
        return tuple(hashable(inner) for inner in value)
    if isinstance(value, dict):
        return tuple(hashable(inner) for inner in value.values())
    return value


def identity(record):
    """What a run, a series or a search is of. Objects stand as text too, so that one can group by them; the seed, in
    which replicates differ, is left out of that text."""
    row = {key: record[key] for key in ("case", "formulation", "work", "conduction", "walls", "label")}
    row["smoothing_exponent"] = record.get("smoothing_exponent")
    row["parameters"] = text(record["parameters"])
    flatten(record["parameters"], "parameters", row)
    for key, value in record["discretisation"].items():
        if isinstance(value, dict):
            row[key] = text({inner: value[inner] for inner in value if inner != "seed"})
            flatten({inner: value[inner] for inner in value if inner != "id"}, key, row)
        else:
            row[key] = value
    return row


def text(value):
    """{"id": "jittered", "amplitude": 0.1} is `jittered amplitude=0.1`."""
    return " ".join(str(inner) if key == "id" else f"{key}={_short(inner)}" for key, inner in value.items())


def _short(value):
    if isinstance(value, list):
        return f"[{', '.join(_short(inner) for inner in value)}]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return repr(value).removesuffix(".0")  # all digits: texts that are equal are of equal numbers
    return str(value)
