#!/usr/bin/env python3
"""Stands for your own SPH code: heat conduction between two walls in one dimension, by a dense double loop.

Usage: heat.py STATE.json RATES.json
Writes the particles and walls, for `sphverify evaluate`, and the rates that this code computes for them.
"""

import json
import random
import sys

COUNT = 24
SPACING = 1 / COUNT  # m
SMOOTHING_LENGTH = 1.3 * SPACING  # m
WALLS = [  # the fluid lies between them; temperatures in K, conductivities in W/(m K)
    {"point": [0.0], "outward_normal": [-1.0], "temperature": 1.0, "conductivity": 0.5},
    {"point": [1.0], "outward_normal": [1.0], "temperature": 2.0, "conductivity": 1.0},
]


def kernel(r):
    """Cubic spline in one dimension [1/m]."""
    q = r / SMOOTHING_LENGTH
    shape = 1 - 1.5 * q**2 + 0.75 * q**3 if q < 1 else 0.25 * max(2 - q, 0) ** 3
    return 2 / (3 * SMOOTHING_LENGTH) * shape


def kernel_slope(r):
    """Its derivative [1/m^2]."""
    q = r / SMOOTHING_LENGTH
    slope = -3 * q + 2.25 * q**2 if q < 1 else -0.75 * max(2 - q, 0) ** 2
    return 2 / (3 * SMOOTHING_LENGTH**2) * slope


def heating(x, mass, density, temperature, conductivity):
    """de/dt [W/kg] of Brookshaw's form; in one dimension the face weight of a wall is the kernel at its distance."""
    rates = []
    for i in range(COUNT):
        rate = 0.0
        for j in range(COUNT):
            if j == i:
                continue
            r = abs(x[i] - x[j])
            conductance = mass[j] * (conductivity[i] + conductivity[j]) / (density[i] * density[j]) * kernel_slope(r) / r
            rate += conductance * (temperature[i] - temperature[j])
        for wall in WALLS:
            d = abs(x[i] - wall["point"][0])
            conductance = (conductivity[i] + wall["conductivity"]) / density[i] * kernel(d) / d
            rate += conductance * (wall["temperature"] - temperature[i])
        rates.append(rate)
    return rates


def write(path, document):
    with open(path, "w") as file:
        json.dump(document, file, indent=1, allow_nan=False)
        file.write("\n")


def main(state_path, rates_path):
    numbers = random.Random(1)
    x = [(i + 0.5 + numbers.uniform(-0.2, 0.2)) * SPACING for i in range(COUNT)]
    density = [1 + 0.2 * xi for xi in x]  # kg/m^3
    mass = [rho * SPACING for rho in density]
    temperature = [1 + xi**2 for xi in x]
    conductivity = [0.5 * t for t in temperature]

    particles = {
        "position": [[xi] for xi in x],
        "mass": mass,
        "smoothing_length": SMOOTHING_LENGTH,
        "density": density,
        "temperature": temperature,
        "conductivity": conductivity,
    }
    write(state_path, {"schema": "sphverify-state/1", "dimension": 1, "particles": particles, "walls": WALLS})
    rates = {"conduction/brookshaw": {"heating": heating(x, mass, density, temperature, conductivity)}}
    write(rates_path, {"rates": rates})


if __name__ == "__main__":
    main(*sys.argv[1:])
