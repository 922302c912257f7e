# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures: which study, which series. A new one is a table of series and a function with @figure(STUDY) above it."""

import dataclasses
import math
import typing

from . import plots, results, style
from .plots import Series


@dataclasses.dataclass
class Figure:
    studies: tuple  # in cases/studies
    draw: typing.Callable  # takes their results documents


FIGURES = {}


def figure(*studies):
    """Lists a function under its name, heat_walls_1d as heat-walls-1d."""

    def add(draw):
        FIGURES[draw.__name__.replace("_", "-")] = Figure(studies, draw)
        return draw

    return add


WALLS = [
    Series("wall terms", walls="on", pair_weight="kernel"),
    Series("mirror particles", walls="mirror", pair_weight="kernel"),
    Series("dummy particles", walls="dummy", pair_weight="kernel"),
]
VORONOI = Series("Voronoi weights", walls="on", pair_weight="voronoi")


def form(name, look, formulation, walls="on", pair_weight="kernel"):
    return Series(name, look, formulation=f"conduction/{formulation}", walls=walls, pair_weight=pair_weight)


BROOKSHAW, BY_CELLS = form("Brookshaw", 0, "brookshaw"), form("Brookshaw, Voronoi", 5, "brookshaw", pair_weight="voronoi")
LEAST_SQUARES = form("least squares", 4, "gmls")
CORRECTED = form("corrected gradients", 3, "corrected-flux")
OVER_GAMMA = form("over Gamma", 2, "gamma-brookshaw")
LUCY = form("Lucy", 1, "lucy-flux")
AT_WALLS = [BROOKSHAW, form("Brookshaw, mirror", 1, "brookshaw", "mirror"), OVER_GAMMA, CORRECTED, LEAST_SQUARES, BY_CELLS]


def beside_each_other(document, table, scenes):
    """Error against N, a panel for each scene."""
    drawn, axes = style.panels(len(scenes), sharey=True)
    for panel, (title, where) in zip(axes, scenes.items()):
        plots.against_resolution(panel, document, table, where, label="")
        panel.set_title(title)
    axes[0].set_ylabel("l2 error, relative")
    style.legend(drawn, columns=3)
    return drawn


@figure("heat-1d")
def heat_1d(document):
    case = {"case": "conduction/slab-dirichlet"}
    return beside_each_other(document, AT_WALLS, {"lattice": {**case, "layout": "lattice"},
                                                  "displaced by up to 0.3 dx": {**case, "layout": "jitter 0.3"}})


@figure("heat-2d")
def heat_2d(document):
    where = {"case": "conduction/square", "layout": "jitter 0.3, masses voronoi"}
    return beside_each_other(document, AT_WALLS, {"all sides of given temperature": {**where, "case_walls": "dirichlet"},
                                                  "two sides insulated": {**where, "case_walls": "mixed"}})


@figure("heat-1d")
def heat_by_wall(document):
    forms = [Series(name, formulation=f"conduction/{name}")
             for name in ("brookshaw", "gamma-brookshaw", "gmls", "corrected-flux", "lucy-flux", "campbell-flux")]
    treatments = [*WALLS, VORONOI]
    where = {"layout": "jitter 0.3", "resolution": 200}
    return plots.dots(document, forms, treatments, {"temperature given": {**where, "case": "conduction/slab-dirichlet"},
                                                    "insulated": {**where, "case": "conduction/slab-insulated"}})


@figure("heat-1d")
def energy(document):
    table = [BROOKSHAW, OVER_GAMMA, CORRECTED, LEAST_SQUARES, LUCY, BY_CELLS]
    case = {"case": "conduction/slab-insulated"}
    return plots.energy_made(document, table, {"displaced by up to 0.1 dx": {**case, "layout": "jitter 0.1"},
                                               "displaced by up to 0.3 dx": {**case, "layout": "jitter 0.3"}})


@figure("heat-time-3d")
def time_3d(document):
    def at(series, look, ratio):
        return Series(f"{series.name}, h/dx = {ratio:g}", look, smoothing_ratio=ratio, **series.traits)

    table = [at(BROOKSHAW, 0, 1.2), at(BROOKSHAW, 1, 2.0), at(LEAST_SQUARES, 4, 1.2), BY_CELLS]
    return plots.error_against_time(document, table, {"cube, displaced by up to 0.3 dx": {}})


@figure("heat-jumps-1d")
def jumps(document):
    table = [BROOKSHAW, form("harmonic mean", 1, "cleary-monaghan"), LEAST_SQUARES, BY_CELLS,
             form("harmonic, Voronoi", 2, "cleary-monaghan", pair_weight="voronoi")]
    where = {"case": "extreme/conductivity-contrast", "resolution": 200, "closure": "one-sided"}
    return plots.error_against_parameter(document, table, {"lattice": {**where, "layout": "lattice"},
                                                           "displaced by up to 0.3 dx": {**where, "layout": "jitter 0.3"}},
                                         "contrast", "ratio of the conductivities")


KERNELS = [Series(kernel, kernel=kernel, label="conduction/brookshaw", case="conduction/slab-dirichlet")
           for kernel in ("cubic-spline", "quintic-spline", "wendland-c2", "wendland-c4", "wendland-c6")]


@figure("heat-kernels-1d")
def kernels(document):
    drawn, axes = style.panels(2, sharey=True)
    for panel, layout in zip(axes, ("lattice", "jitter 0.3")):
        plots.curves(panel, document, KERNELS, {"layout": layout, "resolution": 200}, along="smoothing_ratio")
        panel.set(yscale="log", xlabel="h/dx", title=f"{layout}, N = 200")
        style.plain_numbers(panel.xaxis, [1.0, 1.2, 1.5, 1.8, 2.3])
        style.plain_numbers(panel.yaxis)
    axes[0].set_ylabel("l2 error, relative")
    style.legend(drawn, columns=3)
    return drawn


CLOSURES = [Series(f"{form}, {closure}", formulation=f"momentum/{form}", closure=closure)
            for form in ("p-rho2", "sqrt-p") for closure in ("interpolated", "one-sided")]


@figure("piston-closures-1d")
def pistons(document):
    drawn, axes = style.panels(2, sharey=True)
    where = {"case": "hydro/piston-pressure", "density": "normalised"}
    smoothings = {"one h for all, h/dx = 1.2": {"smoothing": "uniform", "smoothing_ratio": 1.2},
                  "each particle its own h, h/dx = 1": {"smoothing": "adaptive", "smoothing_ratio": 1.0}}
    for panel, (title, smoothing) in zip(axes, smoothings.items()):
        plots.against_resolution(panel, document, CLOSURES, {**where, **smoothing}, y=results.behind_shock(), label="")
        panel.set_title(title)
    axes[0].set_ylabel("error of the pressure\nbehind the shock, relative")
    style.legend(drawn, columns=3)
    return drawn


@figure("gas-at-rest-1d")
def gas_at_rest(document):
    drawn, axes = style.panels(2, sharey=True)
    # Nothing stands behind a periodic axis, so one curve serves both panels.
    table = [*WALLS, Series("periodic, no walls", walls="on", boundary="periodic")]
    for panel, (title, boundary) in zip(axes, {"walls of given pressure": "pressure",
                                               "walls at rest": "velocity"}.items()):
        walls = [Series(s.name, **{"boundary": boundary, **s.traits}) for s in table]
        plots.against_resolution(panel, document, walls, {}, y=results.error("velocity", relative=False), label="")
        panel.set_title(title)
    axes[0].set_ylabel("velocity, l2 [m/s]")
    style.legend(drawn)
    return drawn


STABLE = [BROOKSHAW, OVER_GAMMA, CORRECTED, LEAST_SQUARES, LUCY, form("Campbell", 5, "campbell-flux")]


@figure("heat-stability-1d")
def spectrum(document):
    drawn, axes = style.panels(2, sharey=True)
    layouts = [f"jitter {amplitude}" for amplitude in (0.1, 0.3, 0.45)]
    for panel, ratio in zip(axes, (1.2, 2.0)):
        for index, series in enumerate(STABLE):
            look = {**style.look(series.look), "linestyle": "none"}
            numbers = [max(filter(None, map(results.growth, series.runs(document, {"case": "conduction/slab-dirichlet",
                           "layout": layout, "smoothing_ratio": ratio}))), default=math.nan) for layout in layouts]  # fmt: skip
            (line,) = panel.plot([at + 0.12 * (index - 2.5) for at in range(3)], numbers, label=series.name, **look)
            line.set_gid(f"series-{index}")
        plots.signed_decades(panel.yaxis, -11, -3)
        panel.axhline(0, color=style.INK, linewidth=0.8)
        panel.set(xlabel="displaced by up to", title=f"h/dx = {ratio:g}", xlim=(-0.5, 2.5))
        panel.set_xticks(range(3), ["0.1 dx", "0.3 dx", "0.45 dx"])
    axes[0].annotate("grows", (-0.45, 0), textcoords="offset points", xytext=(0, 5), fontsize=9)
    axes[0].annotate("decays", (-0.45, 0), textcoords="offset points", xytext=(0, -12), fontsize=9)
    axes[0].set_ylabel("fastest growth [K/(rho dx^2)]")
    style.legend(drawn, columns=3)
    return drawn


def gas(name, look, formulation, smoothing="adaptive"):
    weight = "voronoi" if formulation == "voronoi" else "kernel"
    return Series(name, look, formulation=f"momentum/{formulation}", smoothing=smoothing, pair_weight=weight)


GAS = [gas("P/rho^2, one h", 0, "p-rho2", "uniform"), gas("P/rho^2", 1, "p-rho2"),
       gas("pressure-energy", 2, "pressure-energy"), gas("grad-h terms", 3, "p-rho2-grad-h"),
       gas("corrected gradients", 4, "rkgc"), gas("faces of cells", 5, "voronoi")]


KERNEL_GAS = GAS[:-1]  # in Noh's problem cells have no wall to end at beyond 1D; in 3D they were not driven


def gas_against_time(scenes, field, **where):
    """A panel for each scene, {title: (its documents, its forms)}: error against processor time."""
    drawn, axes = style.panels(len(scenes))
    for panel, (title, (documents, table)) in zip(axes, scenes.items()):
        runs = {"runs": [run for document in documents for run in document["runs"]]}
        plots.curves(panel, runs, table, {"closure": "one-sided", **where}, y=results.error(field, "l1"),
                     x=results.processor_seconds)
        panel.set(xscale="log", yscale="log", xlabel="processor time [s]", title=title)
        style.plain_numbers(panel.xaxis, style.decades(panel.get_xlim()))
        style.plain_numbers(panel.yaxis)
    axes[0].set_ylabel("l1 error, relative")
    style.legend(drawn, columns=3)
    return drawn


@figure("gas-time-1d", "gas-time-2d", "gas-time-3d", "voronoi-gas-1d", "voronoi-gas-2d")
def gas_time(in_1d, in_2d, in_3d, cells_1d, cells_2d):
    return gas_against_time({"1D": ([in_1d, cells_1d], GAS), "2D": ([in_2d, cells_2d], GAS), "3D": ([in_3d], KERNEL_GAS)},
                            "velocity", case="hydro/piston-velocity")


@figure("gas-time-1d", "gas-time-2d", "voronoi-gas-1d")
def gas_time_noh(in_1d, in_2d, cells_1d):
    return gas_against_time({"1D": ([in_1d, cells_1d], GAS), "2D": ([in_2d], KERNEL_GAS)}, "density", case="hydro/noh")
