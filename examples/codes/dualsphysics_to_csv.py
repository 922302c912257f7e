#!/usr/bin/python3
# SPDX-License-Identifier: 0BSD
"""A CSV file of DualSPHysics (PartCsv_0001.csv, or PartVTK's) as a CSV snapshot for `sphverify assess`.

    dualsphysics_to_csv.py FILE OUT.csv --time T (--mass M | --spacing DX) [--plane xz]

Its columns have units in their heads and ';' between them; only fluid is kept (Type 3, or all where no type is written). In two
dimensions its plane is x-z.
"""

import argparse
import csv
import sys

NAMES = {"Pos.x": "x", "Pos.y": "y", "Pos.z": "z", "Vel.x": "vx", "Vel.y": "vy", "Vel.z": "vz", "Rho": "rho", "Rhop": "rho",
         "Press": "P", "Mass": "m"}  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file")
    parser.add_argument("out")
    parser.add_argument("--time", type=float, required=True)
    parser.add_argument("--mass", type=float)
    parser.add_argument("--spacing", type=float)
    parser.add_argument("--plane", default="xyz", help="the axes that are meant, in their order [xyz]")
    options = parser.parse_args()
    with open(options.file, newline="") as file:
        lines = file.read().splitlines()
    first = next((k for k, line in enumerate(lines) if line.startswith("Pos.x")), None)
    if first is None:
        sys.exit(f"{options.file}: found no line of names that begins with Pos.x")
    separator = ";" if ";" in lines[first] else ","
    rows = list(csv.reader(lines[first:], delimiter=separator))
    heads = [head.split("[")[0].strip() for head in rows[0]]
    rows = [dict(zip(heads, row)) for row in rows[1:] if any(row)]
    fluid = [row for row in rows if row.get("Type", "3").strip().lower() in ("3", "fluid")]
    print(f"{len(rows) - len(fluid)} particles of other types than fluid left out", file=sys.stderr)
    columns = {NAMES[head]: [float(row[head]) for row in fluid] for head in heads if head in NAMES}
    axes = dict(zip(options.plane, "xyz"))
    kept = {}
    for name, values in columns.items():
        if name[-1] in "xyz" and name not in ("rho",):
            if name[-1] in axes:
                kept[name[:-1] + axes[name[-1]]] = values
        else:
            kept[name] = values
    if "m" not in kept:
        if options.mass is None and (options.spacing is None or "rho" not in kept):
            sys.exit(f"{options.file}: no masses: say --mass or --spacing")
        volume = None if options.spacing is None else options.spacing ** len(options.plane)
        kept["m"] = [options.mass if volume is None else rho * volume for rho in kept.get("rho", [0] * len(fluid))]
    with open(options.out, "w") as file:
        file.write(f"# time = {options.time!r}\n" + ",".join(kept) + "\n")
        for row in zip(*kept.values()):
            file.write(",".join(repr(value) for value in row) + "\n")


if __name__ == "__main__":
    main()
