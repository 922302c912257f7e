"""The figures: which study, which series. A new one is a table of series and a function with @figure(STUDY) above it."""

import dataclasses
import typing

from . import plots, results, style
from .plots import Series


@dataclasses.dataclass
class Figure:
    study: str  # in cases/studies
    draw: typing.Callable  # takes its results document


FIGURES = {}


def figure(study):
    """Lists a function under its name, heat_walls_1d as heat-walls-1d."""

    def add(draw):
        FIGURES[draw.__name__.replace("_", "-")] = Figure(study, draw)
        return draw

    return add


WALLS = [
    Series("wall terms", walls="on", pair_weight="kernel"),
    Series("mirror particles", walls="mirror", pair_weight="kernel"),
    Series("dummy particles", walls="dummy", pair_weight="kernel"),
]
VORONOI = Series("Voronoi weights", walls="on", pair_weight="voronoi")


@figure("weights-and-walls-1d")
def heat_walls_1d(document):
    drawn, (panel,) = style.panels()
    where = {"case": "conduction/slab-dirichlet", "layout": "jitter 0.3"}
    plots.against_resolution(panel, document, [*WALLS, VORONOI], where)
    plots.slope(panel, -2, (100, 200), 6e-6)
    style.legend(drawn)
    return drawn


@figure("weights-and-walls-2d")
def heat_walls_2d(document):
    drawn, (panel,) = style.panels()
    where = {"case": "conduction/square", "case_walls": "dirichlet", "layout": "jitter 0.3, masses voronoi"}
    plots.against_resolution(panel, document, [*WALLS, VORONOI], where)
    style.legend(drawn)
    return drawn


KERNELS = [Series(kernel, kernel=kernel)
           for kernel in ("cubic-spline", "quintic-spline", "wendland-c2", "wendland-c4", "wendland-c6")]


@figure("kernels-1d")
def kernels(document):
    drawn, axes = style.panels(2, sharey=True)
    for panel, layout in zip(axes, ("lattice", "jitter 0.1")):
        plots.curves(panel, document, KERNELS, {"layout": layout, "resolution": 200}, along="smoothing_ratio")
        panel.set(yscale="log", xlabel="h/dx", title=f"{layout}, N = 200")
        style.plain_numbers(panel.xaxis, [1.2, 1.5, 1.8, 2.3])
        style.plain_numbers(panel.yaxis)
    axes[0].set_ylabel("l2 error, relative")
    style.legend(drawn, columns=3)
    return drawn


CLOSURES = [Series(f"{form}, {closure}", formulation=f"momentum/{form}", closure=closure)
            for form in ("p-rho2", "sqrt-p") for closure in ("interpolated", "one-sided")]


@figure("pistons-1d")
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


FORMS = [Series(form, formulation=f"conduction/{form}") for form in ("brookshaw", "lucy-flux", "campbell-flux")]


@figure("stability-1d")
def spectrum(document):
    drawn, axes = style.panels(2, sharey=True)
    for panel, layout in zip(axes, ("jitter 0.1", "jitter 0.3")):
        where = {"case": "conduction/slab-dirichlet", "layout": layout}
        plots.curves(panel, document, FORMS, where, along="smoothing_ratio", y=results.growth, middle=max)
        plots.signed_decades(panel.yaxis, -11, -3)
        panel.axhline(0, color=style.INK, linewidth=0.8)
        panel.annotate("grows", (1.0, 0), textcoords="offset points", xytext=(0, 5), fontsize=9)
        panel.annotate("decays", (1.0, 0), textcoords="offset points", xytext=(0, -12), fontsize=9)
        panel.set(xlabel="h/dx", title=layout)
        style.plain_numbers(panel.xaxis, [1.0, 1.2, 1.5, 2.0])
    axes[0].set_ylabel("fastest growth [K/(rho dx^2)]")
    style.legend(drawn)
    return drawn
