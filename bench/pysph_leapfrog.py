#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Our leapfrog beside PySPH's: the same gas, particles, kernel and step, one thread each, in turn in one run.

    bench/pysph_leapfrog.py [--particles 48] [--repeats 3] [--sphverify PROGRAM] [--json FILE]

The gas is hydro/uniform in a periodic cube: N^3 particles of a lattice displaced at random (seed 1), of density and pressure
1, gamma 1.4, at rest at first; the disorder moves it. Cubic spline, one h = 1.2 dx for all, density by continuity,
P/rho^2 with its work partner, Monaghan's alpha = 1 and beta = 2. `sphverify particles` writes the particles and both begin
with them; the final time is some hundred steps of --step h/c, within our own limits, so that what ends our steps is that a run
has at least a hundred. PySPH takes as many of the same length. Debian's python3-pysph is wanted.

PySPH's equations are its ContinuityEquation and IdealGasEOS, and its Monaghan92Accelerations with our share of the pressure's
work (P_j/rho_j^2 in place of the mean of both), so that both compute one right-hand side; its LeapFrogIntegrator and
LeapFrogStep evaluate it once a step. All pairs are visited in one loop. --check runs 12^3 particles in both and says how far the
final states are apart, with PySPH's step as ours and at a half and a quarter of it: that halves with the step, since PySPH's
LeapFrogStep is of first order (it takes density, energy and velocity half a step late) and ours of second.

What is compared is time per particle and step:
- ours: the record's `cost`, the set-up of the scene and the budgets of each step included;
- PySPH's: its steps and the evaluation that begins them, without reading, set-up and compilation. A short run before compiles,
  with the flags of the Python that it belongs to, PySPH's default (with -O3 -march=native in CFLAGS it was no faster).

What differs: PySPH keeps images of particles behind the sides, made anew twice a step (one layer of 2h, all that is needed;
its default is two), and searches neighbours at each step, by the linked list that is its default; ours keeps a list with a
margin, which is made anew the less often the slower the gas is (a larger --amplitude makes it faster). Ours may sweep the pairs
a second time for what is linear in the velocity of the drift, work and continuity alone ("drifts"). Pairs a particle: of PySPH
those nearer than 2h at the end, of ours those that a sweep visits, the list's margin included.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

try:
    import numpy
    from compyle.config import get_config
    from cyarray.api import UIntArray
    from pysph.base.kernels import CubicSpline
    from pysph.base.nnps import DomainManager, LinkedListNNPS
    from pysph.base.utils import get_particle_array
    from pysph.solver.solver import Solver
    from pysph.sph.basic_equations import ContinuityEquation
    from pysph.sph.equation import Equation, Group
    from pysph.sph.gas_dynamics.basic import IdealGasEOS
    from pysph.sph.integrator import LeapFrogIntegrator
    from pysph.sph.integrator_step import LeapFrogStep
except ImportError as missing:
    sys.exit(f"pysph_leapfrog: {missing} (Debian: apt-get install python3-pysph, and run it with /usr/bin/python3)")

ROOT = pathlib.Path(__file__).resolve().parent.parent
GAMMA, RATIO = 1.4, 1.2
STEPS = 100  # at least, of any run of ours
WARM_UP_SIDE, WARM_UP_STEPS = 12, 5


def stop(reason):
    sys.exit(f"pysph_leapfrog: {reason}")


def program_of(option):
    """Where sphverify is."""
    if option:
        found = [pathlib.Path(option)]
    else:
        found = [ROOT / "build" / name / "sphverify" for name in ("release", "bench")]
    for one in found:
        if one.is_file():
            return one.resolve()
    stop(f"no program at {' or '.join(str(one) for one in found)}: build it, or name it by --sphverify")


class Forces(Equation):
    """Monaghan92Accelerations, but for the pressure's work: m_j P_j/rho_j^2 v_ij . grad_i W_ij."""

    def __init__(self, dest, sources, alpha, beta):
        self.alpha = alpha
        self.beta = beta
        super().__init__(dest, sources)

    def initialize(self, d_idx, d_au, d_av, d_aw, d_ae):
        d_au[d_idx] = 0.0
        d_av[d_idx] = 0.0
        d_aw[d_idx] = 0.0
        d_ae[d_idx] = 0.0

    def loop(self, d_idx, s_idx, d_rho, s_rho, d_p, s_p, d_cs, s_cs, d_au, d_av, d_aw, d_ae, s_m, VIJ, DWIJ, XIJ, EPS,
             HIJ, R2IJ, RHOIJ1):
        tmpi = d_p[d_idx] / (d_rho[d_idx] * d_rho[d_idx])
        tmpj = s_p[s_idx] / (s_rho[s_idx] * s_rho[s_idx])
        vijdotxij = VIJ[0] * XIJ[0] + VIJ[1] * XIJ[1] + VIJ[2] * XIJ[2]
        piij = 0.0
        if vijdotxij < 0:
            muij = HIJ * vijdotxij / (R2IJ + EPS)
            cij = 0.5 * (d_cs[d_idx] + s_cs[s_idx])
            piij = (-self.alpha * cij * muij + self.beta * muij * muij) * RHOIJ1
        force = -s_m[s_idx] * (tmpi + tmpj + piij)
        d_au[d_idx] += force * DWIJ[0]
        d_av[d_idx] += force * DWIJ[1]
        d_aw[d_idx] += force * DWIJ[2]
        vijdotdwij = VIJ[0] * DWIJ[0] + VIJ[1] * DWIJ[1] + VIJ[2] * DWIJ[2]
        d_ae[d_idx] += s_m[s_idx] * (tmpj + 0.5 * piij) * vijdotdwij


def run(program, *words):
    try:
        done = subprocess.run([str(program), *map(str, words)], capture_output=True, text=True)
    except OSError as reason:
        stop(f"{program} does not start: {reason.strerror}")
    if done.returncode:
        said = done.stderr.strip().splitlines() or ["nothing said"]
        stop(f"{program} {words[0]} ended with {done.returncode}: {said[-1]}")


class Gas:
    """The particles of one resolution, and both ways to run them."""

    def __init__(self, program, side, options, folder):
        self.program, self.side = program, side
        self.folder = pathlib.Path(folder)
        self.layout = {"id": "jittered", "amplitude": options.amplitude, "seed": 1}
        self.count = side**3
        self.h = RATIO / side
        self.final_time = STEPS * options.step * self.h / GAMMA**0.5  # c of pressure and density 1
        self.parameters = {"dimension": 3, "boundary": "periodic", "gamma": GAMMA, "final_time": self.final_time}
        self.particles = self.initial_particles()

    def initial_particles(self):
        file = self.folder / f"{self.side}.csv"
        words = [word for name, value in self.parameters.items() for word in ("-p", f"{name}={value}")]
        run(self.program, "particles", "hydro/uniform", *words, "-n", self.side, "--layout", json.dumps(self.layout),
            "--smoothing-ratio", RATIO, "-o", file)
        with open(file) as lines:
            names = next(line for line in lines if not line.startswith("#")).strip().split(",")
            values = numpy.loadtxt(lines, delimiter=",", unpack=True)
        return dict(zip(names, values))

    def ours(self, *measures):
        """The record of one run of ours."""
        study, results = self.folder / "study.json", self.folder / "results.json"
        study.write_text(json.dumps({
            "schema": "sphverify-study/1", "name": "leapfrog",
            "cases": [{"id": "hydro/uniform", "parameters": self.parameters}],
            "formulations": ["momentum/p-rho2"],
            "discretisation": {"kernel": "cubic-spline", "smoothing_ratio": RATIO, "layout": self.layout, "density": "continuity",
                               "smoothing": "uniform", "integrator": "leapfrog", "viscosity": {"alpha": 1, "beta": 2}},
            "resolution": self.side, "measure": ["cost", *measures], "threads": 1, "repeat": 1, "time_budget": 100000}))
        run(self.program, "study", study, "--jobs", 1, "-o", results)
        record = json.loads(results.read_text())["runs"][0]
        if record["status"] != "ok":
            stop(f"our run ended: {record['status']}, {record['reason']}")
        if set(record["motion"]["steps_bound_by"]) != {"duration"}:
            stop(f"our steps are bound by {', '.join(record['motion']['steps_bound_by'])}: take a smaller --step")
        return record

    def theirs(self, steps, dt):
        """PySPH's particles and neighbours after so many steps, their wall and processor time, and the latter of images alone."""
        start = self.particles
        fluid = get_particle_array(
            name="fluid", x=start["x"], y=start["y"], z=start["z"], m=start["m"], rho=start["rho"], h=start["h"], p=start["P"])
        for name in ("au", "av", "aw", "ax", "ay", "az", "arho", "ae", "cs"):
            fluid.add_property(name)
        fluid.add_property("e", data=start["e"])
        sides = {f"{axis}{end}": value for axis in "xyz" for end, value in (("min", 0.0), ("max", 1.0))}
        periodic = {f"periodic_in_{axis}": True for axis in "xyz"}
        kernel = CubicSpline(dim=3)
        equations = [Group([IdealGasEOS("fluid", None, gamma=GAMMA)], real=False),
                     Group([ContinuityEquation("fluid", ["fluid"]), Forces("fluid", ["fluid"], 1.0, 2.0)])]
        integrator = LeapFrogIntegrator(fluid=LeapFrogStep())
        # The domain is the neighbours' too: it makes the particles' images.
        nnps = LinkedListNNPS(dim=3, particles=[fluid], radius_scale=kernel.radius_scale, fixed_h=True,
                               domain=DomainManager(n_layers=1.0, **sides, **periodic))
        solver = Solver(kernel=kernel, dim=3, integrator=integrator, dt=dt, tf=steps * dt, adaptive_timestep=False)
        solver.set_disable_output(True)
        solver.set_parallel_manager(None)
        solver.setup([fluid], equations, nnps, kernel=kernel, fixed_h=True)  # compiles, where it has not before
        images, update_domain = 0.0, integrator.update_domain

        def timed_update():
            nonlocal images
            since = time.process_time()
            update_domain()
            images += time.process_time() - since

        integrator.update_domain = timed_update
        began = time.perf_counter(), time.process_time()
        integrator.initial_acceleration(0.0, dt)
        for step in range(steps):
            integrator.step(step * dt, dt)
        ended = time.perf_counter(), time.process_time()
        return fluid, nnps, ended[0] - began[0], ended[1] - began[1], images

    def neighbours_of_theirs(self, nnps):
        """Mean number of others nearer than 2h, of every so manieth particle."""
        nnps.update()  # its last images are newer than its cells
        near, total = UIntArray(), 0
        looked_at = range(0, self.count, max(1, self.count // 5000))
        for i in looked_at:
            nnps.get_nearest_particles(0, 0, i, near)
            total += near.length - 1
        return total / len(looked_at)


def pairs_of_ours(record):
    """Directed pairs a particle and sweep, of the list that the sweeps run over."""
    sums = sum(count for name, count in record["scene"]["pass_counts"].items()
               if name in ("viscosity", "density/continuity") or name.startswith(("momentum/", "work/")))
    return record["cost"]["pair_interactions"] / sums / record["particles"]


def check(program, options, folder):
    """Prints how far both are apart at the end of a run of one length, for ever shorter steps."""
    print("final states apart, as a part of how far the gas has come from the initial one (root mean squares):")
    gas = Gas(program, WARM_UP_SIDE, options, folder)
    record = gas.ours("profile")
    profile = record["profile"]
    ours = numpy.array(profile["position"])
    for part in (1.0, 0.5, 0.25):
        shorter = round(record["cost"]["steps"] / part)
        fluid, *_ = gas.theirs(shorter, gas.final_time / shorter)
        theirs = numpy.column_stack([fluid.x, fluid.y, fluid.z])[: gas.count]
        apart = numpy.abs((ours[:, None, :] - theirs[None, :, :] + 0.5) % 1.0 - 0.5).max(axis=2)
        partner = apart.argmin(axis=1)  # ours may be in another order
        if len(set(partner)) != gas.count:
            stop("the final states are too far apart to tell who is who")
        rms = lambda values: float(numpy.sqrt(numpy.mean(numpy.square(values))))
        found = {}
        for name, mine, other, rest in (
                ("velocity", profile["computed"]["velocity"],
                 numpy.column_stack([fluid.u, fluid.v, fluid.w])[: gas.count], 0.0),
                ("density", profile["computed"]["density"], fluid.rho[: gas.count, None], 1.0),
                ("internal energy", profile["computed"]["internal_energy"], fluid.e[: gas.count, None], 1 / (GAMMA - 1))):
            mine = numpy.array(mine)
            found[name] = rms(mine - other[partner]) / rms(mine - rest)
        print(f"  PySPH's step {part:4g} of ours: " + ", ".join(f"{name} {value:.2e}" for name, value in found.items()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-n", "--particles", type=int, default=48, metavar="N", help="N^3 particles [48]")
    parser.add_argument("--repeats", type=int, default=3, help="runs of each, in turn [3]")
    parser.add_argument("--step", type=float, default=0.15, help="in h/c, at least a hundred of which are taken [0.15]")
    parser.add_argument("--amplitude", type=float, default=0.1, help="of the displacements, in dx [0.1]")
    parser.add_argument("--sphverify", metavar="PROGRAM", help="[build/release/sphverify]")
    parser.add_argument("--json", metavar="FILE", help="the numbers, too; - for standard output in place of the table")
    parser.add_argument("--check", action="store_true", help="compare what both compute, on 12^3 particles, and end")
    options = parser.parse_args()
    if options.particles < 6:
        stop("fewer than 6^3 particles see their own images")
    if options.repeats < 1 or not options.step > 0:
        stop("--repeats and --step are positive")
    program = program_of(options.sphverify)
    get_config().use_openmp = False
    with tempfile.TemporaryDirectory() as folder:
        if options.check:
            check(program, options, folder)
            return
        warm_up = Gas(program, WARM_UP_SIDE, options, folder)
        warm_up.theirs(WARM_UP_STEPS, warm_up.final_time / STEPS)
        gas = Gas(program, options.particles, options, folder)
        times = {"ours": {"wall": [], "processor": []}, "pysph": {"wall": [], "processor": []}}
        of_images = []
        for _ in range(options.repeats):
            record = gas.ours()
            cost = record["cost"]
            steps = cost["steps"]
            fluid, nnps, wall, processor, images = gas.theirs(steps, gas.final_time / steps)
            if not numpy.isfinite(fluid.u).all():
                stop("PySPH's gas is not finite at the end: take a smaller --step")
            for who, taken in (("ours", (cost["seconds"], cost["cpu_seconds"])), ("pysph", (wall, processor))):
                for clock, seconds in zip(("wall", "processor"), taken):
                    times[who][clock].append(1e9 * seconds / (gas.count * steps))
            of_images.append(1e9 * images / (gas.count * steps))
        passes = record["scene"]["pass_counts"]
        forces = {"ours": passes["momentum/p-rho2"], "pysph": steps + 1}
        searches = {"ours": passes["neighbour-search"], "pysph": steps + 1}
        drifts = {"ours": passes["density/continuity"] - passes["momentum/p-rho2"], "pysph": 0}
        pairs = {"ours": pairs_of_ours(record), "pysph": gas.neighbours_of_theirs(nnps)}
    result = {"particles": gas.count, "steps": steps, "step": gas.final_time / steps, "smoothing_length": gas.h, "threads": 1}
    for who in times:
        result[who] = {"pairs_per_particle": pairs[who],
                       "forces_per_step": forces[who] / steps,
                       "drift_sweeps_per_step": drifts[who] / steps,
                       "neighbour_searches_per_step": searches[who] / steps,
                       "ns_per_particle_and_step": {
                           clock: {"minimum": min(taken), "median": statistics.median(taken), "all": taken}
                           for clock, taken in times[who].items()}}
    result["ours"]["setup_seconds"] = cost["setup_seconds"]
    images = result["pysph"]["images_ns_per_particle_and_step"] = statistics.median(of_images)
    result["ratio"] = {clock: {which: result["pysph"]["ns_per_particle_and_step"][clock][which]
                               / result["ours"]["ns_per_particle_and_step"][clock][which] for which in ("minimum", "median")}
                       for clock in ("wall", "processor")}
    median = lambda who: result[who]["ns_per_particle_and_step"]["processor"]["median"]
    result["ratio_without_images"] = (median("pysph") - images) / median("ours")
    if options.json:
        text = json.dumps(result, indent=1) + "\n"
        if options.json == "-":
            sys.stdout.write(text)
            return
        pathlib.Path(options.json).write_text(text)
    print(f"{gas.count} particles, {steps} steps of {result['step']:.4g} ({options.step:g} h/c at most), one thread each, "
          f"{options.repeats} runs in turn")
    print(f"{'ns per particle and step, wall':>32}{'processor':>24}{'a step':>30}{'a particle':>12}")
    print(f"{'':8}{'minimum':>12}{'median':>12}{'minimum':>12}{'median':>12}{'forces':>10}{'drifts':>10}"
          f"{'searches':>10}{'pairs':>12}")
    for who in times:
        one = result[who]
        ns = [one["ns_per_particle_and_step"][clock][which] for clock in ("wall", "processor") for which in ("minimum", "median")]
        print(f"{who:8}" + "".join(f"{value:12.0f}" for value in ns) + f"{one['forces_per_step']:10.2f}"
              f"{one['drift_sweeps_per_step']:10.2f}{one['neighbour_searches_per_step']:10.2f}{one['pairs_per_particle']:12.1f}")
    ratio = result["ratio"]
    print("PySPH/ours: " + "; ".join(f"{clock} time, {one['minimum']:.2f} of minima, {one['median']:.2f} of medians"
                                     for clock, one in ratio.items()))
    print(f"without the processor time for images at the sides, {images:.0f} ns: {result['ratio_without_images']:.2f} of medians")


if __name__ == "__main__":
    main()
