# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study is refused for as too large, against the memory that runs are seen to take."""

import resource
import subprocess
import sys
import unittest

import program

# A process's peak includes what it held before it became the program, so that a small process starts it.
MEASURED = """
import os, resource, sys
status = os.spawnv(os.P_WAIT, sys.argv[1], sys.argv[1:])
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
sys.exit(status)
"""
LIMIT = 500_000_000  # bytes of address space
LAYOUT = {"id": "jittered", "amplitude": 0.1, "seed": 1}
INSTANT = 5e-5  # so short that lists have hardly a skin


def gas(dimension, boundary):
    return {"id": "hydro/uniform", "parameters": {"dimension": dimension, "boundary": boundary, "final_time": INSTANT}}


def sine(dimension):
    return {"id": "operator/sine", "parameters": {"dimension": dimension}}


# name, case, formulation, integrator, dimension, resolution, h/dx
RUNS = (
    ("rates in 3D", sine(3), "conduction/brookshaw", None, 3, 48, 1.2),
    ("rates in 2D", sine(2), "conduction/brookshaw", None, 2, 300, 1.2),
    ("conduction in 3D", {"id": "conduction/cube", "parameters": {"final_time": 1e-5}}, "conduction/brookshaw", None, 3, 40, 1.2),
    ("conduction in 2D", {"id": "conduction/square", "parameters": {"final_time": 1e-5}}, "conduction/brookshaw", None, 2, 200, 1.2),
    ("least squares in 3D", {"id": "conduction/cube", "parameters": {"final_time": 1e-5}}, "conduction/gmls", None, 3, 40, 1.2),
    ("least squares in 2D", {"id": "conduction/square", "parameters": {"final_time": 1e-5}}, "conduction/gmls", None, 2, 200, 1.2),
    ("Runge-Kutta in 3D, no walls", gas(3, "periodic"), "momentum/sqrt-p", "runge-kutta", 3, 32, 1.2),
    ("Runge-Kutta in 3D", gas(3, "velocity"), "momentum/sqrt-p", "runge-kutta", 3, 32, 1.2),
    ("Runge-Kutta in 2D", gas(2, "velocity"), "momentum/sqrt-p", "runge-kutta", 2, 200, 1.2),
    ("leapfrog in 3D, no walls", gas(3, "periodic"), "momentum/sqrt-p", "leapfrog", 3, 28, 1.2),
    ("Runge-Kutta in 3D, wide", gas(3, "velocity"), "momentum/sqrt-p", "runge-kutta", 3, 20, 2.0),
    ("leapfrog in 2D", gas(2, "velocity"), "momentum/sqrt-p", "leapfrog", 2, 120, 1.2),
)


class MemoryTest(program.ProgramTest):
    def peak(self, study):
        """The largest memory of the whole process. [bytes]"""
        arguments = ["study", self.write("study.json", study), "-o", self.folder / "r.json"]
        result = subprocess.run(
            [sys.executable, "-S", "-c", MEASURED, program.PROGRAM, *arguments], capture_output=True, text=True)  # fmt: skip
        self.assertEqual(result.returncode, program.DONE, result.stderr)
        (run,) = program.strict_json((self.folder / "r.json").read_text())["runs"]
        self.assertEqual(run["status"], "ok", run["reason"])
        return 1024 * int(result.stdout)

    def limited(self, *arguments):
        """The program with less memory than what is refused takes."""
        return subprocess.run(
            [program.PROGRAM, *arguments], capture_output=True, text=True, timeout=60, cwd=self.folder,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (LIMIT, LIMIT)))  # fmt: skip

    def estimated_bytes_per_particle(self, study, dimension, resolution):
        """From refusals of two larger ones: a part in proportion to the volume and one to the walls' area."""

        def refused(too_large):
            result = self.limited("study", self.write("study.json", {**study, "resolution": [too_large]}))
            self.assert_user_error(result, f"resolution: found {too_large}", "GB, expected")
            return 1e9 * float(result.stderr.split("takes about ")[1].split(" GB")[0]) / too_large**dimension

        inside = refused(100_000)
        middle = 100 if dimension == 3 else 1500
        return inside + (refused(middle) - inside) * middle / resolution

    def test_the_estimate_is_near_what_runs_take(self):
        self.succeed("list")
        if self.limited("list").returncode != program.DONE:
            self.skipTest("a sanitizer takes memory of its own")
        study = {"schema": "sphverify-study/1", "name": "memory", "measure": ["error", "cost"]}
        empty = self.peak({**study, "cases": [sine(1)], "formulations": ["conduction/brookshaw"], "resolution": [10]})
        for name, case, formulation, integrator, dimension, resolution, ratio in RUNS:
            with self.subTest(name):
                discretisation = {"layout": LAYOUT, "smoothing_ratio": ratio, **({"integrator": integrator} if integrator else {})}
                one = {**study, "cases": [case], "formulations": [formulation], "discretisation": discretisation}
                taken = (self.peak({**one, "resolution": [resolution]}) - empty) / resolution**dimension
                estimated = self.estimated_bytes_per_particle(one, dimension, resolution)
                print(f"{name}: {taken:.0f} bytes a particle, estimated {estimated:.0f}, ratio {taken / estimated:.2f}")
                self.assertLess(taken, 1.3 * estimated)
                self.assertGreater(taken, 0.7 * estimated)


if __name__ == "__main__":
    unittest.main()
