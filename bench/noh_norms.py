#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Norms of Noh's problem as another code takes them, beside ours, from the results of a study with the measure `profile`.

    sphverify study cases/studies/noh-published-1d.json -o noh.json
    bench/noh_norms.py noh.json

Spheral's planar test (tests/functional/Hydro/Noh/Noh-planar-1d.py, its Pnorm.gridpnorm) weighs an error by the spacing of the
particles at the end, half the distance between both neighbours, each clipped to the window, and divides by the sum of the
weights within it. Ours are the volumes that the particles have in the exact solution. Both print absolute l1 norms.
"""
import json
import sys

FIELDS = ("density", "pressure", "velocity", "internal_energy")


def number(value):
    return value[0] if isinstance(value, list) else value


def spacings(places, window):
    """Of each particle in the window, by index."""
    low, high = window
    order = sorted(range(len(places)), key=places.__getitem__)
    clipped = [min(high, max(low, places[i])) for i in order]
    last = len(order) - 1
    return {i: 0.5 * (clipped[min(n + 1, last)] - clipped[max(n - 1, 0)]) for n, i in enumerate(order) if low <= places[i] <= high}


def l1(weights, computed, exact):
    total = sum(weights.values())
    return sum(w * abs(number(computed[i]) - number(exact[i])) for i, w in weights.items()) / total


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: noh_norms.py RESULTS.json")
    with open(sys.argv[1], encoding="utf-8") as file:
        document = json.load(file)
    for index, run in enumerate(document["runs"]):
        if run["case"] != "hydro/noh" or run["parameters"].get("window") is None or (run["status"] == "ok" and not run.get("profile")):
            sys.exit(f"{sys.argv[1]}: runs[{index}]: expected hydro/noh with a window and the measure `profile`")
    print(f"{'':72}" + "".join(f"{field:>24}" for field in FIELDS))
    print(f"{'':72}" + f"{'spacings':>14}{'volumes':>10}" * len(FIELDS))
    for run in document["runs"]:
        if run["status"] != "ok":
            continue
        profile = run["profile"]
        places = [number(x) for x in profile["position"]]
        window = run["parameters"]["window"]
        by_spacing = spacings(places, window)
        by_volume = {i: profile["weight"][i] for i in by_spacing}
        choice = run["discretisation"]
        form = run["formulation"]
        name = f"{form}, walls {run['walls']}, {choice['density']}, {choice['smoothing']}, {choice['closure']}"
        norms = [(l1(w, profile["computed"][f], profile["exact"][f])) for f in FIELDS for w in (by_spacing, by_volume)]
        print(f"{name:72}" + "".join(f"{a:14.4f}{b:10.4f}" for a, b in zip(norms[::2], norms[1::2])))


if __name__ == "__main__":
    main()
