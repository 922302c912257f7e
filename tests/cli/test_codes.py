# SPDX-License-Identifier: GPL-3.0-or-later
"""Other codes: initial particles for them (`particles`), their snapshots (`assess`), and codes that a study runs itself."""

import sys

sys.dont_write_bytecode = True

import csv
import json
import math
import os
import pathlib
import signal
import subprocess
import time
import unittest

from program import PROGRAM, PROGRAM_ERROR, SOURCE_DIR, USER_ERROR, ProgramTest, complaints, small_study, strict_json

SLAB = {"id": "conduction/slab-dirichlet", "parameters": {"final_time": 0.01}}
PYTHON = "/usr/bin/python3"
RELEASED = 0.25  # by hydro/sedov in the quarter of its plane

# A code of its own: the heat equation by finite differences between walls of prescribed temperature.
HEAT = """
import json, math, sys
initial, final, sheet, end = sys.argv[1:5]
lines = [line for line in open(initial) if not line.startswith("#")]
names = lines[0].strip().split(",")
rows = [[float(cell) for cell in line.split(",")] for line in lines[1:]]
column = {name: [row[k] for row in rows] for k, name in enumerate(names)}
sheet = json.load(open(sheet))
left, right = (wall["prescribes"]["temperature"] for wall in sheet["walls"])
T, K, dx, end = column["T"], column["K"][0], sheet["spacing"], float(end)
steps = math.ceil(end / (0.25 * dx * dx / K))
for _ in range(steps):
    g = [2 * left - T[0], *T, 2 * right - T[-1]]
    T = [T[i] + end / steps * K * (g[i] - 2 * g[i + 1] + g[i + 2]) / dx**2 for i in range(len(T))]
print("steps:", steps)
with open(final, "w") as file:
    file.write(f"# time = {end}\\nx,m,rho,T\\n")
    for i, x in enumerate(column["x"]):
        file.write(f"{x!r},{column['m'][i]!r},{column['rho'][i]!r},{T[i]!r}\\n")
"""


def read_csv(path):
    """Comments, and the columns by name."""
    lines = pathlib.Path(path).read_text().splitlines()
    comments = [line for line in lines if line.startswith("#")]
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    return comments, {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}


def write_csv(path, columns, time=None):
    with open(path, "w") as file:
        if time is not None:
            file.write(f"# time = {time!r}\n")
        file.write(",".join(columns) + "\n")
        for row in zip(*columns.values()):
            file.write(",".join(repr(value) for value in row) + "\n")


class Codes(ProgramTest):
    def particles(self, case, *options, name="initial.csv"):
        """The file's path, and the sheet beside it."""
        path = self.folder / name
        self.succeed("particles", case, *options, "-o", str(path))
        sheet = strict_json((self.folder / f"{name}.case.json").read_text())
        self.assertEqual(complaints("sphverify-particles-1", sheet), [])
        return path, sheet

    def exact(self, case, time, points, *parameters):
        words = [word for one in parameters for word in ("--parameter", one)]
        return strict_json(
            self.succeed("exact", case, *words, "--time", repr(time), "--points=" + ",".join(points))
        )["fields"]

    def snapshots(self, entries, case=SLAB, **changes):
        document = {"schema": "sphverify-snapshots/1", "name": "my-code", "case": case, "snapshots": entries, **changes}
        document = {key: value for key, value in document.items() if value is not None}
        path = self.folder / "snapshots.json"
        path.write_text(json.dumps(document))
        return path

    def assess(self, entries, *arguments, **changes):
        path = self.snapshots(entries, **changes)
        self.assertEqual(complaints("sphverify-snapshots-1", json.loads(path.read_text())), [])
        results = self.folder / "assessed.json"
        done = self.run_program("assess", path, "-o", results)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.said = done.stderr
        document = strict_json(results.read_text())
        self.assertEqual(complaints("sphverify-results-1", document), [])
        return document

    def refused(self, entries, *words, **changes):
        path = self.snapshots(entries, **changes)
        self.assert_user_error(self.run_program("assess", path, "-o", self.folder / "none.json"), *words)

    def slab_snapshot(self, n, time=0.01, change=lambda x, T: T, name=None):
        """The exact temperatures of the slab with something done to them."""
        x = [(i + 0.5) / n for i in range(n)]
        T = self.exact("conduction/slab-dirichlet", time, [repr(one) for one in x])["temperature"]
        path = name or f"n{n}.csv"
        write_csv(self.folder / path, {"x": x, "m": [1 / n] * n, "T": [change(a, b) for a, b in zip(x, T)]}, time)
        return path


class Particles(Codes):
    def test_particles_are_those_that_our_runs_begin_with(self):
        path, sheet = self.particles("conduction/slab-dirichlet", "-n", "8")
        comments, columns = read_csv(path)
        self.assertEqual(comments, ["# time = 0"])
        self.assertEqual(list(columns), ["x", "m", "rho", "h", "T", "K"])
        self.assertEqual(columns["x"], [(i + 0.5) / 8 for i in range(8)])
        self.assertEqual(columns["m"], [1 / 8] * 8)
        self.assertEqual(columns["h"], [0.15] * 8)
        for x, T in zip(columns["x"], columns["T"]):
            self.assertAlmostEqual(T, 1 + x + math.sin(math.pi * x) + 0.5 * math.sin(3 * math.pi * x), delta=1e-14)
        self.assertEqual((sheet["spacing"], sheet["smoothing_length"], sheet["final_time"]), (0.125, 0.15, 0.05))
        self.assertEqual([wall["prescribes"]["temperature"] for wall in sheet["walls"]], [1, 2])
        self.assertEqual([wall["outward_normal"] for wall in sheet["walls"]], [[-1], [1]])
        self.assertEqual(sheet["particles"], 8)

    def test_a_cell_that_a_jump_cuts_has_what_it_holds(self):
        path, sheet = self.particles("hydro/riemann", "-n", "5")
        _, columns = read_csv(path)
        # Half of the middle one is the gas on the left: mass 0.1, energy 0.25; the other half 0.0125 and 0.025.
        self.assertAlmostEqual(columns["m"][2], 0.1125, delta=1e-15)
        self.assertAlmostEqual(columns["e"][2], 0.275 / 0.1125, delta=1e-14)
        self.assertAlmostEqual(columns["P"][2], 0.4 * 0.5625 * 0.275 / 0.1125, delta=1e-14)
        self.assertEqual(sheet["gamma"], 1.4)

    def test_energy_released_at_a_point_is_all_there(self):
        path, sheet = self.particles("hydro/sedov", "-n", "20", "-p", "dimension=2")
        _, columns = read_csv(path)
        cold = min(columns["e"])
        released = sum(m * (e - cold) for m, e in zip(columns["m"], columns["e"]))
        self.assertAlmostEqual(released, RELEASED, delta=1e-12)
        near = [math.hypot(x, y) for x, y, e in zip(columns["x"], columns["y"], columns["e"]) if e > 2 * cold]
        self.assertLess(max(near), 2 * sheet["smoothing_length"])
        self.assertIn("energy at a point, which the particles have", sheet["driven_by"])

    def test_every_case_and_layout_is_written(self):
        listed = strict_json(self.succeed("list", "cases", "--json"))
        ids = [one["id"] for one in listed["cases"]] if "cases" in listed else [one["id"] for one in listed["entries"]]
        self.assertGreater(len(ids), 15)
        for case in ids:
            done = self.run_program("particles", case, "-n", "12", "-o", str(self.folder / "one.csv"))
            if done.returncode == USER_ERROR:
                self.assertIn("reference", done.stderr + done.stdout, f"{case}: {done.stderr}")
                continue
            self.assertEqual(done.returncode, 0, f"{case}: {done.stderr}")
            _, columns = read_csv(self.folder / "one.csv")
            sheet = strict_json((self.folder / "one.csv.case.json").read_text())
            self.assertEqual(complaints("sphverify-particles-1", sheet), [], case)
            self.assertEqual(len(columns["m"]), sheet["particles"], case)
            self.assertTrue(all(m > 0 for m in columns["m"]), case)
        layouts = {"hexagonal": "conduction/manufactured dimension=2", "close-packed": "conduction/manufactured dimension=3",
                   '{"id": "glass", "seed": 1}': "conduction/manufactured dimension=2", "equal-mass": "hydro/riemann",
                   '{"id": "jittered", "amplitude": 0.2, "seed": 3}': "hydro/riemann", "clumped": "hydro/riemann"}  # fmt: skip
        for layout, where in layouts.items():
            case, *parameters = where.split()
            options = [word for one in parameters for word in ("-p", one)]
            path, sheet = self.particles(case, "-n", "8", *options, "--layout", layout)
            named = sheet["layout"] if isinstance(sheet["layout"], str) else sheet["layout"]["id"]
            self.assertIn(named, layout)

    def test_what_a_wall_prescribes_over_time_is_tabulated(self):
        _, sheet = self.particles("hydro/manufactured", "-n", "8")
        self.assertEqual((sheet["times"][0], sheet["times"][-1]), (0, sheet["final_time"]))
        moving = [wall for wall in sheet["walls"] if "over_time" in json.dumps(wall.get("place", 0))]
        self.assertTrue(moving)
        for wall in moving:
            self.assertEqual(len(wall["place"]["over_time"]), len(sheet["times"]))
        self.assertTrue(sheet["driven_by"])

    def test_bad_words_are_refused(self):
        for words, said in (
            (["hydro/none", "-n", "8"], "hydro/none"),
            (["hydro/riemann", "-n", "8", "-p", "gama=1"], "gama"),
            (["hydro/riemann", "-n", "8", "--layout", "hexagonal"], "two dimensions"),
            (["hydro/riemann", "-n", "8", "--layout", "latice"], "lattice"),
            (["hydro/riemann", "-n", "8", "--smoothing-ratio", "-1"], "--smoothing-ratio"),
            (["hydro/riemann", "-n", "8", "--format", "tipsy"], "tipsy"),
            (["hydro/riemann", "-n", "99999999"], "GB"),
        ):
            done = self.run_program("particles", *words, "-o", str(self.folder / "none.csv"))
            self.assertEqual(done.returncode, USER_ERROR, words)
            self.assertIn(said, done.stderr, words)
            self.assertFalse((self.folder / "none.csv").exists())


class Assess(Codes):
    def test_our_own_run_scores_what_it_scored(self):
        gas = {"id": "hydro/piston-velocity", "parameters": {"final_time": 0.2}}
        columns_of = {"temperature": "T", "density": "rho", "pressure": "P", "internal_energy": "e"}
        for case, formulation, mass in ((SLAB, "conduction/brookshaw", 1.0), (gas, "momentum/p-rho2", 1.0)):
            study = small_study(cases=[case], formulations=[formulation], resolution=[16, 32], measure=["error", "profile"],
                                discretisation=None)  # fmt: skip
            own = self.study(study, "own.json")
            entries = []
            for run in own["runs"]:
                profile, n = run["profile"], run["resolution"]
                columns = {"x": [x[0] for x in profile["position"]], "m": [mass / n] * n, "h": [run["smoothing_length"]] * n}
                columns |= {columns_of[name]: [value[0] for value in values]
                            for name, values in profile["computed"].items() if name in columns_of}  # fmt: skip
                if "velocity" in profile["computed"]:
                    columns["vx"] = [v[0] for v in profile["computed"]["velocity"]]
                write_csv(self.folder / f"own{n}.csv", columns, case["parameters"]["final_time"])
                entries.append({"file": f"own{n}.csv", "resolution": n, "seconds": 0.1 * n})
            document = self.assess(entries, case=case)
            for mine, theirs in zip(own["runs"], document["runs"]):
                self.assertEqual(theirs["formulation"], "external/my-code")
                self.assertEqual(theirs["discretisation"], mine["discretisation"])
                self.assertEqual(theirs.get("shocks"), mine.get("shocks"))
                for field in mine["errors"]:
                    self.assertEqual(set(theirs["errors"][field]), set(mine["errors"][field]))
                    for region, error in mine["errors"][field].items():
                        for key in ("l1", "l2", "linf", "scale", "initial", "mean", "allowed"):
                            there = theirs["errors"][field][region]
                            self.assertEqual(there.get(key), error.get(key), f"{field} {region} {key}")
            self.assertEqual([run["cost"]["seconds"] for run in document["runs"]], [1.6, 3.2])
        self.assertTrue(document["runs"][0]["shocks"])

    def test_errors_and_orders_are_those_that_were_put_in(self):
        entries = []
        for n in (16, 32, 64, 128):
            name = self.slab_snapshot(n, change=lambda x, T, n=n: T + 3.0 / n**2)
            entries.append({"file": name, "resolution": n, "seconds": 0.01 * n})
        document = self.assess(entries)
        for run in document["runs"]:
            error = run["errors"]["temperature"]["all"]
            for norm in ("l1", "l2", "linf"):
                self.assertAlmostEqual(error[norm], 3.0 / run["resolution"] ** 2, delta=1e-13)
            self.assertAlmostEqual(error["mean"], 3.0 / run["resolution"] ** 2, delta=1e-13)
        order = next(one for one in document["series"][0]["orders"] if one["norm"] == "l2" and one["region"] == "all")
        self.assertAlmostEqual(order["order"], 2.0, delta=1e-6)
        self.assertTrue(document["series"][0]["time_to_error"])
        gates = {"schema": "sphverify-gates/1", "gates": [
            {"name": "second order", "select": {"formulation": "external/my-code"}, "measure": "order",
             "field": "temperature", "norm": "l2", "region": "all", "minimum": 1.9}]}  # fmt: skip
        (self.folder / "gates.json").write_text(json.dumps(gates))
        self.succeed("gate", str(self.folder / "assessed.json"), str(self.folder / "gates.json"))
        self.assertIn("my-code", self.succeed("compare", str(self.folder / "assessed.json")))

    def test_few_digits_are_a_floor(self):
        entries = []
        for n in (16, 32, 64, 128):
            name = self.slab_snapshot(n, change=lambda x, T, n=n: float(f"{T:.5g}"))
            entries.append({"file": name, "resolution": n})
        document = self.assess(entries)
        self.assertIn("T has 5 digits", self.said)
        for run in document["runs"]:
            error = run["errors"]["temperature"]["all"]
            self.assertLess(error["linf"], error["round_off"])
            self.assertLess(error["round_off"], 1e-3)
        order = next(one for one in document["series"][0]["orders"] if one["norm"] == "l2" and one["region"] == "all")
        self.assertEqual(order["verdict"], "floored")

    def test_the_exact_solution_is_taken_at_the_snapshot_s_own_time(self):
        name = self.slab_snapshot(32, time=0.01005)
        run = self.assess([{"file": name, "resolution": 32}])["runs"][0]
        self.assertLess(run["errors"]["temperature"]["all"]["linf"], 1e-13)
        self.assertIn("compared at its own time", " ".join(run["remarks"]))
        self.refused([{"file": self.slab_snapshot(32, time=0.0102), "resolution": 32}], "time", "0.0102", "0.01")

    def test_periodic_places_are_wrapped_and_momentum_that_is_made_is_seen(self):
        """Gresho's vortex; a code that adds a wind and loses a little of its energy."""
        path, _ = self.particles("hydro/gresho", "-n", "16", "-p", "final_time=0.1")
        _, start = read_csv(path)
        end = {name: list(values) for name, values in start.items()}
        end["x"] = [x + 3.0 for x in end["x"]]  # three periods on
        end["vx"] = [v + 0.01 for v in end["vx"]]
        write_csv(self.folder / "end.csv", end, 0.1)
        document = self.assess(
            [{"file": "initial.csv", "resolution": 16}, {"file": "end.csv", "resolution": 16}],
            case={"id": "hydro/gresho", "parameters": {"final_time": 0.1}},
        )
        run = document["runs"][0]
        self.assertEqual(len(document["runs"]), 1)
        self.assertAlmostEqual(run["errors"]["velocity"]["all"]["linf"], 0.01, delta=1e-12)
        self.assertLess(run["errors"]["pressure"]["all"]["linf"], 1e-12)
        momentum, energy = run["conservation"]["momentum"], run["conservation"]["energy"]
        self.assertAlmostEqual(momentum["drift"][0], 0.01, delta=1e-12)
        self.assertAlmostEqual(momentum["drift"][1], 0.0, delta=1e-12)
        # sum m ((v + w)^2 - v^2)/2 = w sum m v + w^2/2, and the vortex has no momentum.
        self.assertAlmostEqual(energy["drift"], 0.5e-4, delta=1e-12)
        self.assertEqual(run["conservation"]["mass"]["drift"], 0.0)
        self.assertIn("256 particles wrapped", self.said)

    def test_what_crossed_walls_is_not_made_up(self):
        """Between walls that exchange heat a change of energy is not drift; between insulated ones it is."""
        for case, known in (("conduction/slab-dirichlet", False), ("conduction/slab-insulated", True)):
            scene = {"id": case, "parameters": {"final_time": 0.01}}
            x = [(i + 0.5) / 16 for i in range(16)]
            entries = []
            for k, t in enumerate((0.0, 0.01)):
                T = self.exact(case, t, [repr(one) for one in x])["temperature"]
                write_csv(self.folder / f"{k}.csv", {"x": x, "m": [1 / 16] * 16, "T": [v + 0.25 * k for v in T]}, t)
                entries.append({"file": f"{k}.csv", "resolution": 16})
            energy = self.assess(entries, case=scene)["runs"][0]["conservation"]["energy"]
            if known:
                self.assertAlmostEqual(energy["drift"], 0.25, delta=1e-12)
                self.assertEqual(energy["exchanged"], 0)
            else:
                self.assertIsNone(energy["drift"])
                self.assertIsNone(energy["exchanged"])

    def test_what_is_missing_is_derived_and_said(self):
        path, _ = self.particles("hydro/riemann", "-n", "64")
        _, start = read_csv(path)
        exact = self.exact("hydro/riemann", 0.2, [repr(x) for x in start["x"]])
        columns = {"x": start["x"], "vx": [v[0] for v in exact["velocity"]], "m": start["m"], "rho": exact["density"],
                   "P": exact["pressure"]}  # fmt: skip
        # Masses are those of the start; what is asked here is the derivation alone.
        write_csv(self.folder / "end.csv", columns, 0.2)
        run = self.assess([{"file": "end.csv", "resolution": 64}], case="hydro/riemann")["runs"][0]
        self.assertLess(run["errors"]["internal_energy"]["all"]["linf"], 1e-12)
        self.assertIn("e from P and rho by gamma", run["remarks"])
        columns["e"] = exact["internal_energy"]
        del columns["P"], columns["rho"]
        write_csv(self.folder / "end.csv", columns, 0.2)
        run = self.assess([{"file": "end.csv", "resolution": 64}], case="hydro/riemann")["runs"][0]
        self.assertNotIn("density", run["errors"])
        self.assertNotIn("pressure", run["errors"])
        run = self.assess([{"file": "end.csv", "resolution": 64}], case="hydro/riemann", density="summation")["runs"][0]
        self.assertIn("density", run["errors"])
        self.assertIn("rho summed with the cubic-spline kernel", run["remarks"])

    def test_names_axes_origin_and_lengths_are_translated(self):
        """A vortex in the x-z plane about (0.5, 0.5), with the kernel's support for h, under other names."""
        path, _ = self.particles("hydro/gresho", "-n", "32", "-p", "final_time=0.1")
        _, start = read_csv(path)
        columns = {"px": [x + 0.5 for x in start["x"]], "pz": [y + 0.5 for y in start["y"]], "u": start["vx"],
                   "w": start["vy"], "mass": start["m"], "hsml": [2 * h for h in start["h"]], "density": start["rho"],
                   "energy": start["e"], "junk": [7.0] * 1024}  # fmt: skip
        write_csv(self.folder / "end.csv", columns, 0.1)
        names = {"x": "px", "z": "pz", "vx": "u", "vz": "w", "mass": "mass", "smoothing_length": "hsml",
                 "density": "density", "internal_energy": "energy"}  # fmt: skip
        scene = {"id": "hydro/gresho", "parameters": {"final_time": 0.1}}
        options = {"case": scene, "map": names, "plane": ["x", "z"], "shift": [-0.5, -0.5], "smoothing_length": "support"}
        run = self.assess([{"file": "end.csv", "resolution": 32}], **options)["runs"][0]
        for field in ("velocity", "internal_energy", "density"):
            self.assertLess(run["errors"][field]["all"]["linf"], 1e-12, field)
        write_csv(self.folder / "plain.csv", start, 0.1)
        plain = self.assess([{"file": "plain.csv", "resolution": 32}], case=scene)["runs"][0]
        self.assertEqual(set(plain["errors"]["velocity"]), set(run["errors"]["velocity"]))

    def test_seeds_are_replicates(self):
        entries = []
        for n in (16, 32, 64):
            for seed in (1, 2, 3):
                name = self.slab_snapshot(n, change=lambda x, T, a=(1 + 0.1 * seed) / n: T + a, name=f"{n}-{seed}.csv")
                entries.append({"file": name, "resolution": n, "seed": seed})
        layout = {"id": "jittered", "amplitude": 0.1}
        document = self.assess(entries, discretisation={"layout": layout})
        self.assertEqual(len(document["runs"]), 9)
        self.assertEqual(len(document["series"]), 1)
        level = document["series"][0]["orders"][0]["levels"][0]
        self.assertEqual(level["replicates"], 3)
        self.refused(entries, "seed", "drawn by lot")

    def test_what_is_no_number_is_a_finding(self):
        name = self.slab_snapshot(16, change=lambda x, T: math.nan if 0.5 < x < 0.55 else T)
        document = self.assess([{"file": name, "resolution": 16}])
        self.assertEqual(document["runs"][0]["status"], "non-finite")
        self.assertIn("temperature", document["runs"][0]["reason"])

    def test_bad_snapshots_are_refused_in_one_line(self):
        entry = [{"file": "bad.csv", "resolution": 16}]
        good = (self.folder / self.slab_snapshot(16)).read_text().splitlines()

        def with_lines(lines):
            (self.folder / "bad.csv").write_text("\n".join(lines) + "\n")

        for lines, words in (
            ([good[0], good[1]] + [line.replace(".", ",") for line in good[2:]], ["bad.csv:3", "6 values", "3", "decimal point"]),
            ([good[0], good[1].replace(",", ";")] + good[2:], ["bad.csv:2", "';'", "commas"]),
            ([good[0], "x [m],m [kg],T [K]"] + good[2:], ["bad.csv:2", "without units"]),
            (good[:-1] + [good[-1][: good[-1].rindex(",")]], ["bad.csv:18", "2 values", "cut short"]),
            (good[:-1] + [good[-1][: good[-1].rindex(",") + 1]], ["bad.csv:18", "T: found ''", "a number"]),
            (good[:9], ["7 particles", "about 16"]),
            (good[:-1], ["a mass of 0.9375", "missing"]),
            (good[:-1] + [good[-1].replace("0.96875", "1.25")], ["particle 15 0.25 m outside of a wall"]),
            ([good[0], good[1] + ",x"] + [line + ",1" for line in good[2:]], ["'x' twice"]),
            (good[:2], ["no particles"]),
            ([], ["bad.csv"]),
            ([good[0], "a,b"] + ["1,2"], ["names a,b"]),
            (good[2:], ["bad.csv:1", "a line of names first"]),
            ([good[0], "x,m"] + [line[: line.rindex(",")] for line in good[2:]], ["no field that the case compares", "T"]),
            ([good[0], "x,T"] + [line[: line.index(",")] + ",1" for line in good[2:]], ["m: found nothing"]),
            (["# time = soon"] + good[1:], ["bad.csv:1:9: time", "soon"]),
            (good[1:], ["snapshots[0].time", "nothing"]),
        ):
            with_lines(lines)
            self.refused(entry, *words)
        with_lines(good)
        self.refused([{**entry[0], "time": 0.02}], "snapshots[0].time", "0.02", "0.01")
        self.refused(entry + entry, "a second snapshot of N = 16")
        self.refused([{"file": "nowhere.csv", "resolution": 16}], "nowhere.csv")
        self.refused(entry, "map", "no column 'Temp'", map={"temperature": "Temp"})
        self.refused(entry, "gamma", gamma=0.5)
        self.refused(entry, "operator/sine", case="operator/sine")
        self.refused(entry, "name", name="a b")
        self.refused([], "snapshots", "one or more")
        (self.folder / "bad.csv").write_bytes(b"\x00\x01\x02\x03" * 10)
        self.refused(entry, "binary")
        (self.folder / "bad.csv").write_bytes(b"PK\x03\x04" + b"\x00" * 10)
        self.refused(entry, "npz")
        with_lines(good + [good[-1].replace("0.96875", "1.25")])
        run = self.assess(entry, outside="drop")["runs"][0]
        self.assertEqual(run["particles"], 16)
        self.assertIn("1 particles outside", self.said)

    def test_walls_that_stand_for_themselves_are_dropped_to_the_last_layer(self):
        """Four layers of particles on either side, the first half a spacing outside: none of them is fluid."""
        scene = {"id": "hydro/acoustic", "parameters": {"final_time": 0.5}}
        for n in (50, 100, 200):
            x = [(i + 0.5) / n for i in range(-4, n + 4)]
            inside = [0 < one < 1 for one in x]
            exact = self.exact("hydro/acoustic", 0.5, [repr(min(max(one, 0.0), 1.0)) for one in x])
            columns = {"x": x, "vx": [v[0] for v in exact["velocity"]], "rho": exact["density"],
                       "m": [rho / n if fluid else 1 / n for rho, fluid in zip(exact["density"], inside)], "P": exact["pressure"]}  # fmt: skip
            write_csv(self.folder / "walls.csv", columns, 0.5)
            run = self.assess([{"file": "walls.csv", "resolution": n}], case=scene, outside="drop")["runs"][0]
            self.assertEqual(run["particles"], n)
            self.assertIn("8 particles outside of the walls left out", run["remarks"])
            self.assertLess(run["errors"]["density"]["all"]["linf"], 1e-14)
        self.refused([{"file": "walls.csv", "resolution": 200}], "outside of a wall", case=scene)

    def test_a_domain_that_depends_on_the_final_time_stays_that_of_the_case(self):
        scene = {"id": "hydro/riemann", "parameters": {"final_time": 0.5}}
        path, sheet = self.particles("hydro/riemann", "-n", "400", "-p", "final_time=0.5")
        _, start = read_csv(path)
        for time in (0.4975, 0.5, 0.5025):
            write_csv(self.folder / "end.csv", start, time)
            run = self.assess([{"file": "end.csv", "resolution": 400}], case=scene)["runs"][0]
            self.assertEqual(run["spacing"], sheet["spacing"])
            exact = self.exact("hydro/riemann", time, [repr(x) for x in start["x"]])
            wrong = [abs(a - b) for a, b in zip(exact["density"], start["rho"])]
            self.assertAlmostEqual(run["errors"]["density"]["all"]["linf"], max(wrong), delta=1e-12)
        # Beyond what a case has a solution for it is a line, whatever the case does there.
        scene = {"id": "hydro/simple-wave", "parameters": {"final_time": 0.999}}
        path, _ = self.particles("hydro/simple-wave", "-n", "16", "-p", "final_time=0.999")
        _, start = read_csv(path)
        write_csv(self.folder / "late.csv", start, 1.008)
        done = self.run_program("assess", self.snapshots([{"file": "late.csv", "resolution": 16}], case=scene))
        self.assertIn(done.returncode, (0, USER_ERROR), done.stderr)

    def test_walls_that_go_with_the_gas_are_where_its_particles_end(self):
        """A pressure drives the gas: the region `wall` is that of the scheme's own wall, but for a particle or two."""
        gas = {"id": "hydro/piston-pressure", "parameters": {"final_time": 0.2}}
        study = small_study(cases=[gas], formulations=["momentum/p-rho2"], resolution=[64], measure=["error", "profile"],
                            discretisation=None)  # fmt: skip
        (own,) = self.study(study, "own.json")["runs"]
        profile, computed = own["profile"], own["profile"]["computed"]
        columns = {"x": [x[0] for x in profile["position"]], "vx": [v[0] for v in computed["velocity"]], "m": [1 / 64] * 64,
                   "h": [own["smoothing_length"]] * 64, "rho": [v[0] for v in computed["density"]],
                   "e": [v[0] for v in computed["internal_energy"]], "P": [v[0] for v in computed["pressure"]]}  # fmt: skip
        write_csv(self.folder / "end.csv", columns, 0.2)
        run = self.assess([{"file": "end.csv", "resolution": 64}], case=gas, measure=["error", "profile"])["runs"][0]
        ours, theirs = set(profile["regions"]["wall"]), set(run["profile"]["regions"]["wall"])
        self.assertLessEqual(len(ours ^ theirs), 2, (sorted(ours), sorted(theirs)))

    def test_energy_at_walls_at_rest_is_drift_and_at_pistons_unknown(self):
        for case, known in (("hydro/acoustic", True), ("hydro/riemann", True), ("hydro/piston-velocity", False),
                            ("hydro/manufactured", False)):  # fmt: skip
            # So soon that walls have moved by less than a particle.
            path, sheet = self.particles(case, "-n", "32", "-p", "final_time=0.004")
            case = {"id": case, "parameters": {"final_time": 0.004}}
            _, start = read_csv(path)
            write_csv(self.folder / "end.csv", start | {"e": [1.5 * e for e in start["e"]]}, sheet["final_time"])
            entries = [{"file": "initial.csv", "resolution": 32}, {"file": "end.csv", "resolution": 32}]
            done = self.run_program("assess", self.snapshots(entries, case=case, outside="drop"))
            self.assertEqual(done.returncode, 0, done.stderr)
            conservation = strict_json(done.stdout)["runs"][0]["conservation"]
            gained = 0.5 * sum(m * e for m, e in zip(start["m"], start["e"]))
            if known:
                self.assertAlmostEqual(conservation["energy"]["drift"], gained, delta=1e-12 * gained, msg=case["id"])
                self.assertEqual(conservation["energy"]["exchanged"], 0)
            else:
                self.assertIsNone(conservation["energy"]["drift"], case["id"])
            self.assertIsNone(conservation["momentum"]["drift"][0], case["id"])

    def test_rounding_is_that_of_the_coarsest_component_and_of_what_a_field_comes_from(self):
        path, _ = self.particles("hydro/gresho", "-n", "16", "-p", "final_time=0.1")
        _, start = read_csv(path)
        scene = {"id": "hydro/gresho", "parameters": {"final_time": 0.1}}
        fine = self.assess([{"file": self.written("a.csv", start), "resolution": 16}], case=scene)["runs"][0]
        self.assertLess(fine["errors"]["velocity"]["all"]["round_off"], 1e-13)
        rough = start | {"vy": [float(f"{v:.4g}") for v in start["vy"]]}
        run = self.assess([{"file": self.written("b.csv", rough), "resolution": 16}], case=scene)["runs"][0]
        self.assertAlmostEqual(run["errors"]["velocity"]["all"]["round_off"], 5e-4 * max(map(abs, start["vy"])), delta=1e-5)
        lengths = {name: values for name, values in start.items() if name != "rho"}
        lengths["h"] = [float(f"{0.075 * (1 + 0.01 * math.sin(i)):.4g}") for i in range(256)]
        run = self.assess([{"file": self.written("c.csv", lengths), "resolution": 16}], case=scene, density={"eta": 1.2})["runs"][0]
        self.assertAlmostEqual(run["errors"]["density"]["all"]["round_off"], 2 * 5e-4, delta=1e-6)

    def written(self, name, columns):
        write_csv(self.folder / name, columns, 0.1)
        return name

    def test_what_was_computed_in_single_precision_has_its_noise(self):
        entries = []
        for n in (16, 32, 64, 128):
            name = self.slab_snapshot(n, change=lambda x, T: T * (1 + 8 * 2.0**-24 * math.sin(1e4 * x)))
            entries.append({"file": name, "resolution": n})
        verdicts = [
            next(one for one in self.assess(entries, precision=precision)["series"][0]["orders"]
                 if one["norm"] == "l2" and one["region"] == "all")["verdict"]
            for precision in ("single",)
        ]  # fmt: skip
        self.assertEqual(verdicts, ["floored"])

    def test_lost_particles_and_other_masses_are_refused_or_said(self):
        x = [(i + 0.5) / 100 for i in range(100)]
        T = self.exact("conduction/slab-dirichlet", 0.01, [repr(one) for one in x])["temperature"]
        for count, mass, resolution, words in (
            (94, 1.0, 100, "a mass of 0.94"), (100, 1.06, 100, "a mass of 1.06"), (100, 1.0, 10, "100 particles"),
        ):  # fmt: skip
            write_csv(self.folder / "lost.csv", {"x": x[:count], "m": [mass / 100] * count, "T": T[:count]}, 0.01)
            self.refused([{"file": "lost.csv", "resolution": resolution}], words)
        write_csv(self.folder / "lost.csv", {"x": x[:99], "m": [1 / 100] * 99, "T": T[:99]}, 0.01)
        remarks = self.assess([{"file": "lost.csv", "resolution": 100}])["runs"][0]["remarks"]
        self.assertIn("mass: 0.99 of what the case begins with", remarks)
        self.assertIn("particles: 99, where a lattice of N = 100 has 100", remarks)

    def test_what_is_derived_comes_from_what_is_nearest(self):
        path, _ = self.particles("hydro/gresho", "-n", "16", "-p", "final_time=0.1")
        _, start = read_csv(path)
        scene = {"id": "hydro/gresho", "parameters": {"final_time": 0.1}}
        columns = {name: start[name] for name in ("x", "y", "vx", "vy", "m", "h", "rho", "P")}
        columns["T"] = [300.0 * e for e in start["e"]]  # in other units
        run = self.assess([{"file": self.written("a.csv", columns), "resolution": 16}], case=scene)["runs"][0]
        self.assertLess(run["errors"]["internal_energy"]["all"]["linf"], 1e-12)
        columns = {name: start[name] for name in ("x", "y", "m", "h", "e")}
        run = self.assess([{"file": self.written("b.csv", columns), "resolution": 16}], case=scene, density="summation")["runs"][0]
        self.assertIn("not judged, for want of columns: vx", run["remarks"])
        # On a periodic lattice every sum is the same, here by a sum over the neighbours within 2h = 2.4 dx.
        h = 1.2

        def kernel(q):
            return 1 - 1.5 * q**2 + 0.75 * q**3 if q < 1 else 0.25 * (2 - q) ** 3 if q < 2 else 0.0

        sum_ = sum(kernel(math.hypot(i, j) / h) for i in range(-3, 4) for j in range(-3, 4)) * 10 / (7 * math.pi * h**2)
        self.assertAlmostEqual(run["errors"]["density"]["all"]["linf"], abs(sum_ - 1), delta=1e-12)
        wrong = max(abs(0.4 * sum_ * e - P) for e, P in zip(start["e"], start["P"]))
        self.assertAlmostEqual(run["errors"]["pressure"]["all"]["linf"], wrong, delta=1e-12)

    def test_the_setting_beside_which_a_code_is_shown_may_be_said(self):
        name = self.slab_snapshot(16)
        entry = [{"file": name, "resolution": 16}]
        run = self.assess(entry, discretisation={"density": "summation", "integrator": "runge-kutta", "kernel": "wendland-c2"})["runs"][0]
        self.assertEqual([run["discretisation"][key] for key in ("density", "integrator", "kernel")],
                         ["summation", "runge-kutta", "wendland-c2"])  # fmt: skip
        self.refused(entry, "discretisation.density", "a single value", discretisation={"density": ["given", "summation"]})
        for layout in ([], None, 5, {"id": 5}, "glass", ["lattice", "clumped"]):
            self.refused(entry, "snapshots.json", discretisation={"layout": layout})
        self.refused(entry, "measure", "every measure only once", measure=["error", "error"])

    def test_results_never_take_the_place_of_a_snapshot(self):
        name = self.slab_snapshot(16)
        before = (self.folder / name).read_text()
        path = self.snapshots([{"file": name, "resolution": 16}])
        self.assert_user_error(self.run_program("assess", path, "-o", name), "another file than the output")
        self.assertEqual((self.folder / name).read_text(), before)

    def test_quoted_cells_are_read_and_pipes_are_not(self):
        lines = (self.folder / self.slab_snapshot(16)).read_text().splitlines()
        quoted = [lines[0]] + [",".join(f'"{cell}"' for cell in line.split(",")) for line in lines[1:]]
        (self.folder / "quoted.csv").write_text("\r\n".join(quoted))
        run = self.assess([{"file": "quoted.csv", "resolution": 16}])["runs"][0]
        self.assertLess(run["errors"]["temperature"]["all"]["linf"], 1e-13)
        os.mkfifo(self.folder / "pipe.csv")
        for name in ("pipe.csv", "/dev/zero", str(self.folder)):
            self.refused([{"file": name, "resolution": 16}], "no file")

    def test_points_of_exact_come_from_a_file(self):
        write_csv(self.folder / "points.csv", {"x": [0.25, 0.5]})
        args = ("exact", "conduction/slab-dirichlet", "--time", "0.01")
        by_file = strict_json(self.succeed(*args, "--points-file", str(self.folder / "points.csv")))
        self.assertEqual(by_file, strict_json(self.succeed(*args, "--points", "0.25,0.5")))
        write_csv(self.folder / "points.csv", {"y": [0.25, 0.5]})
        done = self.run_program(*args, "--points-file", str(self.folder / "points.csv"))
        self.assertEqual(done.returncode, USER_ERROR)
        self.assertIn("points.csv: x", done.stderr)
        self.assertEqual(self.run_program(*args).returncode, USER_ERROR)


class External(Codes):
    def code(self, name, *command, **options):
        return {"id": f"external/{name}", "command": [*command], **options}

    def run_study(self, formulations, *arguments, **changes):
        changes = {"cases": [SLAB], "resolution": [8, 16, 32], "measure": ["error", "conservation", "cost"], "repeat": 1, **changes}
        study = small_study(formulations=formulations, **changes)
        self.assertEqual(complaints("sphverify-study-1", study), [])
        (self.folder / "study.json").write_text(json.dumps(study))
        done = self.run_program("study", self.folder / "study.json", "-o", self.folder / "results.json", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.said = done.stderr
        document = strict_json((self.folder / "results.json").read_text())
        self.assertEqual(complaints("sphverify-results-1", document), [])
        return document

    def setUp(self):
        super().setUp()
        (self.folder / "heat.py").write_text(HEAT)
        self.heat = self.code("fd", PYTHON, str(self.folder / "heat.py"), "{initial}", "{final}", "{case}", "{time}")

    def test_a_code_stands_beside_our_forms_with_the_order_that_it_has(self):
        document = self.run_study(["conduction/brookshaw", self.heat])
        codes = [run for run in document["runs"] if run["formulation"] == "external/fd"]
        self.assertEqual([run["status"] for run in codes], ["ok"] * 3)
        self.assertEqual([run["output"] for run in codes], [f"steps: {math.ceil(0.04 * n * n)}\n" for n in (8, 16, 32)])
        for run in codes:
            # Central differences in space, and Euler's method with dt = dx^2/4: the error falls as dx^2.
            self.assertLess(run["errors"]["temperature"]["all"]["l2"], 1.0 / run["resolution"] ** 2)
            self.assertGreater(run["cost"]["seconds"], 0)
            self.assertGreater(run["cost"]["cpu_seconds"], 0)
            self.assertGreater(run["cost"]["peak_bytes"], 1_000_000)
            self.assertIsNone(run["conservation"]["energy"]["drift"])
        series = next(one for one in document["series"] if one["formulation"] == "external/fd")
        order = next(one for one in series["orders"] if one["norm"] == "l2" and one["region"] == "all")
        self.assertAlmostEqual(order["pairwise"][-1], 2.0, delta=0.5)
        ours = next(run for run in document["runs"] if run["formulation"] != "external/fd")
        self.assertEqual(codes[0]["discretisation"], ours["discretisation"])
        self.assertIn("fd", self.succeed("compare", str(self.folder / "results.json")))

    def test_a_study_reads_back_and_a_run_is_repeated(self):
        document = self.run_study([self.heat])
        (self.folder / "again.json").write_text(json.dumps(document["study"]))
        self.succeed("study", str(self.folder / "again.json"), "-o", str(self.folder / "again-results.json"))
        again = strict_json((self.folder / "again-results.json").read_text())
        self.assertEqual([run["errors"] for run in again["runs"]], [run["errors"] for run in document["runs"]])
        done = self.run_program("repeat", self.folder / "results.json", "1", "-o", self.folder / "run.json")
        self.assertIn("now       ok", done.stderr)

    def test_placeholders_and_environment_say_what_they_name(self):
        script = (
            "import json,os,sys; json.dump({'argv': sys.argv[1:], 'omp': os.environ['OMP_NUM_THREADS'], 'cwd': os.getcwd(),"
            " 'there': sorted(os.listdir('.'))}, open(sys.argv[1] + '.json', 'w'))"
        )
        words = ["{initial}", "{final}", "{case}", "{time}", "n={resolution}", "{seed}", "{threads}", "{here}", "{x}y"]
        keep = self.folder / "kept"
        code = self.code("echo", PYTHON, "-c", script, *words, keep=str(keep), format="hdf5", initial="csv")
        document = self.run_study([code], resolution=[8], threads=2)
        self.assertEqual(document["runs"][0]["status"], "failed")
        self.assertIn("wrote no {final}", document["runs"][0]["reason"])
        (folder,) = keep.iterdir()
        said = json.loads((folder / "initial.csv.json").read_text())
        self.assertEqual(said["cwd"], str(folder))
        self.assertEqual(said["omp"], "2")
        self.assertEqual(said["argv"][:2], [str(folder / "initial.csv"), str(folder / "final.hdf5")])
        self.assertEqual(said["argv"][2:7], [str(folder / "initial.csv.case.json"), "0.01", "n=8", "0", "2"])
        self.assertEqual(said["argv"][7:], [str(self.folder), "{x}y"])

    def test_nothing_that_goes_wrong_ends_the_study(self):
        write = ("import sys; open(sys.argv[2], 'w').write('x,m,T\\n' + ''.join(f'{(i + .5) / 8},0.125,nan\\n' for i in range(8)))")
        codes = [
            self.code("missing", "./not-there", "{initial}", "{final}"),
            self.code("fails", PYTHON, "-c", "import sys; print('first'); print('no licence'); sys.exit(3)", "{initial}", "{final}"),
            self.code("killed", PYTHON, "-c", "import os; os.kill(os.getpid(), 11)", "{initial}", "{final}"),
            self.code("silent", "/bin/true", "{initial}", "{final}"),
            self.code("nan", PYTHON, "-c", write, "{initial}", "{final}"),
            self.code("garbage", PYTHON, "-c", "import sys; open(sys.argv[2], 'w').write('hello')", "{initial}", "{final}"),
            self.code("floods", "/bin/sh", "-c", "yes > flood", "{initial}", "{final}", disk_budget=0.01),
        ]
        document = self.run_study([*codes, self.heat], resolution=[8])
        by_name = {run["formulation"].split("/")[1]: run for run in document["runs"]}
        self.assertEqual({name: run["status"] for name, run in by_name.items()},
                         {"missing": "failed", "fails": "failed", "killed": "failed", "silent": "failed", "nan": "non-finite",
                          "garbage": "failed", "floods": "failed", "fd": "ok"})  # fmt: skip
        for name, words in {
            "missing": "cannot be started: No such file", "fails": "status 3; its last line: no licence", "killed": "signal 11",
            "silent": "wrote no {final}", "garbage": "{final}:1", "floods": "0.01 GB", "nan": "temperature of particle 0",
        }.items():  # fmt: skip
            self.assertIn(words, by_name[name]["reason"])
        self.assertEqual(by_name["fails"]["output"], "first\nno licence\n")

    def test_options_are_of_what_the_code_wrote_not_of_what_it_was_given(self):
        """A code whose origin is the slab's middle, and one whose plane is x-z."""
        script = ("import sys; lines = open(sys.argv[1]).read().splitlines(); head = lines[1 if lines[1][0] != '#' else 2].split(',');"
                  " rows = [l.split(',') for l in lines[lines.index(','.join(head)) + 1:]];"
                  " names = {'slab': {'x': 'x', 'm': 'm', 'T': 'T'}, 'vortex': {'x': 'x', 'y': 'z', 'vx': 'vx', 'vy': 'vz', 'm': 'm',"
                  " 'rho': 'rho', 'e': 'e'}}[sys.argv[3]]; out = open(sys.argv[2], 'w'); out.write(','.join(names.values()) + '\\n');"
                  " [out.write(','.join(str(float(r[head.index(n)]) - (0.5 if sys.argv[3] == 'slab' and n == 'x' else 0))"
                  " for n in names) + '\\n') for r in rows]")  # fmt: skip
        slab = self.code("moved", PYTHON, "-c", script, "{initial}", "{final}", "slab", shift=[0.5])
        document = self.run_study([slab], resolution=[8])
        self.assertEqual(document["runs"][0]["status"], "ok", document["runs"][0]["reason"])
        self.assertIn("no time in the file: taken for the final time", document["runs"][0]["remarks"])
        vortex = self.code("turned", PYTHON, "-c", script, "{initial}", "{final}", "vortex", plane=["x", "z"])
        document = self.run_study([vortex], resolution=[8], discretisation=None,
                                  cases=[{"id": "hydro/gresho", "parameters": {"final_time": 0.1}}])  # fmt: skip
        self.assertEqual(document["runs"][0]["status"], "ok", document["runs"][0]["reason"])
        self.assertLess(document["runs"][0]["errors"]["velocity"]["all"]["linf"], 1e-12)
        self.assertEqual(document["runs"][0]["conservation"]["energy"]["drift"], 0.0)

    def test_a_command_has_nothing_open_that_is_not_its_own(self):
        """Files of runs beside it would stay open, and locked, as long as it runs."""
        script = "import os, sys; print(sorted(set(os.listdir('/proc/self/fd')) - {'0', '1', '2', '3'}))"
        codes = [self.code(f"c{k}", PYTHON, "-c", script, "{initial}", "{final}", initial="hdf5") for k in range(4)]
        document = self.run_study(codes, resolution=[8, 16, 32], repeat=1)
        self.assertEqual({run["output"] for run in document["runs"]}, {"[]\n"})

    def test_what_is_not_known_of_a_code_is_null_and_no_gate_takes_it_for_small(self):
        document = self.run_study(["conduction/brookshaw", self.heat], resolution=[16])
        (run,) = [run for run in document["runs"] if run["formulation"] == "external/fd"]
        for key in ("steps", "rate_evaluations", "pair_interactions", "setup_seconds", "busy"):
            self.assertIsNone(run["cost"][key], key)
        self.assertFalse(run["cost"]["warm_up"])
        for quantity, passes in (("pair_interactions", False), ("steps", False), ("peak_bytes", True)):
            gates = {"schema": "sphverify-gates/1", "gates": [
                {"name": "cheap", "select": {"formulation": "external/fd"}, "measure": "cost", "quantity": quantity,
                 "relative_to": "conduction/brookshaw", "maximum": 1e9}]}  # fmt: skip
            done = self.run_program("gate", self.folder / "results.json", self.write("gates.json", gates))
            self.assertEqual(done.returncode, 0 if passes else 1, done.stdout)
        self.assertIn("fd", self.succeed("compare", self.folder / "results.json"))

    def test_what_a_command_makes_of_its_files_ends_its_run_alone(self):
        os.chmod(self.folder, 0o755)
        shell = {
            "accents": "python3 -c \"print('é' * 300 + 'b')\"; exit 1", "pipe": "mkfifo \"$2\"", "endless": "ln -s /dev/urandom \"$2\"",
            "loop": "ln -s \"$2\" \"$2\"", "folder": "mkdir \"$2\"", "output": "rm output.txt; mkfifo output.txt; exit 1",
        }  # fmt: skip
        codes = [self.code(name, "/bin/sh", "-c", text, "sh", "{initial}", "{final}") for name, text in shell.items()]
        codes.append(self.code("nowhere", "/bin/true", "{initial}", "{final}", keep="/proc/nowhere"))
        document = self.run_study([*codes, self.heat], resolution=[8], time_budget=20)
        self.assertEqual([run["status"] for run in document["runs"]], ["failed"] * 7 + ["ok"])
        self.assertIn("failed: 1 of 8 runs: external/pipe: the command wrote no {final}", self.said)
        self.assertIn("particles cannot be written", document["runs"][6]["reason"])

    def test_a_status_is_known_whoever_started_the_harness(self):
        """Daemons and some runners let the system forget children at once."""
        code = self.code("fails", "/bin/sh", "-c", "exit 3", "{initial}", "{final}")
        study = small_study(cases=[SLAB], formulations=[code], resolution=[8], measure=["error"])
        process = self.start("study", self.write("study.json", study), "-o", "results.json",
                             preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN))  # fmt: skip
        process.communicate(timeout=60)
        (run,) = strict_json((self.folder / "results.json").read_text())["runs"]
        self.assertIn("status 3", run["reason"])

    def test_what_gives_up_its_group_and_its_environment_is_ended_too(self):
        mark = f"sleep 96{os.getpid() % 1000:03d}"
        code = self.code("hides", "/bin/sh", "-c", f"setsid env -i {mark} & sleep 0.3; exit 0", "{initial}", "{final}")
        self.run_study([code], resolution=[8])
        self.assertNotIn(mark, subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True, check=True).stdout)

    def test_children_of_a_shell_that_became_the_harness_are_left_alone(self):
        code = self.code("ends", "/bin/true", "{initial}", "{final}")
        study = self.write("study.json", small_study(cases=[SLAB], formulations=[code], resolution=[8], measure=["error"]))
        mark = f"93{os.getpid() % 1000:03d}"
        words = f"sleep {mark} & exec '{PROGRAM}' study '{study}' -o '{self.folder}/results.json'"
        subprocess.run(["/bin/sh", "-c", words], check=True, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        listed = subprocess.run(["pgrep", "-f", f"^sleep {mark}"], capture_output=True, text=True, check=False).stdout.split()
        self.assertEqual(len(listed), 1)
        os.kill(int(listed[0]), signal.SIGKILL)

    def test_a_terminal_that_goes_takes_the_codes_with_it(self):
        mark = f"sleep 95{os.getpid() % 1000:03d}"
        code = self.code("waits", "/bin/sh", "-c", f"touch {self.folder}/there; {mark}", "{initial}", "{final}")
        study = small_study(cases=[SLAB], formulations=[code], resolution=[8], measure=["error"])
        process = self.start("study", self.write("study.json", study), "-o", "results.json")
        for _ in range(400):
            if (self.folder / "there").exists():
                break
            time.sleep(0.02)
        process.send_signal(signal.SIGHUP)
        process.communicate(timeout=30)
        self.assertNotIn(mark, subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True, check=True).stdout)

    def test_nothing_is_left_running(self):
        """A command that hangs, with a child in a session of its own, and one that ends and leaves such a child."""
        mark = f"sleep 98{os.getpid() % 1000:03d}"
        codes = [
            self.code("hangs", "/bin/sh", "-c", f"(setsid {mark} &); {mark}", "{initial}", "{final}"),
            self.code("leaves", "/bin/sh", "-c", f"setsid {mark} & sleep 0.3; exit 0", "{initial}", "{final}"),
        ]
        start = time.monotonic()
        document = self.run_study(codes, resolution=[8], time_budget=1)
        self.assertEqual([run["status"] for run in document["runs"]], ["failed", "failed"])
        self.assertIn("time budget of 1 s", document["runs"][0]["reason"])
        self.assertLess(time.monotonic() - start, 60)
        listed = subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True, check=True).stdout
        self.assertNotIn(mark, listed)

    def test_what_a_run_leaves_is_ended_while_others_go_on(self):
        mark = f"sleep 94{os.getpid() % 1000:03d}"
        codes = [
            self.code("leaves", "/bin/sh", "-c", f"setsid {mark} & sleep 0.3; exit 0", "{initial}", "{final}"),
            self.code("looks", "/bin/sh", "-c", f"sleep 2; ps -eo args | grep -c '[s]{mark[1:]}'; exit 1", "{initial}", "{final}"),
        ]
        document = self.run_study(codes, "--jobs", "2", resolution=[8])
        self.assertEqual(document["runs"][1]["output"], "0\n")

    def test_an_interrupted_study_ends_its_codes_and_resumes(self):
        mark = f"sleep 97{os.getpid() % 1000:03d}"
        slow = self.code("slow", "/bin/sh", "-c", f"test -e {self.folder}/go && exit 1; {mark}", "{initial}", "{final}")
        study = small_study(cases=[SLAB], formulations=[self.heat, slow], resolution=[8], repeat=1, measure=["error"])
        (self.folder / "study.json").write_text(json.dumps(study))
        arguments = [PROGRAM, "study", str(self.folder / "study.json"), "-o", str(self.folder / "results.json"), "--jobs", "1"]
        running = self.start(*arguments[1:])
        journal = self.folder / "results.json.journal"
        for _ in range(600):
            if journal.exists() and len(journal.read_text().splitlines()) > 1:
                break
            time.sleep(0.05)
        running.terminate()
        running.communicate(timeout=30)
        self.assertEqual(running.returncode, PROGRAM_ERROR)
        self.assertNotIn(mark, subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True, check=True).stdout)
        (self.folder / "go").write_text("")
        (self.folder / "heat.py").write_text("raise SystemExit('carried out again')")
        self.succeed(*arguments[1:], "--resume")
        document = strict_json((self.folder / "results.json").read_text())
        self.assertEqual([run["status"] for run in document["runs"]], ["ok", "failed"])

    def test_codes_take_part_in_layouts_and_ratios_only(self):
        document = self.run_study(
            ["conduction/brookshaw", self.heat], resolution=[8],
            discretisation={"density": ["given", "summation"], "smoothing_ratio": [1.2, 1.5], "face_weight": ["exact", "campbell"]},
        )  # fmt: skip
        self.assertEqual(len([run for run in document["runs"] if run["formulation"] == "external/fd"]), 2)
        document = self.run_study([self.heat], cases=[SLAB, "operator/sine"], resolution=[8])
        self.assertEqual(len(document["runs"]), 1)
        self.assertIn("operator", document["skipped"][0]["case"])

    def test_measures_that_no_code_has_are_refused_where_there_is_nothing_else(self):
        for measure in ("stability", "stable-step", "spectrum", "second-law"):
            study = small_study(cases=[SLAB], formulations=[self.heat], resolution=[8], measure=["error", measure])
            done = self.run_program("study", self.write("study.json", study), "-o", "none.json")
            self.assert_user_error(done, "measure[1]", measure, "another code")
        self.run_study(["conduction/brookshaw", self.heat], resolution=[8], measure=["error", "stability"])
        (run,) = self.run_study([self.heat], resolution=[8], measure=["error", "history"])["runs"]
        self.assertEqual(run["history"]["time"], [0, 0.01])

    def test_bad_codes_are_refused(self):
        for formulation, words in (
            ("external/fd", ["command"]),
            ({"id": "external/fd"}, ["command"]),
            (self.code("a b", "x", "{initial}", "{final}"), ["external/NAME"]),
            (self.code("fd", "x"), ["{initial} and {final}"]),
            (self.code("fd", "x", "{initial}", "{finale}"), ["{finale}", "{final}"]),
            ({"id": "external/fd", "command": "x {initial} {final}"}, ["a list of words"]),
            (self.code("fd", "x", "{initial}", "{final}", walls="off"), ["walls"]),
            (self.code("fd", "x", "{initial}", "{final}", format="vtk"), ["vtk"]),
            (self.code("fd", "x", "{initial}", "{final}", disk_budget=-1), ["disk_budget"]),
        ):
            study = small_study(cases=[SLAB], formulations=[formulation])
            (self.folder / "study.json").write_text(json.dumps(study))
            self.assert_user_error(self.run_program("study", self.folder / "study.json", "-o", self.folder / "none.json"), *words)


if __name__ == "__main__":
    unittest.main()
