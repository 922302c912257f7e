#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gresho's vortex as others measure it: its mean azimuthal velocity over annuli, from results with the measure `profile`.

    sphverify study cases/studies/gresho-published-2d.json -o gresho.json
    bench/gresho_profile.py gresho.json

Our norms take every particle's velocity, noise and all. Others, after Springel (2010, Mon. Not. R. Astron. Soc. 401, 791), compare
the azimuthal velocity averaged over bins of the radius, from which noise is gone. Printed are the l1
norms of both, in units of the fastest velocity, 1: ours of the velocity, and the mean over annuli one spacing wide,
to r = 0.5, of the mean azimuthal velocity's error. The order is the slope of a straight line through the levels.
"""
import collections
import json
import math
import sys

EDGE = 0.5


def exact(r):
    return 5 * r if r < 0.2 else max(0.0, 2 - 5 * r)


def error_of_annuli(run):
    annuli = collections.defaultdict(list)
    for (x, y), (u, v) in zip(run["profile"]["position"], run["profile"]["computed"]["velocity"]):
        x, y = (x + 0.5) % 1.0 - 0.5, (y + 0.5) % 1.0 - 0.5
        r = math.hypot(x, y)
        if 0 < r < EDGE:
            annuli[int(r / run["spacing"])].append((x * v - y * u) / r - exact(r))
    return sum(abs(sum(of_one) / len(of_one)) for of_one in annuli.values()) / len(annuli)


def order(spacings, errors):
    x, y = [math.log(s) for s in spacings], [math.log(e) for e in errors]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: gresho_profile.py RESULTS.json")
    with open(sys.argv[1], encoding="utf-8") as file:
        document = json.load(file)
    ladders = collections.defaultdict(list)
    for index, run in enumerate(document["runs"]):
        if run["case"] != "hydro/gresho" or (run["status"] == "ok" and not run.get("profile")):
            sys.exit(f"{sys.argv[1]}: runs[{index}]: expected hydro/gresho with the measure `profile`")
        if run["status"] == "ok":
            ladders[run["formulation"], json.dumps(run["discretisation"]["viscosity"])].append(run)
    for (form, viscosity), runs in ladders.items():
        ours = [run["errors"]["velocity"]["all"]["l1"] for run in runs]
        theirs = [error_of_annuli(run) for run in runs]
        spacings = [run["spacing"] for run in runs]
        print(f"{form}, viscosity {viscosity}: N = {', '.join(str(run['resolution']) for run in runs)}")
        for name, errors in (("velocity", ours), ("annuli", theirs)):
            slope = f", order {order(spacings, errors):.2f}" if len(runs) > 1 else ""
            print(f"  {name:9}" + ", ".join(f"{error:.4f}" for error in errors) + slope)


if __name__ == "__main__":
    main()
