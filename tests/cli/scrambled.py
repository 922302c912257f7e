# SPDX-License-Identifier: GPL-3.0-or-later
"""Results documents in which every number is another, so that one which stands in the wrong place shows: small
studies that fill every column, and numbers that depend on nothing but what they are of."""

import hashlib
import json

from program import small_study
from reductions import parameters_text, runs_of

LAYOUTS = ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2]}]
SLAB = {"id": "conduction/slab-dirichlet", "parameters": {"final_time": 0.01}}
HEAT = small_study(
    name="heat",
    cases=[SLAB, {"id": "conduction/slab-insulated", "parameters": {"final_time": 0.01}}, "operator/sine"],
    formulations=["conduction/brookshaw", "conduction/campbell-flux", {"id": "conduction/brookshaw", "walls": "off"},
                  "momentum/p-rho2", "momentum/sqrt-p"],
    discretisation={"layout": LAYOUTS, "density": ["given", "summation"]},
    resolution=[10, 14],
    measure=["error", "conservation", "cost", "stability", "second-law"],
    repeat=1,
)  # fmt: skip
GAS = small_study(
    name="gas",
    cases=[{"id": id, "parameters": {"final_time": 0.05}} for id in ("hydro/piston-velocity", "coupled/hot-wall")],
    formulations=["momentum/p-rho2", {"id": "momentum/p-rho2", "work": "work/total-energy"}, "momentum/sqrt-p",
                  {"id": "momentum/sqrt-p", "conduction": "conduction/brookshaw"}],
    discretisation={"density": "continuity", "layout": LAYOUTS},
    resolution=[10, 14],
    measure=["error", "conservation", "cost", "energy-routes"],
    repeat=1,
)  # fmt: skip
GRID = small_study(
    name="grid",
    formulations=["conduction/brookshaw", "conduction/campbell-flux"],
    discretisation={"smoothing_ratio": [0.95, 1.1, 1.3, 1.7]},
    resolution=[8, 12, 16],
    measure=["error", "cost"],
    repeat=1,
)
DRIVEN = small_study(
    name="driven",
    cases=["conduction/slab-dirichlet"],
    formulations=["conduction/brookshaw", "conduction/campbell-flux"],
    discretisation={"layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seed": 3}]},
    envelope={"parameter": "smoothing_ratio", "from": 1.2, "to": 0.5, "bisections": 2},
    resolution=20,
    measure="error",
)


class Draw:
    """Numbers that depend on nothing but what they are of."""

    def __init__(self, seed):
        self.seed = seed

    def part(self, *key):
        """From 0 to 1."""
        text = f"{self.seed} {key}"
        return int.from_bytes(hashlib.blake2b(text.encode(), digest_size=7).digest(), "big") / 2**56

    def size(self, *key, low=1e-3, high=1.0):
        return low * (high / low) ** self.part(*key)

    def signed(self, *key, **ends):
        return self.size(*key, **ends) * (-1 if self.part("sign", *key) < 0.5 else 1)

    def count(self, *key, most=10**6):
        return int(most * self.part(*key))

    def one_of(self, values, *key):
        return values[self.count("choice", *key, most=len(values))]

    def increasing(self, count, *key, **ends):
        return sorted(self.size(n, *key, **ends) for n in range(count))

    def norms(self, *key, **ends):
        return dict(zip(("l1", "l2", "linf"), self.increasing(3, *key, **ends)))

    def times(self, *key):
        low, median, high = self.increasing(3, *key, low=1e-4)
        return {"median_seconds": median, "low_seconds": low, "high_seconds": high}

    def estimate(self, *key, **ends):
        low, value, high = self.increasing(3, *key, **ends)
        return {"value": value, "interval": [low, high]}


CHOICES = {
    "kernel": ("cubic-spline", "quintic-spline", "wendland-c2"),
    "pair_weight": ("kernel", "voronoi"),
    "density": ("given", "summation", "continuity", "normalised", "voronoi"),
    "face_weight": ("campbell", "exact", "balanced"),
    "closure": ("interpolated", "one-sided"),
    "integrator": ("bdf", "runge-kutta", "leapfrog"),
    "smoothing": ("uniform", "adaptive"),
    "wall_motion": ("velocity", "mass"),
    "viscosity": ("off", {"alpha": 1.5, "beta": 3.0}, {"alpha": 1.0, "beta": 2.5}),
    "smoothing_ratio": (1.2, 1.5, 2.25),
}


def scrambled(document, seed=1, settings=False):
    """The document with another number wherever there is one; signs where they mean something. With other settings,
    too, its ladders differ in every choice."""
    draw = Draw(seed)
    changed = json.loads(json.dumps(document))
    for index, run in enumerate(changed["runs"]):
        scramble_run(run, index, draw)
    for index, series in enumerate(changed["series"]):
        scramble_series(series, index, draw)
        if settings:
            choices = {key: draw.one_of(values, index, key) for key, values in CHOICES.items()}
            exponent = draw.one_of((0.0, 0.25, 0.5), index, "exponent")
            for entry in [series, *runs_of(changed, series)]:
                entry["discretisation"] |= choices
                entry["smoothing_exponent"] = exponent
    for index, surface in enumerate(changed.get("surfaces", [])):
        scramble_surface(surface, index, draw)
        if settings:
            keys = [key for key in CHOICES if key != "smoothing_ratio"]
            surface["discretisation"] |= {key: draw.one_of(CHOICES[key], "surface", index, key) for key in keys}
    for index, envelope in enumerate(changed.get("envelopes", [])):
        scramble_envelope(envelope, index, draw)
    return changed


def scramble_run(run, index, draw):
    run |= {"particles": draw.count(index, "particles"), "spacing": draw.size(index, "spacing")}
    run["smoothing_length"] = draw.size(index, "smoothing length")
    for field, regions in run["errors"].items():
        for region, error in regions.items():
            here = (index, field, region)
            error |= draw.norms(*here, "error") | {"round_off": draw.size(*here, "round-off", low=1e-11, high=1e-9)}
            # Replicates have one exact solution.
            scene = (run["case"], parameters_text(run["parameters"]), field, region, run["resolution"])
            error["scale"] = draw.norms(*scene, "scale", low=1.0, high=10.0)
            if "initial" in error:
                error["initial"] = draw.norms(*here, "initial")
            if error.get("mean") is not None:
                error["mean"] = draw.signed(*here, "mean")
    for quantity, budget in run["conservation"].items():
        for key, value in (budget or {}).items():
            if isinstance(value, list):
                budget[key] = [draw.signed(index, quantity, key, k) for k in range(len(value))]
            elif value is not None:
                budget[key] = draw.signed(index, quantity, key)
    for k, wall in enumerate(run["wall_flux"]):
        wall |= {key: draw.signed(index, "wall", k, key) for key in ("measured", "exact", "error")}
        wall["scale"] = draw.size(index, "wall", k, "scale", low=1.0, high=10.0)
    for k, wall in enumerate(run.get("wall_budgets", [])):
        impulse = wall["impulse"]
        for key in ("measured", "prescribed"):
            impulse[key] = [draw.signed(index, "impulse", k, key, axis) for axis in range(len(impulse[key]))]
        impulse["defect"] = [m - p for m, p in zip(impulse["measured"], impulse["prescribed"])]
    for k, shock in enumerate(run.get("shocks", [])):
        shock["position_error"] = draw.signed(index, "shock", k)
        shock["plateau"] = {key: draw.signed(index, "shock", k, key) for key in shock["plateau"]}
    for key in ("volume_defect", "wall_heating", "energy_routes") if "motion" in run else ():
        run["motion"][key] = draw.signed(index, "motion", key)
    if run["cost"]:
        times = draw.times(index, "cost")
        names = ("steps", "rate_evaluations", "pair_interactions", "peak_bytes")
        counts = {key: draw.count(index, key) for key in names}
        sizes = {key: draw.size(index, key) for key in ("cpu_seconds", "setup_seconds", "busy")}
        run["cost"] |= times | counts | sizes | {"seconds": 0.9 * times["low_seconds"]}
    if run["integration"]:
        run["integration"]["time_error_share"] = draw.size(index, "share", low=1e-5, high=1e-2)
    if run["stability"]:
        scramble_stability(run["stability"], index, draw)
    if "second_law" in run:
        scramble_second_law(run["second_law"], index, draw)


def scramble_stability(stability, index, draw):
    stability |= {key: draw.signed(index, key) for key in ("spectral_abscissa", "largest_imaginary")}
    for key in ("abscissa_uncertainty", "spectral_radius", "largest_stable_step"):
        stability[key] = draw.size(index, key)
    stability["growing_modes"] = draw.count(index, "growing", most=9)
    stability["unseen_modes"] = draw.count(index, "unseen", most=90)
    stability["method"] = draw.one_of(("dense", "arnoldi"), index, "method")
    stability["remark"] = draw.one_of(("", "", "few of many"), index, "remark")
    stability["worst_mode"] = {
        "growth": draw.signed(index, "growth"),
        "frequency": draw.size(index, "frequency"),
        "wavelength": draw.size(index, "wavelength", low=2.0, high=50.0),
        "wall_share": draw.size(index, "share of walls"),
        "centre": [draw.size(index, "centre")],
    }
    stability["stable_steps"]["leapfrog"] = {}  # that of a gas, which has no spectrum but at rest
    for method, step in stability["stable_steps"].items():
        # Of replicates the one with the shortest step by experiment has the shortest by theory.
        theory = draw.size(index, method, "step")
        step |= {"theory": theory, "measured": theory * draw.one_of((1.004, 0.996, 1.4, 0.7), method, "part")}
        step["remark"] = draw.one_of(("", "", "steps were few"), index, method, "remark")


def scramble_second_law(law, index, draw):
    for key in ("overshoot", "undershoot", "cold_to_hot"):
        size = draw.one_of((0.0, draw.size(index, key), draw.size(index, key)), index, key, "whether")
        law[key] = {"size": size, "time": 0.0, "position": []}
        if size > 0:
            law[key] |= {"time": draw.size(index, key, "time"), "position": [draw.size(index, key, "place")]}
    law["smallest_entropy_production"] = draw.signed(index, "entropy")
    remarks = ("", "", "", "entropy of a wall is not known", "a wall brings heat of its own", "a source gives heat")
    law["remark"] = draw.one_of(remarks, index, "law")


def scramble_series(series, index, draw):
    verdicts = ("asymptotic", "pre-asymptotic", "floored", "diverging")
    for entry in series["orders"]:
        here = (index, entry["field"], entry["region"], entry["norm"])
        order = draw.signed(*here, "order", low=0.1, high=4.0)
        ends = [order - draw.size(*here, "below"), order + draw.size(*here, "above")]
        entry |= {"order": order, "interval": ends, "verdict": draw.one_of(verdicts, *here, "verdict")}
        entry["reason"] = f"reason {draw.count(*here, 'reason')}"
        entry["model"] = draw.one_of(("power", "floor", None), *here)
        entry["floor"] = draw.estimate(*here, "floor", high=0.1)
        entry["targets"] = [
            {"error": draw.size(*here, relative), "relative": relative, "remark": f"remark {draw.count(*here, relative)}"}
            | {"N": draw.size(*here, relative, "N", low=10.0, high=1e4)}
            for relative in (0.1, 0.01, 0.001)
        ]
        for level in entry["levels"]:
            at = (*here, level["resolution"])
            for key in ("error", "spread"):
                if level[key] is not None:
                    level[key] = draw.size(*at, key)
            level |= draw.times(*at, "times") | {"mean": draw.signed(*at, "mean")}
            level["seconds"] = 0.9 * level["low_seconds"]
    for k, target in enumerate(series["time_to_error"]):
        target |= draw.times(index, "target", k)
        target |= {"seconds": 0.9 * target["low_seconds"], "is_bound": draw.one_of((True, False), index, k)}


def scramble_surface(surface, index, draw):
    surface["misfit"] = draw.size(index, "misfit")
    for key in ("smoothing", "sampling", "spacing", "neighbour"):
        surface[f"{key}_exponent"] = draw.estimate(index, key, high=4.0)
    ratios = sorted({cell["smoothing_ratio"] for cell in surface["cells"]})
    for cell in surface["cells"]:
        at = (index, "cell", cell["resolution"], cell["smoothing_ratio"])
        cell |= {"error": draw.size(*at, "error"), "fitted": draw.size(*at, "fitted")}
    for best in surface["best"]:
        at = (index, "best", best["resolution"])
        best["ratio"] = draw.estimate(*at, "ratio", low=0.8 * ratios[0], high=1.2 * ratios[-1])
        best |= {"edge": draw.one_of((None, "lower", "upper"), *at), "error": draw.size(*at, "error")}
        best |= {"grid_ratio": draw.one_of(ratios, *at, "grid"), "grid_error": draw.size(*at, "grid error")}
    for path in surface["paths"]:
        unit = path["unit"]
        path["grid_exponent"] = draw.signed(index, unit, "exponent")
        for rule in path["rules"]:
            at = (index, unit, rule["exponent"])
            rule |= {"error_ratio": draw.estimate(*at, "error", low=0.5, high=50.0)}
            rule |= {"cost_ratio": draw.estimate(*at, "cost", low=0.5, high=50.0)}
            rule["remark"] = draw.one_of((None, f"remark {draw.count(*at)}"), *at, "remark")


def scramble_envelope(envelope, index, draw):
    for key in ("held", "failed"):
        if envelope[key] is not None:
            envelope[key] = draw.size(index, key)
    for k, point in enumerate(envelope["points"]):
        point["value"] = draw.size(index, "point", k)


def break_run(document, index, status):
    """A run that failed has a reason and no errors, and its level no error; where that is the finest there is no law."""
    run = document["runs"][index]
    run |= {"status": status, "reason": f"{status} by hand", "errors": {}}
    for series in document["series"]:
        if index not in series["runs"]:
            continue
        for entry in series["orders"]:
            entry |= {"floor": None, "targets": []}
            for level in entry["levels"]:
                if level["resolution"] == run["resolution"]:
                    level |= {"error": None, "spread": None, "mean": None}
