#!/usr/bin/python3
# SPDX-License-Identifier: 0BSD
"""Runs a case of sphverify in PySPH: python3 run_case.py INITIAL.hdf5 FINAL.hdf5 CASE.json [--scheme gsph|mpm|adke]

INITIAL is in PySPH's own format (`sphverify particles --format pysph`), CASE the sheet beside it, which says domain, walls
and final time. A gas is left to one of PySPH's schemes; heat to Brookshaw's equation below, since PySPH has none.
"""

import argparse
import json
import tempfile

import numpy
from pysph.base.kernels import CubicSpline
from pysph.base.nnps import DomainManager
from pysph.base.utils import get_particle_array
from pysph.solver.application import Application
from pysph.solver.solver import Solver
from pysph.solver.utils import dump, load
from pysph.sph.equation import Equation, Group
from pysph.sph.integrator import PECIntegrator
from pysph.sph.integrator_step import IntegratorStep
from pysph.sph.scheme import ADKEScheme, GasDScheme, GSPHScheme

LAYERS = 4  # of particles that stand for a wall


class BrookshawConduction(Equation):
    """rho dT/dt = sum_j 2 K (m_j / rho_j) (T_i - T_j) (x_ij . grad_i W_ij) / r_ij^2"""

    def __init__(self, dest, sources, conductivity):
        self.conductivity = conductivity
        super().__init__(dest, sources)

    def initialize(self, d_idx, d_aT):
        d_aT[d_idx] = 0.0

    def loop(self, d_idx, s_idx, d_aT, d_T, s_T, d_rho, s_rho, s_m, XIJ, R2IJ, DWIJ):
        if R2IJ > 0.0:
            along = (XIJ[0] * DWIJ[0] + XIJ[1] * DWIJ[1] + XIJ[2] * DWIJ[2]) / R2IJ
            d_aT[d_idx] += 2.0 * self.conductivity * s_m[s_idx] / (d_rho[d_idx] * s_rho[s_idx]) * (
                d_T[d_idx] - s_T[s_idx]) * along


class HeatStep(IntegratorStep):
    """Second order: the midpoint, then the whole step."""

    def initialize(self, d_idx, d_T, d_T0):
        d_T0[d_idx] = d_T[d_idx]

    def stage1(self, d_idx, d_T, d_T0, d_aT, dt):
        d_T[d_idx] = d_T0[d_idx] + 0.5 * dt * d_aT[d_idx]

    def stage2(self, d_idx, d_T, d_T0, d_aT, dt):
        d_T[d_idx] = d_T0[d_idx] + dt * d_aT[d_idx]


class Case(Application):
    def __init__(self, sheet, particles, scheme_name, folder):
        self.sheet, self.start, self.scheme_name = sheet, particles, scheme_name
        self.dimension = sheet["dimension"]
        self.h_over_dx = sheet["smoothing_length"] / sheet["spacing"]
        super().__init__(fname="case", output_dir=folder)

    def steps_of(self, longest):
        """Step and end, a whole number of steps."""
        end = self.sheet["final_time"]
        return end / numpy.ceil(end / longest), end

    def create_domain(self):
        domain = self.sheet["domain"]
        sides = {}
        for name, lower, upper, periodic in zip("xyz", domain["lower"], domain["upper"], domain["periodic"]):
            sides[f"{name}min"], sides[f"{name}max"] = lower, upper
            sides[f"periodic_in_{name}"] = periodic
            if self.sheet["gamma"]:
                sides[f"mirror_in_{name}"] = not periodic
        if self.sheet["gamma"] is None and not any(domain["periodic"]):
            return None  # walls of heat are particles
        return DomainManager(**sides)


class Gas(Case):
    def create_particles(self):
        fluid = self.start
        fluid.add_property("h0", data=fluid.h)
        self.scheme.setup_properties([fluid])
        return [fluid]

    def create_scheme(self):
        gamma, ratio = self.sheet["gamma"], self.h_over_dx
        common = {"fluids": ["fluid"], "solids": [], "dim": self.dimension, "gamma": gamma, "has_ghosts": True}
        c = numpy.sqrt(gamma * (gamma - 1) * self.start.e.max()) + numpy.abs(self.start.u).max()
        dt, end = self.steps_of(0.2 * self.sheet["spacing"] / c)
        if self.scheme_name == "gsph":
            scheme = GSPHScheme(kernel_factor=ratio, g1=0.2, g2=0.4, rsolver=2, interpolation=1, monotonicity=1,
                                interface_zero=True, niter=20, tol=1e-6, **common)
        elif self.scheme_name == "mpm":
            scheme = GasDScheme(kernel_factor=ratio, alpha1=1.0, alpha2=0.1, beta=2.0, update_alpha1=True,
                                update_alpha2=True, **common)
        else:
            scheme = ADKEScheme(alpha=1.0, beta=1.0, k=ratio, eps=0.5, g1=0.2, g2=0.4, **common)
        scheme.configure_solver(dt=dt, tf=end, adaptive_timestep=False, pfreq=10**9)
        return scheme


class Heat(Case):
    def create_particles(self):
        fluid = self.start
        for name in ("aT", "T0"):
            fluid.add_property(name)
        order = numpy.argsort(fluid.x)
        self.walls = []  # (particles behind a wall, those in front that they mirror, its temperature)
        x, m, rho, h = [], [], [], []
        for wall in self.sheet["walls"]:
            place, outward = wall["point"][0], wall["outward_normal"][0]
            front = order[:LAYERS] if outward < 0 else order[-LAYERS:]
            behind = numpy.arange(len(x), len(x) + LAYERS)
            self.walls.append((behind, front, wall["prescribes"]["temperature"]))
            x += list(2 * place - fluid.x[front])
            m += list(fluid.m[front])
            rho += list(fluid.rho[front])
            h += list(fluid.h[front])
        self.solid = get_particle_array(name="solid", x=x, m=m, rho=rho, h=h)
        for name in ("T", "aT", "T0"):
            self.solid.add_property(name)
        self.mirror()
        return [fluid, self.solid]

    def mirror(self):
        for behind, front, temperature in self.walls:
            self.solid.T[behind] = 2 * temperature - self.start.T[front]

    def post_stage(self, current_time, dt, stage):
        self.mirror()

    def create_equations(self):
        conductivity = self.start.K[0]
        return [Group([BrookshawConduction("fluid", ["fluid", "solid"], conductivity)])]

    def create_solver(self):
        dx = self.sheet["spacing"]
        dt, end = self.steps_of(0.2 * dx * dx * self.start.rho.min() / self.start.K.max())
        return Solver(kernel=CubicSpline(dim=self.dimension), dim=self.dimension, integrator=PECIntegrator(fluid=HeatStep()),
                      dt=dt, tf=end, pfreq=10**9)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("initial", "final", "case"):
        parser.add_argument(name)
    parser.add_argument("--scheme", choices=["gsph", "mpm", "adke"], default="gsph")
    options = parser.parse_args()
    with open(options.case) as file:
        sheet = json.load(file)
    fluid = load(options.initial)["arrays"]["fluid"]
    with tempfile.TemporaryDirectory() as folder:
        app = (Gas if sheet["gamma"] else Heat)(sheet, fluid, options.scheme, folder)
        app.run(["--directory", folder, "--no-adaptive-timestep"])
    fluid = next(one for one in app.particles if one.name == "fluid")
    # Gas-dynamics arrays do not name their temperature, and heat's no velocities, among what is written.
    fluid.set_output_arrays([name for name in ("x", "y", "z", "u", "v", "w", "m", "h", "rho", "p", "e", "T", "tag")
                             if name in fluid.properties])
    dump(options.final, [fluid], {"t": app.solver.t, "dt": app.solver.dt, "count": app.solver.count})


if __name__ == "__main__":
    main()
