#!/usr/bin/env python3
# SPDX-License-Identifier: 0BSD
"""Stands for your own SPH code: heat conduction between two walls in one dimension, by a dense double loop.

    heat.py rates STATE.json RATES.json          particles and walls for `sphverify evaluate`, and this code's rates on them
    heat.py solve INITIAL.csv FINAL.csv CASE.json    from a case's initial particles to its final time
"""

import csv
import json
import math
import random
import sys


def kernel(r, h):
    """Cubic spline in one dimension [1/m]."""
    q = r / h
    shape = 1 - 1.5 * q**2 + 0.75 * q**3 if q < 1 else 0.25 * max(2 - q, 0) ** 3
    return 2 / (3 * h) * shape


def kernel_slope(r, h):
    """Its derivative [1/m^2]."""
    q = r / h
    slope = -3 * q + 2.25 * q**2 if q < 1 else -0.75 * max(2 - q, 0) ** 2
    return 2 / (3 * h**2) * slope


def heating(x, mass, density, temperature, conductivity, h, walls):
    """de/dt [W/kg] of Brookshaw's form; in one dimension the face weight of a wall is the kernel at its distance."""
    rates = []
    for i in range(len(x)):
        rate = 0.0
        for j in range(len(x)):
            r = abs(x[i] - x[j])
            if j == i or r >= 2 * h:
                continue
            conductance = mass[j] * (conductivity[i] + conductivity[j]) / (density[i] * density[j]) * kernel_slope(r, h) / r
            rate += conductance * (temperature[i] - temperature[j])
        for wall in walls:
            d = abs(x[i] - wall["point"][0])
            conductance = (conductivity[i] + wall["conductivity"]) / density[i] * kernel(d, h) / d
            rate += conductance * (wall["temperature"] - temperature[i])
        rates.append(rate)
    return rates


def write(path, document):
    with open(path, "w") as file:
        json.dump(document, file, indent=1, allow_nan=False)
        file.write("\n")


def write_rates(state_path, rates_path):
    count = 24
    spacing = 1 / count  # m
    h = 1.3 * spacing
    walls = [  # the fluid lies between them; temperatures in K, conductivities in W/(m K)
        {"point": [0.0], "outward_normal": [-1.0], "temperature": 1.0, "conductivity": 0.5},
        {"point": [1.0], "outward_normal": [1.0], "temperature": 2.0, "conductivity": 1.0},
    ]
    numbers = random.Random(1)
    x = [(i + 0.5 + numbers.uniform(-0.2, 0.2)) * spacing for i in range(count)]
    density = [1 + 0.2 * xi for xi in x]  # kg/m^3
    mass = [rho * spacing for rho in density]
    temperature = [1 + xi**2 for xi in x]
    conductivity = [0.5 * t for t in temperature]

    particles = {
        "position": [[xi] for xi in x],
        "mass": mass,
        "smoothing_length": h,
        "density": density,
        "temperature": temperature,
        "conductivity": conductivity,
    }
    write(state_path, {"schema": "sphverify-state/1", "dimension": 1, "particles": particles, "walls": walls})
    rates = {"conduction/brookshaw": {"heating": heating(x, mass, density, temperature, conductivity, h, walls)}}
    write(rates_path, {"rates": rates})


def solve(initial_path, final_path, case_path):
    with open(case_path) as file:
        case = json.load(file)
    with open(initial_path) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    x, mass, density, temperature, conductivity = ([float(row[name]) for row in rows] for name in ("x", "m", "rho", "T", "K"))
    h = float(rows[0]["h"])
    walls = [{"point": wall["point"], **wall["prescribes"]} for wall in case["walls"]]
    steps = math.ceil(case["final_time"] * max(conductivity) / (0.2 * case["spacing"] ** 2))
    dt = case["final_time"] / steps

    def rates(values):
        return heating(x, mass, density, values, conductivity, h, walls)

    for _ in range(steps):  # the midpoint rule
        half = [t + 0.5 * dt * rate for t, rate in zip(temperature, rates(temperature))]
        temperature = [t + dt * rate for t, rate in zip(temperature, rates(half))]
    with open(final_path, "w") as file:
        file.write(f"# time = {case['final_time']!r}\nx,m,rho,h,T\n")
        for one in zip(x, mass, density, [h] * len(x), temperature):
            file.write(",".join(repr(value) for value in one) + "\n")


if __name__ == "__main__":
    task, *paths = sys.argv[1:]
    {"rates": write_rates, "solve": solve}[task](*paths)
