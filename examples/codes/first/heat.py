#!/usr/bin/python3
# SPDX-License-Identifier: 0BSD
"""A code to be verified, of the size of a first one: heat conduction by SPH in one dimension, in plain Python.

    python3 heat.py INITIAL.csv FINAL.csv CASE.json

INITIAL holds the particles that `sphverify particles` wrote, CASE.json what stands beside them: walls and final time.
"""
import csv
import json
import math
import sys


def kernel_slope(r, h):
    """W'(r) of the cubic spline in one dimension, support 2h."""
    q = r / h
    shape = -3 * q + 2.25 * q * q if q < 1 else -0.75 * (2 - q) ** 2 if q < 2 else 0
    return 2 / 3 / h**2 * shape


def main():
    initial, final, case = sys.argv[1:]
    sheet = json.load(open(case))
    with open(initial) as file:
        file.readline()  # "# time = 0"
        particles = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    x, m, rho, h, T, K = ([one[name] for one in particles] for name in ("x", "m", "rho", "h", "T", "K"))
    n = len(x)

    # Behind each wall stand images of the particles within its reach: (particle, place, temperature of the wall).
    images = [(i, 2 * wall["point"][0] - x[i], wall["prescribes"]["temperature"])
              for wall in sheet["walls"] for i in range(n) if abs(x[i] - wall["point"][0]) < 2 * h[i]]

    # Brookshaw's form: dT_i/dt = sum_j m_j (K_i + K_j)/(rho_i rho_j) (T_i - T_j) W'(r_ij)/r_ij, with specific heat 1.
    def weight(i, j, distance):
        return m[j] * (K[i] + K[j]) / (rho[i] * rho[j]) * kernel_slope(distance, 0.5 * (h[i] + h[j])) / distance

    pairs = [(i, j, weight(i, j, abs(x[i] - x[j])))
             for i in range(n) for j in range(n) if i != j and abs(x[i] - x[j]) < h[i] + h[j]]
    mirrored = [(i, j, wall, weight(i, j, abs(x[i] - place)))
                for i in range(n) for j, place, wall in images if abs(x[i] - place) < h[i] + h[j]]

    end = sheet["final_time"]
    steps = math.ceil(end / (0.2 * sheet["spacing"] ** 2 * min(rho) / max(K)))
    for _ in range(steps):
        rate = [0.0] * n
        for i, j, w in pairs:
            rate[i] += w * (T[i] - T[j])
        for i, j, wall, w in mirrored:
            image = 2 * wall - T[j]
            rate[i] += w * (T[i] - image)
        T = [value + end / steps * change for value, change in zip(T, rate)]

    with open(final, "w") as file:
        print(f"# time = {end}\nx,m,rho,h,T,K", file=file)
        for row in zip(x, m, rho, h, T, K):
            print(*row, sep=",", file=file)


if __name__ == "__main__":
    main()
