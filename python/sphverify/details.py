# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run has of a length of its own: history, profile, spectrum, modes. Kept as arrays, made frames when asked for."""

import numpy
import pandas

from .columns import Columns, flatten
from .units import VECTORS

DETAILS = ("history", "profile", "spectrum", "modes")


def take_details(run, index, details):
    """Moves them out of a run."""
    if run.get("history"):
        details["history"][index] = {name: _numbers(values) for name, values in run["history"].items()}
    if run.get("profile"):
        profile = run["profile"]
        details["profile"][index] = {
            "position": _numbers(profile["position"]),
            **{key: _numbers(profile[key]) for key in ("weight",) if key in profile},
            **{f"{of}.{field}": _numbers(values) for of in ("computed", "exact") for field, values in profile[of].items()},
            **{f"regions.{name}": numpy.array(those, dtype="int32") for name, those in profile.get("regions", {}).items()},
        }
    if run.get("spectrum") is not None:
        details["spectrum"][index] = _numbers(run["spectrum"]).reshape(-1, 2)
    stability = run.get("stability") or {}
    if stability.get("modes") is not None:
        details["modes"][index] = stability["modes"]
        run["stability"] = {key: value for key, value in stability.items() if key != "modes"}
    for kind in ("history", "profile", "spectrum"):
        run.pop(kind, None)


def detail_frame(kind, detail):
    return {"history": _history, "profile": _profile, "spectrum": _spectrum, "modes": _modes}[kind](detail)


def _numbers(values):
    return numpy.array(values, dtype=float)  # null is NaN


def _history(history):
    columns = {}
    for name, values in history.items():
        if values.ndim == 1:
            columns[name] = values
        else:
            columns.update({f"{name}.{wall}": of_wall for wall, of_wall in enumerate(values)})
    return pandas.DataFrame(columns)


def _profile(profile):
    columns = {}
    for name, values in profile.items():
        if name.startswith("regions."):
            columns[name] = numpy.zeros(len(profile["position"]), dtype=bool)
            columns[name][values] = True
        elif name == "position" or name.rpartition(".")[2] in VECTORS:
            columns.update({f"{name}.{axis}": values[:, axis] for axis in range(values.shape[1])})
        else:
            columns[name] = values.reshape(len(values))
    return pandas.DataFrame(columns)


def _spectrum(eigenvalues):
    return pandas.DataFrame({"real": eigenvalues[:, 0], "imaginary": eigenvalues[:, 1]})


def _modes(modes):
    columns = Columns()
    for mode in modes:
        row = {}
        flatten(mode, "", row)
        columns.add(row)
    return columns.frame()
