# SPDX-License-Identifier: GPL-3.0-or-later
"""The extreme catalogue as a test: every run of it ends, as an answer with its error or as a failure that says why.

    catalogue.py SPHVERIFY [--sample] [--patience FACTOR] [--keep FOLDER]

Runs cases/studies/extremes*.json, or of each a sample that takes seconds, and looks at every run in the results. Exit
status 1 if one is not as it must be.
"""

import argparse
import collections
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time

STUDIES = pathlib.Path(__file__).resolve().parents[2] / "cases" / "studies"
FAILURES = {"unstable", "non-finite", "positivity-lost", "timed-out", "invalid"}
MOST_BROKEN = 0.5  # of the runs: scenes are extreme, not hopeless
POWERS_OF_TWO = {2.0**100, 2.0**-100}
UNITS = ("length_unit", "mass_unit", "time_unit", "temperature_unit")


def sampled(study):
    """Every case and formulation, at the first of most other choices, and the first hundredth of long runs."""
    study["time_budget"] = 3
    for case in study["cases"]:
        if study["name"] == "extremes-long":
            case["parameters"]["final_time"] *= 0.01
    study["resolution"] = study["resolution"][:2] if len(study["resolution"]) > 1 else [20]
    choices = study.get("discretisation", {})
    for key in choices.keys() - {"layout", "density", "integrator", "smoothing_ratio"}:
        if isinstance(choices[key], list):
            choices[key] = choices[key][:1]
    if len(study["cases"]) > 1 and isinstance(choices.get("layout"), list):
        choices["layout"] = choices["layout"][:1]
    return study


def refuse_constant(word):
    raise ValueError(f"{word} in a document")


def complaint(run, measures):
    """What is wrong with a run's record, or None."""
    if run["status"] == "ok":
        if run["reason"] is not None:
            return f"ok, and yet a reason: {run['reason']}"
        norms = [
            (field, region, name, value)
            for field, regions in run["errors"].items()
            for region, record in regions.items()
            for name, value in record.items()
            if name in ("l1", "l2", "linf")
        ]
        if "error" in measures and not norms:
            return "ok without an error"
        if "conservation" in measures and not run["conservation"]:
            return "ok without budgets"
        for field, region, name, value in norms:
            # A region without particles has none; an answer is a number.
            if region == "all" and (value is None or not math.isfinite(value)):
                return f"ok with {name} error {value} of {field}"
        return None
    if run["status"] not in FAILURES:
        return f"status {run['status']}"
    return None if run["reason"] else f"{run['status']} without a reason"


def discretisation(run):
    return json.dumps([run["formulation"], run["discretisation"], run["resolution"]], sort_keys=True)


def unit_complaints(runs):
    """With units that are powers of two, errors are those of units of 1 to the last bit."""
    by_choice = collections.defaultdict(dict)
    for run in runs:
        if run["case"] in ("extreme/units", "extreme/gas-units"):
            units = {run["parameters"][name] for name in UNITS if name in run["parameters"]}
            if len(units) == 1:
                by_choice[run["case"], discretisation(run)][units.pop()] = run
    for (case, choice), of_unit in by_choice.items():
        for unit in POWERS_OF_TWO & of_unit.keys():
            if 1.0 not in of_unit:
                continue
            usual, scaled = of_unit[1.0], of_unit[unit]
            if "timed-out" in (usual["status"], scaled["status"]):
                continue
            if usual["status"] != scaled["status"]:
                yield f"{case} {choice}: {usual['status']} becomes {scaled['status']} with units of {unit:g}"
            if usual["status"] == scaled["status"] == "ok" and not same_errors(usual, scaled):
                yield f"{case} {choice}: other errors with units of {unit:g}"


def same_errors(run, scaled):
    """Mantissas are the same to the last bit, and so but for rounding are errors relative to the field's norm."""
    for field, regions in run["errors"].items():
        one, other = regions["all"], scaled["errors"][field]["all"]
        for name in ("l1", "l2", "linf"):
            if math.frexp(one[name])[0] != math.frexp(other[name])[0]:
                return False
            if not math.isclose(one[name] * other["scale"][name], other[name] * one["scale"][name], rel_tol=1e-12):
                return False
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sphverify")
    parser.add_argument("--sample", action="store_true", help="the part that fast tests run")
    parser.add_argument("--patience", type=float, default=1.0, help="factor for time budgets, of a slower build")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the results")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        wrong = 0
        for path in sorted(STUDIES.glob("extremes*.json")):
            study = json.loads(path.read_text())
            if options.sample:
                study = sampled(study)
            study["time_budget"] *= options.patience
            document = folder / path.name
            results = folder / f"{path.stem}.results.json"
            document.write_text(json.dumps(study))
            start = time.monotonic()
            done = subprocess.run(
                [options.sphverify, "study", document, "-o", results], capture_output=True, text=True, check=False
            )
            seconds = time.monotonic() - start
            if done.returncode != 0:
                print(f"{path.stem}: exit status {done.returncode}\n{done.stderr[-2000:]}")
                wrong += 1
                continue
            runs = json.loads(results.read_text(), parse_constant=refuse_constant)["runs"]
            ends = collections.Counter(run["status"] for run in runs)
            print(f"{path.stem}: {len(runs)} runs in {seconds:.0f} s:", dict(ends.most_common()))
            complaints = [
                f"{run['case']} {discretisation(run)}: {found}"
                for run in runs
                if (found := complaint(run, study["measure"]))
            ]
            complaints += unit_complaints(runs)
            # What a busy machine has no time for is no mistake.
            broken = len(runs) - ends["ok"] - ends["timed-out"]
            if broken > MOST_BROKEN * len(runs):
                complaints.append(f"{broken} of {len(runs)} runs break")
            for one in complaints:
                print(f"  wrong: {one}")
            wrong += len(complaints) + (not runs)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
