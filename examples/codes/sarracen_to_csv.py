#!/usr/bin/env python3
# SPDX-License-Identifier: 0BSD
"""A dump of Phantom (or another that sarracen reads) as a CSV snapshot for `sphverify assess`.

    sarracen_to_csv.py DUMP OUT.csv

Needs sarracen (pip install sarracen). Phantom stores h in single precision, and rho = m (hfact/h)^3 follows from it: errors of
the density below 2e-7 of it say nothing. Its h is ours, its gas is always three-dimensional.
"""

import argparse
import sys

COLUMNS = {"x": "x", "y": "y", "z": "z", "vx": "vx", "vy": "vy", "vz": "vz", "m": "m", "rho": "rho", "h": "h", "P": "P",
           "u": "e", "T": "T"}  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dump")
    parser.add_argument("out")
    options = parser.parse_args()
    import sarracen

    read = sarracen.read_phantom(options.dump)
    gas = read[0] if isinstance(read, list) else read  # sink particles come second
    alive = gas["h"] > 0
    print(f"{(~alive).sum()} dead particles left out", file=sys.stderr)
    gas = gas[alive].copy()
    if "m" not in gas:
        gas["m"] = gas.params["mass"]
    if "rho" not in gas:
        gas["rho"] = gas["m"] * (gas.params["hfact"] / gas["h"]) ** 3
    names = [name for name in COLUMNS if name in gas]
    with open(options.out, "w") as file:
        file.write(f"# time = {float(gas.params['time'])!r}\n")
        if "gamma" in gas.params:
            file.write(f"# gamma = {float(gas.params['gamma'])!r}\n")
        file.write(",".join(COLUMNS[name] for name in names) + "\n")
        for row in zip(*(gas[name] for name in names)):
            file.write(",".join(repr(float(value)) for value in row) + "\n")


if __name__ == "__main__":
    main()
