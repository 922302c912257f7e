#!/usr/bin/python3
# SPDX-License-Identifier: 0BSD
"""Particles of a VTK file as a CSV snapshot for `sphverify assess`.

    vtk_to_csv.py FILE OUT.csv [--time T] [--mass M | --spacing DX] [--plane xz]

Reads .vtu through meshio (TrixiParticles), .vtp as text (SPHinXsys) and binary legacy .vtk of points (DualSPHysics). The mass
of a particle comes from an array of masses, from density times volume, from --mass, or from its density times --spacing to
the dimension. What was taken for what is said on standard error.
"""

import argparse
import sys
import xml.etree.ElementTree as ElementTree

import numpy

NAMES = {  # by column; the first that is there, whatever its capitals
    "v": ["velocity", "vel", "initial_velocity"],
    "rho": ["density", "rhop", "rho", "hydrodynamic_density"],
    "P": ["pressure", "press", "p"],
    "e": ["internal_energy", "specificthermalenergy", "u", "e"],
    "T": ["temperature", "temp", "phi"],
    "m": ["mass"],
    "volume": ["volumetricmeasure", "vol", "volume"],
    "h": ["smoothing_length", "smoothinglength", "h"],
    "type": ["type"],
}


def read_vtu(path):
    import meshio

    mesh = meshio.read(path)
    fields = {name: numpy.asarray(values).ravel() for name, values in mesh.field_data.items()}
    return mesh.points, dict(mesh.point_data), fields


def read_vtp(path):
    """PolyData whose arrays are text."""
    root = ElementTree.parse(path).getroot()

    def arrays(place):
        found = {}
        for one in [] if place is None else place.iter("DataArray"):
            if one.get("format", "ascii") != "ascii":
                sys.exit(f"{path}: {one.get('Name')}: found {one.get('format')} numbers, expected ascii")
            values = numpy.array((one.text or "").split(), dtype=float)
            width = int(one.get("NumberOfComponents", 1))
            found[one.get("Name", "Points")] = values.reshape(-1, width) if width > 1 else values
        return found

    points = arrays(root.find(".//Points"))
    return next(iter(points.values())), arrays(root.find(".//PointData")), arrays(root.find(".//FieldData"))


def read_legacy(path):
    """Big-endian points with SCALARS, VECTORS and FIELD arrays."""
    with open(path, "rb") as file:
        kinds = {"float": ">f4", "double": ">f8", "int": ">i4", "unsigned_int": ">u4", "unsigned_char": ">u1", "short": ">i2",
                 "unsigned_short": ">u2"}  # fmt: skip

        def numbers(count, kind):
            kind = numpy.dtype(kinds[kind])
            return numpy.frombuffer(file.read(count * kind.itemsize), kind)

        def words():
            while line := file.readline():
                if text := line.decode("latin-1").split():
                    return text
            return []

        file.readline(), file.readline()
        if words() != ["BINARY"]:
            sys.exit(f"{path}: expected a binary file")
        points, data, count = None, {}, 0
        while head := words():
            if head[0] == "POINTS":
                points = numbers(3 * int(head[1]), head[2]).reshape(-1, 3).astype(float)
            elif head[0] in ("VERTICES", "LINES", "POLYGONS", "CELLS"):
                numbers(int(head[2]), "int")
            elif head[0] == "POINT_DATA":
                count = int(head[1])
            elif head[0] == "SCALARS":
                words()  # LOOKUP_TABLE default
                data[head[1]] = numbers(count, head[2])
            elif head[0] == "VECTORS":
                data[head[1]] = numbers(3 * count, head[2]).reshape(-1, 3)
            elif head[0] == "FIELD":
                for _ in range(int(head[2])):
                    name, width, rows, kind = words()
                    values = numbers(int(width) * int(rows), kind)
                    data[name] = values.reshape(-1, int(width)) if int(width) > 1 else values
    return points, data, {}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file")
    parser.add_argument("out")
    parser.add_argument("--time", type=float, help="where the file does not say it")
    parser.add_argument("--mass", type=float, help="of every particle")
    parser.add_argument("--spacing", type=float, help="of the particles: mass is density times its power")
    parser.add_argument("--plane", default="", help="the axes that are meant, in their order; xz for DualSPHysics in 2D")
    options = parser.parse_args()
    reader = {"vtu": read_vtu, "vtp": read_vtp, "vtk": read_legacy}.get(options.file.rsplit(".", 1)[-1])
    if reader is None:
        sys.exit(f"{options.file}: expected .vtu, .vtp or .vtk")
    points, data, fields = reader(options.file)
    by_name = {name.lower(): (name, numpy.asarray(values, dtype=float)) for name, values in data.items()}
    found = {}
    for column, names in NAMES.items():
        for name in names:
            if name in by_name:
                found[column] = by_name[name][1]
                print(f"{column} is {by_name[name][0]}", file=sys.stderr)
                break
    axes = ["xyz".index(axis) for axis in options.plane] or [k for k in range(3) if k == 0 or numpy.ptp(points[:, k]) > 0]
    columns = {"xyz"[k]: points[:, axis] for k, axis in enumerate(axes)}
    if "v" in found:
        velocity = found["v"].reshape(len(points), -1)
        columns |= {"v" + "xyz"[k]: velocity[:, axis] for k, axis in enumerate(axes)}
    columns |= {name: found[name] for name in ("m", "rho", "h", "P", "e", "T") if name in found}
    if "m" not in columns:
        if options.mass is not None:
            columns["m"] = numpy.full(len(points), options.mass)
        elif "rho" in columns and ("volume" in found or options.spacing is not None):
            columns["m"] = columns["rho"] * found.get("volume", (options.spacing or 0.0) ** len(axes))
        else:
            sys.exit(f"{options.file}: no masses: say --mass or --spacing")
    keep = numpy.ones(len(points), dtype=bool)
    if "type" in found:  # DualSPHysics: 3 is fluid
        keep = found["type"] == 3
        print(f"{(~keep).sum()} particles of other types than fluid left out", file=sys.stderr)
    times = [values[0] for name, values in fields.items() if name.lower() in ("timevalue", "time") and len(values)]
    time = options.time if options.time is not None else (times or [None])[0]
    with open(options.out, "w") as file:
        if time is not None:
            file.write(f"# time = {float(time)!r}\n")
        numpy.savetxt(file, numpy.column_stack([values[keep] for values in columns.values()]), fmt="%.17g", delimiter=",",
                      header=",".join(columns), comments="")  # fmt: skip


if __name__ == "__main__":
    main()
