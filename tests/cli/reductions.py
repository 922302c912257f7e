# SPDX-License-Identifier: GPL-3.0-or-later
"""What tables and pages say of a results document, computed from its JSON in plain form."""

import math
import sys

LEADING_FIELDS = ("temperature", "velocity", "acceleration", "heating")
STEP_METHODS = ("explicit-euler", "heun", "classical-runge-kutta", "runge-kutta", "leapfrog")
SETTINGS = ("kernel", "pair_weight", "density", "layout", "face_weight", "closure", "integrator", "wall_motion", "smoothing",
            "viscosity", "smoothing_ratio", "smoothing_exponent")  # fmt: skip
# Half of the 95% interval of Student's t, by degrees of freedom.
STUDENT = {1: 12.706204736174698, 2: 4.302652729749464, 3: 3.182446305283708}


# Words of settings.


def layout_text(layout):
    if not isinstance(layout, dict):
        return layout
    distance = {"jittered": "amplitude", "clumped": "separation", "touching": "gap"}.get(layout["id"])
    name = {"jittered": "jitter"}.get(layout["id"], layout["id"])
    name = name if distance is None else f"{name} {layout[distance]:g}"
    return name + (", Voronoi masses" if "masses" in layout else "")


def seed_of(layout):
    """None of a layout that is not drawn by lot."""
    return layout["seed"] if isinstance(layout, dict) and layout["id"] in ("jittered", "glass", "random") else None


def viscosity_text(viscosity):
    return "off" if viscosity == "off" else f"{viscosity['alpha']:g} {viscosity['beta']:g}"


def value_text(value):
    if isinstance(value, list):
        return "[" + ", ".join(value_text(one) for one in value) + "]"
    return value if isinstance(value, str) else f"{value:g}"


def parameters_text(parameters):
    return " ".join(f"{name}={value_text(value)}" for name, value in sorted(parameters.items()))


def setting_words(entry):
    """Of a run, a series, a surface or an envelope; the last two have no path."""
    d = entry["discretisation"]
    words = {key: d[key] for key in SETTINGS if key in d}
    words |= {"layout": layout_text(d["layout"]), "viscosity": viscosity_text(d["viscosity"])}
    words["smoothing_ratio"] = f"{d.get('smoothing_ratio', 1.0):g}"
    exponent = entry.get("smoothing_exponent", 0.0)  # of a surface: another one, which is fitted
    words["smoothing_exponent"] = "0" if isinstance(exponent, dict) else f"{exponent:g}"
    return words


# Reductions.


def largest(values):
    known = [value for value in values if value is not None]
    return max(known) if known else None


def furthest_from_zero(values):
    known = [value for value in values if value is not None]
    return max(known, key=abs) if known else None


def mean(values):
    """None where one is missing."""
    return None if not values or None in values else sum(values) / len(values)


def over(value, scale):
    return None if value is None else value / scale


def runs_of(document, series):
    return [document["runs"][index] for index in series["runs"]]


def finest_of(document, series):
    """All replicates of the finest level, failed ones too."""
    runs = runs_of(document, series)
    finest = max(run["resolution"] for run in runs)
    return [run for run in runs if run["resolution"] == finest]


def sound(runs):
    return [run for run in runs if run["status"] == "ok"]


def flux_error(run):
    """Of the worst wall."""
    return largest([abs(wall["error"]) / wall["scale"] for wall in run["wall_flux"] if wall["scale"] > 0])


def energy_scale(run):
    energy = run["conservation"]["energy"]
    return max(abs(energy["initial"]), abs(energy["final"])) or 1.0


def energy_part(run, part):
    """A part of the energy's budget relative to the energy, with its sign."""
    energy = run["conservation"]["energy"]
    return None if energy is None else over(energy[part], energy_scale(run))


def energy_rounding(run):
    if run["conservation"]["energy"] is None:
        return None
    size = max(energy_scale(run), abs(run["conservation"]["energy"]["exchanged"]))
    return rounding_of(size, run) / energy_scale(run)


def rounding_of(size, run):
    """Sums of that size that are taken anew at every step err as a random walk does."""
    steps = run["cost"]["steps"] if run["cost"] else 1
    return 64 * sys.float_info.epsilon * math.sqrt(max(steps, 1)) * size


def largest_impulse(run):
    """That a wall prescribes."""
    return max((abs(p) for wall in run.get("wall_budgets", []) for p in wall["impulse"]["prescribed"]), default=0.0)


def thermal_momentum(run):
    """No momentum of that gas exceeds it."""
    budgets = run["conservation"]
    return math.sqrt(2 * abs(budgets["mass"]["initial"] * budgets["energy"]["initial"]))


def momentum_scale(run):
    return largest_impulse(run) or thermal_momentum(run)


def momentum_part(run, part):
    if run["conservation"]["momentum"] is None:
        return None
    return over(furthest_from_zero(run["conservation"]["momentum"][part]), momentum_scale(run))


def momentum_rounding(run):
    if run["conservation"]["momentum"] is None:
        return None
    return rounding_of(max(largest_impulse(run), thermal_momentum(run)), run) / momentum_scale(run)


def impulse_defect(run):
    """Of the worst wall, as a part of the largest impulse that one prescribes."""
    scale = largest_impulse(run)
    if scale == 0:
        return None
    impulses = [wall["impulse"] for wall in run["wall_budgets"]]
    return max(abs(m - p) for i in impulses for m, p in zip(i["measured"], i["prescribed"])) / scale


def share_of(run):
    return run["integration"]["time_error_share"] if run["integration"] else None


def watched_bounds(law):
    return law["remark"] == "" or law["remark"].startswith("entropy")


def watched_cold_to_hot(law):
    return watched_bounds(law) or law["remark"].startswith("a wall brings heat")


def entry_of(series, field, region, norm):
    for order in series["orders"]:
        if (order["field"], order["region"], order["norm"]) == (field, region, norm):
            return order
    return None


def leading_entry(series, region="all", norm=None):
    """Of the field that the case is about; without a norm that which suits the solution."""
    norm = norm or ("l1" if series["discontinuous"] else "l2")
    entries = [entry_of(series, field, region, norm) for field in LEADING_FIELDS]
    return next((entry for entry in entries if entry), None)


def target_of(series, entry, relative):
    """The time to an error, or nothing."""
    for target in series["time_to_error"]:
        wanted = (entry["field"], entry["region"], entry["norm"], relative)
        if (target["field"], target["region"], target["norm"], target["relative"]) == wanted:
            return target
    return {key: None for key in ("seconds", "median_seconds", "low_seconds", "high_seconds")} | {"is_bound": False}


def scale_of(document, series, entry):
    """The same norm of the exact field at the finest level that has it; 0 where none does."""
    runs = [run for run in runs_of(document, series) if entry["region"] in run["errors"].get(entry["field"], {})]
    if not runs:
        return 0.0
    finest = max(runs, key=lambda run: run["resolution"])
    return finest["errors"][entry["field"]][entry["region"]]["scale"][entry["norm"]]


def failures_of(runs):
    failed = [run["status"] for run in runs if run["status"] != "ok"]
    return f"{failed[-1]} {len(failed)}/{len(runs)}" if failed else ""


def known_or_above_zero(values):
    """The largest; where one is not known only if another is above 0, which is enough to know."""
    most = largest(values)
    return most if None not in values or (most or 0) > 0 else None


def shortest_step(steps):
    """Of the replicates of one method; by experiment where there is one."""
    return min(steps, key=lambda step: step["measured"] if step["measured"] is not None else step["theory"] or 0.0)


def stability_numbers(members):
    """Of all replicates, also of those that failed: what fails has the most to say."""
    names = {method: "stable_step_" + method.replace("-", "_") for method in STEP_METHODS}
    numbers = dict.fromkeys(("spectral_abscissa", "spectral_radius", "growing_modes", "unseen_modes"))
    for name in names.values():
        numbers |= {name: None, name + "_theory": None}
    all_of = [run["stability"] for run in members]
    if not any(all_of):
        return numbers
    get = lambda key: [s[key] if s else None for s in all_of]  # noqa: E731
    numbers["spectral_abscissa"] = known_or_above_zero(get("spectral_abscissa"))
    numbers["growing_modes"] = known_or_above_zero(get("growing_modes"))
    for key in ("spectral_radius", "unseen_modes"):
        numbers[key] = None if None in get(key) else max(get(key))
    for method, name in names.items():
        steps = [s["stable_steps"].get(method) if s else None for s in all_of]
        if None not in steps:
            step = shortest_step(steps)
            numbers |= {name: step["measured"], name + "_theory": step["theory"]}
    return numbers


def second_law_numbers(runs):
    laws = [run["second_law"] for run in runs if "second_law" in run]
    watched_all = lambda watched: laws and all(map(watched, laws))  # noqa: E731
    of = lambda key, watched: max(law[key]["size"] for law in laws) if watched_all(watched) else None  # noqa: E731
    made = [law["smallest_entropy_production"] for law in laws if law["smallest_entropy_production"] is not None]
    return {
        "overshoot": of("overshoot", watched_bounds),
        "undershoot": of("undershoot", watched_bounds),
        "cold_to_hot": of("cold_to_hot", watched_cold_to_hot),
        "smallest_entropy_production": min(made) if made else None,
    }


def series_numbers(document, series, region="all", norm=None):
    """All numbers of a ladder at its finest level, by the names of the tables for programs."""
    members = finest_of(document, series)
    kept = sound(members)
    entry = leading_entry(series, region, norm)
    numbers = error_numbers(document, series, entry)
    costs = [run["cost"] for run in kept if run["cost"]]
    for key in ("seconds", "median_seconds", "low_seconds", "high_seconds"):
        numbers[key] = mean([cost[key] for cost in costs])
    busy = [run["cost"]["busy"] for run in runs_of(document, series) if run["cost"]]
    numbers["busy"] = min([b for b in busy if b is not None], default=None)
    numbers["time_error_share"] = largest([share_of(run) for run in runs_of(document, series)])
    shocks = [shock for run in kept for shock in run.get("shocks", [])]
    motions = [run["motion"] for run in kept if "motion" in run]
    numbers |= {
        "wall_flux_error": largest([flux_error(run) for run in kept]),
        "energy_drift": largest([magnitude(energy_part(run, "drift")) for run in kept]),
        "energy_pair_drift": furthest_from_zero([energy_part(run, "pair_drift") for run in kept]),
        "energy_rounding": largest([energy_rounding(run) for run in kept]),
        "wall_budget_defect": largest([magnitude(energy_part(run, "wall_budget_defect")) for run in kept]),
        "momentum_drift": furthest_from_zero([momentum_part(run, "drift") for run in kept]),
        "momentum_pair_drift": furthest_from_zero([momentum_part(run, "pair_drift") for run in kept]),
        "momentum_rounding": largest([momentum_rounding(run) for run in kept]),
        "plateau_pressure_error": furthest_from_zero([shock["plateau"]["pressure"] for shock in shocks]),
        "shock_position_error": furthest_from_zero([shock["position_error"] for shock in shocks]),
        "wall_heating": furthest_from_zero([motion["wall_heating"] for motion in motions]),
        "energy_routes": furthest_from_zero([motion["energy_routes"] for motion in motions]),
        "wall_impulse_defect": largest([impulse_defect(run) for run in kept]),
    }
    return numbers | stability_numbers(members) | second_law_numbers(kept)


def magnitude(value):
    return None if value is None else abs(value)


def error_numbers(document, series, entry):
    """What an observed order says, and the times to an error that go with it."""
    names = ("error", "relative_error", "order", "order_half_width", "order_low", "order_high", "floor", "floor_low",
             "floor_high", "resolution_of_1_percent")  # fmt: skip
    numbers = dict.fromkeys(names)
    for name in ("percent", "permille"):
        numbers |= dict.fromkeys(f"{kind}seconds_to_1_{name}" for kind in ("", "median_", "low_", "high_"))
    if entry is None:
        return numbers
    finest = max(run["resolution"] for run in runs_of(document, series))
    error = next((level["error"] for level in entry["levels"] if level["resolution"] == finest), None)
    scale = scale_of(document, series, entry)
    numbers |= {"error": error, "relative_error": error / scale if error is not None and scale > 0 else None}
    numbers["order"] = entry["order"]
    if entry["interval"]:
        low, high = entry["interval"]
        numbers |= {"order_low": low, "order_high": high, "order_half_width": (high - low) / 2}
    if entry["floor"]:
        unit = scale if scale > 0 else 1.0
        low, high = entry["floor"]["interval"]
        numbers |= {"floor": entry["floor"]["value"] / unit, "floor_low": low / unit, "floor_high": high / unit}
    for target in entry["targets"]:
        if target["relative"] == 0.01:
            numbers["resolution_of_1_percent"] = target["N"]
    for relative, name in ((0.01, "percent"), (0.001, "permille")):
        target = target_of(series, entry, relative)
        for kind in ("", "median_", "low_", "high_"):
            numbers[f"{kind}seconds_to_1_{name}"] = target[f"{kind}seconds"]
    return numbers
