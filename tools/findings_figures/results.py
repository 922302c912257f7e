# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of a results document by their traits, and what a figure shows of them."""

import dataclasses
import json
import math

# The field that a case is about is the first of these that it has (reports/leading_fields.hpp).
LEADING_FIELDS = ("temperature", "velocity", "acceleration", "heating")


class ResultsError(Exception):
    """A document that is not there, or does not hold what a figure shows."""


def load(path):
    try:
        document = json.loads(path.read_text())
    except (OSError, ValueError) as error:
        raise ResultsError(f"{path}: {error}")
    found = document.get("schema") if isinstance(document, dict) else None
    if found != "sphverify-results/1":
        raise ResultsError(f"{path}: schema: expected sphverify-results/1, found {found}")
    return document


# Traits: what a run was told. One name space for the run, its discretisation and its case's parameters.


def layout_word(layout):
    """lattice, jitter 0.3, glass; seeds do not count."""
    if isinstance(layout, str):
        return layout
    word = f"jitter {layout['amplitude']:g}" if layout["id"] == "jittered" else layout["id"]
    return word + (", masses voronoi" if layout.get("masses") == "voronoi" else "")


def traits(run):
    chosen = {**run["discretisation"], "layout": layout_word(run["discretisation"]["layout"])}
    chosen.setdefault("pair_weight", "kernel")  # documents before there was another
    names = ("case", "formulation", "work", "conduction", "walls", "label", "smoothing_exponent", "resolution")
    own = {**chosen, **{name: run[name] for name in names}}
    # The square, too, has a parameter `walls`: it is called case_walls here.
    return {**{f"case_{name}" if name in own else name: value for name, value in run["parameters"].items()}, **own}


def select(runs, **wanted):
    """Runs whose traits are as wanted: select(runs, walls="mirror", layout="jitter 0.3", smoothing_ratio=1.2)."""
    return [run for run in runs if all(traits(run).get(name) == value for name, value in wanted.items())]


# Measures: functions of a run that give a number, or None where the run broke or has no such number.


def error(field=None, norm="l2", region="all", relative=True):
    """Of the leading field unless named; relative to the same norm of the exact field."""

    def measure(run):
        name = field or next((name for name in LEADING_FIELDS if name in run["errors"]), None)
        here = run["errors"].get(name, {}).get(region)
        if here is None or here[norm] is None or not relative:
            return here and here[norm]
        return here[norm] / here["scale"][norm] if here["scale"][norm] else None

    return measure


def behind_shock(quantity="pressure"):
    """Size of the relative error of the mean over the plateau behind the first shock."""

    def measure(run):
        error = run["shocks"][0]["plateau"][quantity] if run.get("shocks") else None
        return None if error is None else abs(error)

    return measure


def growth(run):
    """Spectral abscissa in K/(rho dx^2), of cases whose K and rho are 1."""
    abscissa = (run["stability"] or {}).get("spectral_abscissa")
    return None if abscissa is None else abscissa * run["spacing"] ** 2


def seconds(run):
    """Median of the repeats' wall time."""
    return (run["cost"] or {}).get("median_seconds")


def processor_seconds(run):
    """Of the fastest repeat; what other work on the machine took does not count."""
    return (run["cost"] or {}).get("cpu_seconds")


def energy_made(run):
    """Size of what pairs of particles made or lost of the energy, over what was there; at least a rounding of it."""
    energy = run["conservation"]["energy"]
    if energy is None or energy["pair_drift"] is None or not energy["initial"]:
        return None
    return max(abs(energy["pair_drift"] / energy["initial"]), 1e-16)


# Points: runs that differ in the seed alone are one.


@dataclasses.dataclass
class Point:
    x: float
    y: float
    low: float
    high: float
    broken: int  # runs that did not end ok; the numbers are of the others


def geometric_mean(values):
    """0 if one is: what is exact has no logarithm."""
    return math.exp(sum(map(math.log, values)) / len(values)) if all(value > 0 for value in values) else 0.0


def points(runs, along, y, x=None, middle=geometric_mean):
    """One for each value of the trait `along`, at that value or at the mean of the measure x."""
    refuse_mixtures(runs, along)
    result = []
    for value in sorted({traits(run)[along] for run in runs}):
        alike = select(runs, **{along: value})
        ended = [run for run in alike if run["status"] == "ok" and y(run) is not None]
        numbers = [y(run) for run in ended]
        places = [value] if x is None else [x(run) for run in ended if x(run) is not None]
        nan = math.nan
        spread = (middle(numbers), min(numbers), max(numbers)) if numbers else (nan, nan, nan)
        result.append(Point(geometric_mean(places) if x and places else value if x is None else nan, *spread,
                            sum(run["status"] != "ok" for run in alike)))
    return result


def refuse_mixtures(runs, along):
    """A mean over densities or closures, say, would be of nothing: seeds alone may differ, and N where it is a path."""
    if not runs:
        raise ResultsError("no runs")
    for name in traits(runs[0]):
        values = {json.dumps(traits(run).get(name), sort_keys=True) for run in runs}
        if name != along and len(values) > 1:
            raise ResultsError(f"{name} is not chosen: {', '.join(sorted(values))}")
