# SPDX-License-Identifier: GPL-3.0-or-later
"""Every measure, key and word of gates on both sides of its limit. The numbers are computed here from a results document
in which every number is another (scrambled.py), so that a limit a hair beyond them tells a wrong number from the right
one. The grammar's schema says what there is: a word that is not tried here fails the test."""

import sys

sys.dont_write_bytecode = True

import itertools
import json
import math
import os
import re
import unittest
import unittest.mock

from program import DONE, GATE_FAILED, SCHEMAS, SOURCE_DIR, ProgramTest, small_study
from reductions import LEADING_FIELDS, entry_of
from scrambled import scrambled

SCHEMA = SCHEMAS["sphverify-gates-1"]
NORMS = ("l1", "l2", "linf")
EPSILON = sys.float_info.epsilon
INNER, TOTAL = "work/internal-energy", "work/total-energy"
BROOKSHAW, CAMPBELL = "conduction/brookshaw", "conduction/campbell-flux"
P_RHO2, SQRT_P = "momentum/p-rho2", "momentum/sqrt-p"
SLAB, PISTON, HOT_WALL = "conduction/slab-dirichlet", "hydro/piston-velocity", "coupled/hot-wall"
STUDY = small_study(
    cases=[{"id": id, "parameters": {"final_time": end}}
           for id, end in ((SLAB, 0.01), (SLAB, 0.02), (PISTON, 0.05), (HOT_WALL, 0.03))],
    formulations=[BROOKSHAW, CAMPBELL, {"id": BROOKSHAW, "walls": "off"}, SQRT_P, {"id": SQRT_P, "work": TOTAL},
                  {"id": P_RHO2, "work": INNER}, {"id": P_RHO2, "work": TOTAL}, {"id": SQRT_P, "conduction": BROOKSHAW},
                  {"id": P_RHO2, "work": TOTAL, "conduction": BROOKSHAW},
                  {"id": P_RHO2, "work": TOTAL, "conduction": CAMPBELL}],
    discretisation={"density": "summation",
                    "layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2]}]},
    resolution=[8, 12, 16],
    measure=["error", "conservation", "cost", "stability"],
    repeat=1,
)  # fmt: skip
KNOWN = {"expect": "fail", "reason": "known to fail"}
IF_EXPECTED = {"passed": "unexpected-pass", "failed": "expected-failure", "undecided": "undecided"}
HOLD = ("passed", "within-noise", "expected-failure")


def above(value):
    return math.nextafter(value, math.inf)


def below(value):
    return math.nextafter(value, -math.inf)


class Batch:
    """Gates on one results document with the verdicts that they must have."""

    def __init__(self, results, trials, baselines=(), **keys):
        self.results, self.trials, self.baselines, self.keys = results, list(trials), dict(baselines), keys


def gate(measure, series, **keys):
    return {"select": select_of(series), "measure": measure, **keys}


def select_of(series, **keys):
    """One ladder alone."""
    layout = series["discretisation"]["layout"]
    formulation = {"id": series["formulation"], "work": series["work"], "conduction": series["conduction"]}
    return {"case": series["case"], "parameters": series["parameters"],
            "formulation": formulation, "walls": series["walls"], "discretisation": {"layout": layout}, **keys}  # fmt: skip


def runs_of(results, series, level="all"):
    """At one resolution, the finest or all."""
    runs = [results["runs"][index] for index in series["runs"]]
    finest = max(run["resolution"] for run in runs)
    return [run for run in runs if level == "all" or run["resolution"] == (finest if level == "finest" else level)]


def series_of(results, formulation=BROOKSHAW, layout="lattice", walls="on", **keys):
    """The first that is so."""
    is_layout = lambda found: (found if isinstance(found, str) else found["id"]) == layout  # noqa: E731
    return next(s for s in results["series"] if s["formulation"] == formulation and s["walls"] == walls
                and is_layout(s["discretisation"]["layout"]) and all(s[key] == value for key, value in keys.items()))  # fmt: skip


def copy_of(document):
    return json.loads(json.dumps(document))


def only(results, chosen):
    """The document with these ladders alone."""
    kept = copy_of(results | {"runs": [], "series": []})
    for series in chosen:
        runs = runs_of(results, series)
        first = len(kept["runs"])
        kept["runs"] += copy_of(runs)
        kept["series"].append(copy_of(series) | {"runs": list(range(first, first + len(runs)))})
    return kept


def without_ends(entry):
    """Run times of few repeats have no interval."""
    entry |= {"low_seconds": None, "high_seconds": None}


# Trials of one number, and of numbers with intervals.


def sides(base, numbers):
    """On each limit, and a hair beyond it."""
    top, bottom = max(numbers), min(numbers)
    yield base | {"maximum": top}, "passed"
    yield base | {"maximum": below(top)}, "failed"
    yield base | {"minimum": bottom}, "passed"
    yield base | {"minimum": above(bottom)}, "failed"
    yield base | {"minimum": bottom, "maximum": top}, "passed"
    yield base | {"minimum": below(bottom), "maximum": below(top)}, "failed"
    yield base | {"minimum": above(bottom), "maximum": above(top)}, "failed"
    if base["measure"] != "order":
        yield base | {"equals": top}, "passed" if top == bottom else "failed"
        yield base | {"equals": above(top)}, "failed"
        yield base | {"equals": below(top)}, "failed"


def expected(trials):
    """The same where a failure is expected."""
    for one, verdict in trials:
        yield one | KNOWN, IF_EXPECTED[verdict]
        yield one | {"expect": "pass"}, verdict


def order_sides(base, low, high):
    """A limit inside the interval decides nothing."""
    for key, right, inside, wrong in (("maximum", high, (below(high), low), below(low)),
                                      ("minimum", low, (above(low), high), above(high))):  # fmt: skip
        yield base | {key: right}, "passed"
        yield base | {key: wrong}, "failed"
        for limit in inside:
            yield base | {key: limit}, "undecided"
    yield base | {"minimum": low, "maximum": high}, "passed"
    yield base | {"minimum": low, "maximum": below(high)}, "undecided"


def noise_sides(base, low, high, value=None):
    """A limit inside the interval of timings is within noise, which holds."""
    yield base | {"maximum": high}, "passed"
    yield base | {"maximum": below(high)}, "within-noise"
    yield base | {"maximum": low}, "within-noise"
    yield base | {"maximum": below(low)}, "failed"
    yield base | {"minimum": low}, "passed"
    yield base | {"minimum": above(low)}, "within-noise"
    yield base | {"minimum": high}, "within-noise"
    yield base | {"minimum": above(high)}, "failed"
    if value is not None:
        yield base | {"equals": value}, "passed"
        yield base | {"equals": above(value)}, "failed"


def within_sides(base, now, old):
    """The larger of a part of the old number and of what is absolute."""
    difference = abs(now - old)
    part = difference / abs(old)
    for tolerance, verdict in (
        ({"absolute": difference}, "passed"),
        ({"absolute": below(difference)}, "failed"),
        ({"relative": part * (1 + 1e-9)}, "passed"),
        ({"relative": part * (1 - 1e-9)}, "failed"),
        ({"relative": part * (1 - 1e-9), "absolute": difference}, "passed"),
        ({"relative": part * (1 + 1e-9), "absolute": difference / 2}, "passed"),
        ({"relative": part * (1 - 1e-9), "absolute": below(difference)}, "failed"),
    ):
        yield base | {"within": tolerance, "baseline": "old.json"}, verdict


# Errors.


def error_number(one, run, field, region):
    error = run["errors"][field][region]
    norm = one.get("norm", "l2")
    if one["measure"] == "skill":
        return error[norm] / error["initial"][norm]
    return error[norm] / (error["scale"][norm] if one.get("relative") else 1.0)


def error_batches(results):
    """Of `error` and `skill`."""
    trials = []
    old = scrambled(results, seed=7)
    for series in (series_of(results, CAMPBELL), series_of(results, SQRT_P, layout="jittered")):
        runs = runs_of(results, series, "finest")
        field = next(field for field in LEADING_FIELDS if field in runs[0]["errors"])
        for measure, relative in (("error", None), ("error", True), ("error", False), ("skill", None)):
            extra = {} if relative is None else {"relative": relative}
            base = gate(measure, series, **extra)
            numbers = lambda one, level="finest", field=field, region="all": [  # noqa: E731
                error_number(one, run, field, region) for run in runs_of(results, series, level)]  # noqa: B023  # fmt: skip
            # What no key says: the leading field, all particles, l2, the finest level.
            trials += sides(base, numbers(base))
            trials += expected(sides(base, numbers(base)))
            for level in ("finest", "all", 8, 12):
                one = base | {"resolution": level}
                trials += sides(one, numbers(one, level))
            # The finest is that of what was selected.
            trials += sides(base | {"select": select_of(series, resolution=[8, 12])}, numbers(base, 12))
            for name, regions in runs[0]["errors"].items():
                for region, norm in itertools.product(regions, NORMS):
                    one = base | {"field": name, "region": region, "norm": norm}
                    if measure == "error" or "initial" in regions[region]:
                        trials += sides(one, numbers(one, field=name, region=region))
            if len(runs) == 1:
                its = runs_of(old, series, "finest")[0]
                trials += within_sides(base, *numbers(base), error_number(base, its, field, "all"))
    yield Batch(results, trials, {"old.json": old})


# Time errors.


def time_error_batches(results):
    trials = []
    old = scrambled(results, seed=7)
    for layout in ("lattice", "jittered"):
        series = series_of(results, layout=layout)
        share = lambda run: run["integration"]["time_error_share"]  # noqa: E731
        base = gate("time_error", series)
        numbers = [share(run) for run in runs_of(results, series)]
        trials += [*sides(base, numbers), *expected(sides(base, numbers))]
        for level in ("finest", "all", 8, 12, 16):
            trials += sides(base | {"resolution": level}, [share(run) for run in runs_of(results, series, level)])
    one = gate("time_error", series_of(results), resolution=12)
    run, its = (runs_of(document, series_of(document), 12)[0] for document in (results, old))
    trials += within_sides(one, share(run), share(its))
    null = copy_of(results)
    runs_of(null, series_of(null), 12)[0]["integration"]["time_error_share"] = None
    yield Batch(results, trials, {"old.json": old})
    yield Batch(null, [(one | {"maximum": 1e9}, "failed"), (one | {"maximum": 1e9} | KNOWN, "failed")])


# Budgets.


def budget_number(one, run):
    quantity = one.get("quantity", "energy")
    budget = run["conservation"][quantity]
    as_list = lambda key: budget[key] if isinstance(budget[key], list) else [budget[key]]  # noqa: E731
    part = max(map(abs, as_list(one.get("what", "drift"))))
    if not one.get("relative", True):
        return part
    return part / budget_size(run, quantity)


def budget_size(run, quantity):
    """The largest of initial, final and exchanged; of momentum also the impulse that a wall prescribes."""
    budget = run["conservation"][quantity]
    flat = [value for key in ("initial", "final", "exchanged")
            for value in (budget[key] if isinstance(budget[key], list) else [budget[key]])]  # fmt: skip
    walls = run.get("wall_budgets", []) if quantity == "momentum" else []
    return max(map(abs, flat + [value for wall in walls for value in wall["impulse"]["prescribed"]]))


def with_all_budgets(results):
    """Parts that a case does not measure are numbers, too; and the largest term of each run's momentum is another."""
    results = copy_of(results)
    for index, run in enumerate(results["runs"]):
        for k, budget in enumerate(budget for budget in run["conservation"].values() if budget):
            for key in ("pair_drift", "wall_budget_defect"):
                if budget[key] in (None, [None]):
                    number = 1e-3 * (7 * index + k + 1) * (-1) ** index
                    budget[key] = [number] if isinstance(budget["drift"], list) else number
        momentum = run["conservation"]["momentum"]
        if momentum:
            place = ("initial", "final", "exchanged", None)[index % 4]
            if place:
                momentum[place] = [-3.0 - index]
            else:
                run["wall_budgets"][index // 4 % 2]["impulse"]["prescribed"] = [-3.0 - index]
        energy = run["conservation"]["energy"]
        if energy:
            energy[("initial", "final", "exchanged")[index % 3]] = -2.0 - index
    return results


def conservation_batches(results):
    trials = []
    results = with_all_budgets(results)
    old = with_all_budgets(scrambled(results, seed=7))
    gas, heat = series_of(results, SQRT_P, layout="jittered"), series_of(results)
    for series in (gas, heat):
        base = gate("conservation", series)
        numbers = lambda one, level="all": [  # noqa: E731
            budget_number(one, run) for run in runs_of(results, series, level)]  # noqa: B023  # fmt: skip
        trials += [*sides(base, numbers(base)), *expected(sides(base, numbers(base)))]
        for level in ("finest", "all", 8, 12, 16):
            trials += sides(base | {"resolution": level}, numbers(base, level))
        quantities = [key for key, budget in runs_of(results, series)[0]["conservation"].items() if budget]
        for quantity, what in itertools.product(quantities, ("drift", "pair_drift", "wall_budget_defect")):
            for relative in (None, True, False):
                one = base | {"quantity": quantity, "what": what} | ({} if relative is None else {"relative": relative})
                trials += sides(one, numbers(one))
    one = gate("conservation", heat, resolution=12)
    trials += within_sides(one, *(budget_number(one, runs_of(document, heat, 12)[0]) for document in (results, old)))
    yield Batch(results, trials, {"old.json": old})
    null = copy_of(results)
    runs_of(null, heat, 12)[0]["conservation"]["energy"]["pair_drift"] = None
    one |= {"what": "pair_drift", "maximum": 1e9}
    yield Batch(null, [(one, "failed"), (one | KNOWN, "failed")])


# Fluxes.


def flux_number(one, run):
    walls = run["wall_flux"] if "wall" not in one else [run["wall_flux"][one["wall"]]]
    return max(abs(wall["error"]) / (wall["scale"] if one.get("relative", True) else 1.0) for wall in walls)


def wall_flux_batches(results):
    trials = []
    old = scrambled(results, seed=7)
    for layout in ("lattice", "jittered"):
        series = series_of(results, layout=layout)
        numbers = lambda one, level="finest": [  # noqa: E731
            flux_number(one, run) for run in runs_of(results, series, level)]  # noqa: B023  # fmt: skip
        base = gate("wall_flux", series)
        trials += [*sides(base, numbers(base)), *expected(sides(base, numbers(base)))]
        for level in ("finest", "all", 8, 12):
            trials += sides(base | {"resolution": level}, numbers(base, level))
        for wall, relative in itertools.product((None, 0, 1), (None, True, False)):
            given = {"wall": wall, "relative": relative}
            one = base | {key: value for key, value in given.items() if value is not None}
            trials += sides(one, numbers(one))
    one = gate("wall_flux", series_of(results), wall=1)
    trials += within_sides(one, *(flux_number(one, runs_of(document, series_of(document), 16)[0])
                                  for document in (results, old)))  # fmt: skip
    yield Batch(results, trials, {"old.json": old})


# How runs ended.

STATUSES = {"ok": True, "failed": False, "unstable": True, "non-finite": True, "positivity-lost": True, "timed-out": False,
            "invalid": False, "crashed": False}  # fmt: skip


def status_batches(results):
    """Of each status whether it tells of the scheme."""
    series = series_of(results)
    for status, tells in STATUSES.items():
        changed = copy_of(results)
        run = runs_of(changed, series, 12)[0]
        run |= {"status": status, "reason": "by hand" if status != "ok" else None}
        trials = []
        for asked in STATUSES:
            one = gate("status", series, resolution=12, equals=asked)
            verdict = "passed" if asked == status else "failed"
            trials += [(one, verdict), (one | {"expect": "pass"}, verdict)]
            trials += [(one | KNOWN, IF_EXPECTED[verdict] if tells or verdict == "passed" else "failed")]
        trials += [(gate("status", series, equals="unstable", resolution="finest"), "failed")]
        whole = gate("status", series, equals="ok")
        trials += [(whole | levels, "passed" if status == "ok" or levels == {"resolution": "finest"} else "failed")
                   for levels in ({}, {"resolution": "all"}, {"resolution": "finest"})]  # fmt: skip
        yield Batch(changed, trials)
        if status == "ok":
            continue
        # A run that is not ok keeps no limit on its numbers, and breaks none that is expected to be broken.
        trials = []
        for measure, keys in (("error", {}), ("skill", {}), ("time_error", {}), ("conservation", {}), ("wall_flux", {}),
                              ("cost", {"quantity": "steps", "relative_to": CAMPBELL})):  # fmt: skip
            for limit in ({"maximum": 1e9}, {"minimum": 1e9}):
                one = gate(measure, series, resolution=12, **keys, **limit)
                trials += [(one, "failed"), (one | KNOWN, "failed")]
        yield Batch(changed, trials)


# Spectra.


def stability_batches(results):
    trials = []
    old = scrambled(results, seed=7)
    broken = copy_of(results)  # what fails has a spectrum all the same
    for layout in ("lattice", "jittered"):
        series = series_of(results, layout=layout)
        runs_of(broken, series)[0].update(status="unstable", reason="by hand")
        for quantity in (None, "spectral_abscissa", "spectral_radius", "largest_stable_step", "growing_modes"):
            base = gate("stability", series) | ({} if quantity is None else {"quantity": quantity})
            numbers = lambda level: [  # noqa: E731
                run["stability"][quantity or "spectral_abscissa"] for run in runs_of(results, series, level)]  # noqa: B023  # fmt: skip
            trials += [*sides(base, numbers("all")), *expected(sides(base, numbers("all")))]
            for level in ("finest", "all", 8, 12):
                trials += sides(base | {"resolution": level}, numbers(level))
    yield Batch(broken, trials)
    one = gate("stability", series_of(results), resolution=12, quantity="spectral_radius")
    run, its = (runs_of(document, series_of(document), 12)[0]["stability"] for document in (results, old))
    yield Batch(results, within_sides(one, run["spectral_radius"], its["spectral_radius"]), {"old.json": old})
    null = copy_of(results)
    runs_of(null, series_of(null), 12)[0]["stability"]["spectral_radius"] = None
    yield Batch(null, [(one | {"maximum": 1e9}, "failed"), (one | {"minimum": 1e9} | KNOWN, "failed")])


# Orders.

VERDICTS = ("asymptotic", "pre-asymptotic", "floored", "diverging", "not-refined")


def with_orders(results, **keys):
    results = copy_of(results)
    for entry in series_of(results)["orders"]:
        entry |= keys
    return results


def order_batches(results):
    results = with_orders(results, verdict="asymptotic", reason="by hand")
    series = series_of(results)
    usual = gate("order", series)
    first = entry_of(series, "temperature", "all", "l2")
    trials = [*order_sides(usual, *first["interval"]), *expected(order_sides(usual, *first["interval"]))]
    for entry in series["orders"]:
        one = usual | {key: entry[key] for key in ("field", "region", "norm")}
        trials += order_sides(one, *entry["interval"])
        trials += order_sides(one | {"interval": "decides", "verdict": "decides"}, *entry["interval"])
        trials += sides(one | {"interval": "ignore"}, [entry["order"]])
    old = scrambled(results, seed=7)
    for entry in series_of(old)["orders"]:
        entry["verdict"] = "asymptotic"
    its = entry_of(series_of(old), "temperature", "all", "l2")
    trials += within_sides(usual, first["order"], its["order"])
    yield Batch(results, trials, {"old.json": old})
    for verdict in VERDICTS:
        changed = with_orders(results, verdict=verdict)
        is_none = verdict in ("floored", "diverging")
        trials = []
        for asked in VERDICTS:
            one, so = usual | {"equals": asked}, "passed" if asked == verdict else "failed"
            tells = verdict != "not-refined" or so == "passed"
            trials += [(one, so), (one | KNOWN, IF_EXPECTED[so] if tells else "failed")]
        for one, so in order_sides(usual, *first["interval"]):
            trials += [(one, "failed" if is_none else so), (one | {"verdict": "ignore"}, so)]
            trials += [(one | {"verdict": "decides"}, "failed" if is_none else so)]
            # A floored ladder whose order is on the right side did not fail as was expected.
            hidden = "failed" if is_none and so != "failed" else IF_EXPECTED[so]
            trials += [(one | KNOWN, hidden)]
        within = {"within": {"absolute": 1e9}, "baseline": "old.json"}
        trials += [(usual | within, "failed" if is_none else "passed")]
        trials += [(usual | within | {"verdict": "ignore"}, "passed")]
        yield Batch(changed, trials, {"old.json": old})
    # Without an interval nothing tells an order from noise; without an order there is nothing to judge.
    trials = []
    for one, so in (*sides(usual, [first["order"]]),):
        trials += [(one, "undecided" if so == "passed" else "failed"), (one | {"interval": "ignore"}, so)]
    yield Batch(with_orders(results, interval=None), trials)
    limits = [usual | {key: limit} for key in ("minimum", "maximum") for limit in (-1e9, 1e9)]
    yield Batch(with_orders(results, order=None, interval=None),
                [(one | more, "failed") for one in limits
                 for more in ({}, {"interval": "ignore"}, {"verdict": "ignore"}, KNOWN)])  # fmt: skip


# Ratios of times and costs.


def reached_times(results):
    """Results in which every ladder reached every error, at a time of its own, none of them a bound."""
    results = copy_of(results)
    for series in results["series"]:
        for target in series["time_to_error"]:
            target["is_bound"] = False
    return results


def time_of(series, one):
    wanted = (one.get("field", "temperature"), one.get("region", "all"), one.get("norm", "l2"), one.get("target", 0.01))
    return next(t for t in series["time_to_error"] if (t["field"], t["region"], t["norm"], t["relative"]) == wanted)


def ratio_ends(own, its):
    """A ratio of medians: the ends of both intervals, divided crosswise."""
    return own["low_seconds"] / its["high_seconds"], own["high_seconds"] / its["low_seconds"]


def time_to_error_batches(results):
    results = reached_times(results)
    plain = copy_of(results)
    for series in plain["series"]:
        for target in series["time_to_error"]:
            without_ends(target)
    own, its = series_of(results), series_of(results, CAMPBELL)
    usual = gate("time_to_error", own, relative_to=its["formulation"])
    median = lambda one, a=own, b=its: time_of(a, one)["median_seconds"] / time_of(b, one)["median_seconds"]  # noqa: E731
    trials, noisy = [], []
    trials += [*sides(usual, [median(usual)]), *expected(sides(usual, [median(usual)]))]
    for target in own["time_to_error"]:
        one = usual | {key: target[key] for key in ("field", "region", "norm")} | {"target": target["relative"]}
        trials += sides(one, [median(one)])
        if target["norm"] != "l2":
            continue
        noisy += noise_sides(one, *ratio_ends(time_of(own, one), time_of(its, one)), median(one))
        noisy += noise_sides(one | {"interval": "decides"}, *ratio_ends(time_of(own, one), time_of(its, one)))
        noisy += sides(one | {"interval": "ignore"}, [median(one)])
    for one, number in partner_trials(results, usual, lambda a, b, one: median(one, a, b)):
        trials += sides(one, [number])
    old = scrambled(plain, seed=7)
    for series in old["series"]:
        for target in series["time_to_error"]:
            target["is_bound"] = False
            without_ends(target)
    trials += within_sides(usual, median(usual), median(usual, series_of(old), series_of(old, CAMPBELL)))
    yield Batch(plain, trials, {"old.json": old})
    yield Batch(results, noisy)
    yield from half_named_batches(plain, usual, lambda a, b, one: median(one, a, b))
    yield from bound_batches(results, plain, usual)
    never = two_conductors(results)
    time_of(series_of(never), usual).update(dict.fromkeys(("seconds", "median_seconds", "low_seconds", "high_seconds")))
    yield Batch(never, [(usual | {"maximum": 1e9}, "failed"), (usual | {"minimum": 1e9} | KNOWN, "failed")])


def bound_batches(results, plain, usual):
    """What was reached on the coarsest level already may have needed any less time."""
    results, plain = two_conductors(results), two_conductors(plain)
    for own_is, its_is in ((True, False), (False, True), (True, True)):
        for document in (results, plain):
            changed = copy_of(document)
            own, its = (time_of(series_of(changed, f), usual) for f in (BROOKSHAW, usual["relative_to"]))
            own["is_bound"], its["is_bound"] = own_is, its_is
            value = own["median_seconds"] / its["median_seconds"]
            low, high = ratio_ends(own, its) if document is results else (value, value)
            # The upper end stays where the other is no bound, the lower one where its own is none. Between the ends of
            # the noise the timings alone may be to blame, if they have an interval.
            noise = "within-noise" if document is results else None
            trials = [(usual | {"maximum": high}, "undecided" if its_is else "passed"),
                      (usual | {"maximum": below(low)}, "undecided" if own_is else "failed"),
                      (usual | {"minimum": low}, "undecided" if own_is else "passed"),
                      (usual | {"minimum": above(high)}, "undecided" if its_is else "failed")]  # fmt: skip
            if noise:
                trials += [(usual | {"maximum": below(high)}, "undecided" if its_is else noise),
                           (usual | {"minimum": above(low)}, "undecided" if own_is else noise)]  # fmt: skip
            trials += sides(usual | {"interval": "ignore"}, [value])
            yield Batch(changed, trials)


def partner_trials(results, usual, number):
    """The formulation that divides, named with its partners and its walls; as (gate, ratio)."""
    piston = lambda id, **keys: series_of(results, id, case=PISTON, **keys)  # noqa: E731
    hot = lambda id, **keys: series_of(results, id, case=HOT_WALL, **keys)  # noqa: E731
    slab = lambda **keys: series_of(results, **keys)  # noqa: E731
    with_both = {"work": TOTAL, "conduction": CAMPBELL}
    cases = [
        (piston(SQRT_P), {"id": P_RHO2, "work": INNER}, piston(P_RHO2, work=INNER)),
        (piston(SQRT_P), {"id": P_RHO2, "work": TOTAL, "conduction": None}, piston(P_RHO2, work=TOTAL)),
        (hot(SQRT_P), {"id": P_RHO2, **with_both}, hot(P_RHO2, **with_both)),
        (hot(SQRT_P), {"id": P_RHO2, "conduction": BROOKSHAW}, hot(P_RHO2, conduction=BROOKSHAW)),
        (slab(), {"id": BROOKSHAW, "walls": "off"}, slab(walls="off")),
        (slab(walls="off"), {"id": BROOKSHAW, "walls": "on"}, slab()),
        # Partners that are not named are those of the formulation itself.
        (piston(SQRT_P, work=TOTAL), P_RHO2, piston(P_RHO2, work=TOTAL)),
    ]
    for one, relative_to, other in cases:
        changed = usual | gate(usual["measure"], one, relative_to=relative_to)
        if usual["measure"] == "time_to_error" and one["case"] == PISTON:
            changed["field"] = "velocity"
        yield changed, number(one, other, changed)


def half_named_batches(results, usual, number):
    """Of two partners one is named: the other is that of the formulation itself."""
    own, other = (series_of(results, id, case=HOT_WALL, conduction=BROOKSHAW) for id in (SQRT_P, P_RHO2))
    one = usual | gate(usual["measure"], own, relative_to={"id": P_RHO2, "work": TOTAL})
    yield Batch(results, sides(one, [number(own, other, one)]))


COSTS = ("seconds", "median_seconds", "cpu_seconds", "setup_seconds", "steps", "rate_evaluations", "pair_interactions",
         "peak_bytes")  # fmt: skip


def cost_batches(results):
    results = copy_of(results)
    plain = copy_of(results)
    for document in (results, plain):
        for run in document["runs"]:
            run["cost"] |= {"occasion": None, "round_seconds": []}
    for run in plain["runs"]:
        without_ends(run["cost"])
    old = scrambled(plain, seed=7)
    for run in old["runs"]:
        without_ends(run["cost"])
    own, its = series_of(results), series_of(results, CAMPBELL)
    usual = gate("cost", own, relative_to=its["formulation"])

    def ratio(one, a, b, document=results):
        key = one.get("quantity", "seconds")
        pairs = zip(*(runs_of(document, series, one.get("resolution", "finest")) for series in (a, b)), strict=True)
        return [r["cost"][key] / s["cost"][key] for r, s in pairs]

    trials = [*sides(usual, ratio(usual, own, its)), *expected(sides(usual, ratio(usual, own, its)))]
    for quantity, level in itertools.product(COSTS, (None, "finest", "all", 8)):
        one = usual | {"quantity": quantity} | ({} if level is None else {"resolution": level})
        trials += sides(one, ratio(one, own, its))
    steps = usual | {"quantity": "steps"}
    for one, number in partner_trials(results, steps, lambda a, b, one: ratio(one, a, b)[0]):
        trials += sides(one, [number])
    # Of each seed the run of the same seed divides.
    pair = [series_of(results, f, layout="jittered") for f in (BROOKSHAW, CAMPBELL)]
    one = gate("cost", pair[0], relative_to=CAMPBELL, quantity="pair_interactions")
    trials += sides(one, ratio(one, *pair))
    trials += within_sides(steps, *(ratio(steps, own, its, document)[0] for document in (results, old)))
    yield Batch(plain, trials, {"old.json": old})
    yield from half_named_batches(plain, steps, lambda a, b, one: ratio(one, a, b)[0])

    noisy = []
    a, b = (runs_of(results, series, "finest")[0]["cost"] for series in (own, its))
    low, high = ratio_ends(a, b)
    for quantity in ("seconds", "median_seconds"):
        one = usual | {"quantity": quantity}
        value = ratio(one, own, its)[0]
        # That of a ratio of minima is widened to hold it.
        ends = min(low, value), max(high, value)
        noisy += [*noise_sides(one, *ends, value), *noise_sides(one | {"interval": "decides"}, *ends)]
        noisy += sides(one | {"interval": "ignore"}, [value])
    for quantity in COSTS[2:]:
        one = usual | {"quantity": quantity}
        noisy += sides(one, ratio(one, own, its))
    yield Batch(results, noisy)
    yield from round_batches(results, usual)
    null = two_conductors(plain)
    runs_of(null, its, "finest")[0]["cost"]["cpu_seconds"] = None
    one = usual | {"quantity": "cpu_seconds"}
    yield Batch(null, [(one | {"maximum": 1e9}, "failed"), (one | {"minimum": 1e9} | KNOWN, "failed")])


def round_batches(results, usual):
    """Runs that took turns are compared round by round: of six rounds the interval of the median is the whole range."""
    results = two_conductors(results)
    rounds = ([2.0, 3.0, 5.0, 4.0, 6.0, 9.0], [1.0, 2.0, 2.0, 4.0, 1.5, 2.0])
    ratios = sorted(a / b for a, b in zip(*rounds))
    middle = (ratios[2] + ratios[3]) / 2
    changed = copy_of(results)
    for formulation, seconds in zip((BROOKSHAW, usual["relative_to"]), rounds):
        cost = runs_of(changed, series_of(changed, formulation), "finest")[0]["cost"]
        cost |= {"occasion": "a turn", "round_seconds": seconds}
    one = usual | {"quantity": "median_seconds"}
    trials = [*noise_sides(one, ratios[0], ratios[-1], middle), *sides(one | {"interval": "ignore"}, [middle])]
    yield Batch(changed, trials)
    # With an interval on both sides `within` goes by how far they are apart.
    old = copy_of(changed)
    cost = runs_of(old, series_of(old), "finest")[0]["cost"]
    cost["round_seconds"] = [8 * second for second in cost["round_seconds"]]
    gap = 8 * ratios[0] - ratios[-1]
    trials = [(one | {"within": {"absolute": limit}, "baseline": "old.json"}, verdict)
              for limit, verdict in ((7 * middle, "passed"), (below(7 * middle), "within-noise"), (gap, "within-noise"),
                                     (below(gap), "failed"))]  # fmt: skip
    trials += [(trials[1][0] | {"interval": "ignore"}, "failed")]
    yield Batch(changed, trials, {"old.json": old})


# What a gate looks at.


def matching(results, **wanted):
    """How many runs have all of this, by functions of a run; walls are on unless named."""
    wanted.setdefault("walls", lambda run: run["walls"] == "on")
    return sum(all(test(run) for test in wanted.values()) for run in results["runs"])


ODD = {"odd_word": "odd", "odd_list": [1, 2.5], "odd_table": [[1, 2], [3, 4]]}


def with_odd_parameters(results):
    """Parameters that are words, lists and tables, of one ladder."""
    series = series_of(results)
    for entry in [series, *runs_of(results, series)]:
        entry["parameters"] |= ODD
    return results


def with_masses_of_cells(results):
    """Masses of Voronoi cells, of one disordered ladder."""
    series = next(s for s in results["series"] if isinstance(s["discretisation"]["layout"], dict))
    for entry in [series, *runs_of(results, series)]:
        entry["discretisation"]["layout"] = entry["discretisation"]["layout"] | {"masses": "voronoi"}
    return results


def with_riemann_viscosity(results):
    """In place of the other, of one ladder of a gas."""
    series = next(s for s in results["series"] if s["formulation"] == SQRT_P and isinstance(s["discretisation"]["viscosity"], dict))
    for entry in [series, *runs_of(results, series)]:
        entry["discretisation"]["viscosity"] = "riemann"
    return results


def select_batches(results):
    """By how many runs each key of `select` takes."""
    original, results = results, with_riemann_viscosity(with_masses_of_cells(with_odd_parameters(scrambled(results, settings=True))))
    runs = results["runs"]
    cases = []  # (select, runs that match)

    def add(select, **tests):
        cases.append((select, matching(results, **tests)))

    slab, piston = SLAB, PISTON
    early = lambda run: run["parameters"].get("final_time") == 0.01  # noqa: E731
    is_case = lambda *ids: lambda run: run["case"] in ids  # noqa: E731
    add({"case": slab}, case=is_case(slab))
    add({"case": {"id": slab}}, case=is_case(slab))
    add({"case": {"id": slab, "parameters": {"final_time": 0.01}}}, case=is_case(slab), time=early)
    add({"case": [slab, piston]}, case=is_case(slab, piston))
    both = [{"id": slab, "parameters": {"final_time": 0.01}}, {"id": piston}]
    add({"case": both}, case=lambda run: run["case"] == piston or early(run))
    add({"parameters": {"final_time": 0.01}}, time=early)
    for name, value in ODD.items():
        add({"parameters": {name: value}}, odd=lambda run: "odd_word" in run["parameters"])
        add({"case": {"id": slab, "parameters": {name: value}}}, odd=lambda run: "odd_word" in run["parameters"])
    form = lambda id, **keys: lambda run: run["formulation"] == id and all(run[k] == v for k, v in keys.items())  # noqa: E731
    p_rho2, sqrt_p, brookshaw = P_RHO2, SQRT_P, BROOKSHAW
    add({"formulation": p_rho2}, form=form(p_rho2))
    add({"formulation": {"id": p_rho2}}, form=form(p_rho2))
    for work in (INNER, TOTAL):
        add({"formulation": {"id": p_rho2, "work": work}}, form=form(p_rho2, work=work))
    for conduction in (None, brookshaw):
        add({"formulation": {"id": p_rho2, "conduction": conduction}}, form=form(p_rho2, conduction=conduction))
    add({"formulation": {"id": brookshaw, "work": None}}, form=form(brookshaw))
    for walls in ("on", "off"):
        add({"formulation": {"id": brookshaw, "walls": walls}}, form=form(brookshaw, walls=walls), walls=lambda run: True)
        add({"walls": walls}, walls=lambda run, walls=walls: run["walls"] == walls)
    add({"walls": ["on", "off"]}, walls=lambda run: True)
    add({"formulation": [{"id": brookshaw, "walls": "off"}, sqrt_p]},
        form=lambda run: form(brookshaw, walls="off")(run) or form(sqrt_p)(run), walls=lambda run: True)  # fmt: skip
    for key in ("kernel", "pair_weight", "density", "face_weight", "closure", "integrator", "smoothing", "wall_motion", "smoothing_ratio",
                "viscosity"):  # fmt: skip
        values = []
        for run in runs:
            if run["discretisation"][key] not in values:
                values.append(run["discretisation"][key])
        for value in values:
            add({"discretisation": {key: value}}, value=lambda run, k=key, v=value: run["discretisation"][k] == v)
        add({"discretisation": {key: values[:2]}}, value=lambda run, k=key, v=values[:2]: run["discretisation"][k] in v)
    is_layout = lambda id, **keys: lambda run: (  # noqa: E731
        run["discretisation"]["layout"] == id if id == "lattice" else isinstance(run["discretisation"]["layout"], dict)
        and all(run["discretisation"]["layout"].get(key) == value for key, value in keys.items()))  # fmt: skip
    for layout, test in (("lattice", is_layout("lattice")), ("jittered", is_layout("jittered")),
                         ({"id": "lattice"}, is_layout("lattice")),
                         ({"id": "jittered", "amplitude": 0.1}, is_layout("jittered")),
                         ({"id": "jittered", "masses": "voronoi"}, is_layout("jittered", masses="voronoi")),
                         ({"id": "jittered", "masses": "layout"}, lambda run: is_layout("jittered")(run)
                          and not is_layout("jittered", masses="voronoi")(run)),
                         ({"id": "jittered", "seed": 2}, is_layout("jittered", seed=2)),
                         ({"id": "jittered", "amplitude": 0.1, "seed": 1}, is_layout("jittered", seed=1))):  # fmt: skip
        add({"discretisation": {"layout": layout}}, layout=test)
    add({"discretisation": {"layout": ["lattice", {"id": "jittered", "seed": 2}]}},
        layout=lambda run: is_layout("lattice")(run) or is_layout("jittered", seed=2)(run))  # fmt: skip
    add({"resolution": 8}, level=lambda run: run["resolution"] == 8)
    add({"resolution": [8, 16]}, level=lambda run: run["resolution"] in (8, 16))
    add({"smoothing_exponent": 0.5}, exponent=lambda run: run["smoothing_exponent"] == 0.5)
    add({"smoothing_exponent": [0, 0.25]}, exponent=lambda run: run["smoothing_exponent"] in (0, 0.25))
    # All keys together must match.
    add({"case": slab, "parameters": {"final_time": 0.01}, "formulation": brookshaw, "resolution": 12},
        case=is_case(slab), time=early, form=form(brookshaw), level=lambda run: run["resolution"] == 12)  # fmt: skip
    total = matching(results, walls=lambda run: True)
    trials = []
    for select, count in cases:
        assert 0 < count <= total and (count < total or select == {"walls": ["on", "off"]}), (select, count)
        one = {"select": select, "measure": "status", "equals": "ok"}
        trials += [(one, "passed"), (one | {"runs": count}, "passed"), (one | {"at_least": count}, "passed")]
        trials += [(one | {"runs": count + 1}, "failed"), (one | {"at_least": count + 1}, "failed")]
        trials += [(one | {"runs": count - 1}, "failed")] if count > 1 else []
    yield Batch(results, trials)
    yield Batch(results, nothing_trials())
    yield Batch(reached_times(original), ladder_trials(original))


def nothing_trials():
    """What no run has, alone and beside what some have."""
    amiss = [
        {"case": "hydro/noh"},
        {"case": {"id": SLAB, "parameters": {"final_time": 3}}},
        {"parameters": {"final_time": 3}},
        {"parameters": {"nothing": 1}},
        {"parameters": {"odd_word": "even"}},
        {"parameters": {"odd_list": [1, 2.4]}},
        {"parameters": {"odd_table": [[1, 2], [3, 5]]}},
        {"formulation": "momentum/direct-gradient"},
        {"formulation": {"id": SQRT_P, "conduction": CAMPBELL}},
        {"formulation": {"id": SQRT_P, "work": "work/nothing"}},
        {"formulation": {"id": SQRT_P, "walls": "off"}},
        {"formulation": CAMPBELL, "walls": "off"},
        {"resolution": 9},
        {"smoothing_exponent": 0.75},
        {"discretisation": {"layout": {"id": "jittered", "amplitude": 0.2}}},
        {"discretisation": {"layout": {"id": "jittered", "seed": 3}}},
        {"discretisation": {"layout": "glass"}},
        {"discretisation": {"layout": {"id": "lattice", "masses": "voronoi"}}},
        {"discretisation": {"viscosity": {"alpha": 9, "beta": 9}}},
        {"discretisation": {"smoothing_ratio": 1.21}},
    ]
    keys = ("kernel", "pair_weight", "density", "face_weight", "closure", "integrator", "smoothing", "wall_motion")
    amiss += [{"discretisation": {key: "nothing"}} for key in keys]
    for select in amiss:
        one = {"select": select, "measure": "status", "equals": "ok"}
        for more in ({}, KNOWN, {"runs": 1}, {"at_least": 1}):
            yield one | more, "selects-nothing"
    # An entry of a list that matches nothing, unless the gate says how many it must look at.
    for select in (
        {"case": [SLAB, "hydro/noh"]},
        {"formulation": [BROOKSHAW, {"id": SQRT_P, "walls": "off"}]},
        {"resolution": [8, 9]},
        {"smoothing_exponent": [0, 0.75]},
        {"formulation": SQRT_P, "walls": ["on", "off"]},
        {"discretisation": {"layout": ["lattice", "glass"]}},
        {"discretisation": {"smoothing_ratio": [1.2, 1.21]}},
        {"discretisation": {"viscosity": ["off", {"alpha": 9, "beta": 9}]}},
        {"discretisation": {"kernel": ["cubic-spline", "nothing"]}},
    ):
        one = {"select": select, "measure": "status", "equals": "ok"}
        yield one, "selects-nothing"
        yield one | KNOWN, "selects-nothing"
        yield one | {"at_least": 1}, "passed"


def ladder_trials(results):
    """Of orders and times to an error ladders are counted, not runs; of ratios without the one that divides."""
    slabs = [s for s in results["series"] if s["case"] == SLAB and s["walls"] == "on"]
    orders = {"select": {"case": SLAB}, "measure": "order", "minimum": -1e9, "verdict": "ignore",
              "interval": "ignore"}  # fmt: skip
    own = [series for series in slabs if series["formulation"] == BROOKSHAW]
    times = {"select": {"case": SLAB}, "measure": "time_to_error", "maximum": 1e9,
             "relative_to": CAMPBELL}  # fmt: skip
    for one, count in ((orders, len(slabs)), (times, len(own))):
        for right in ({"runs": count}, {"at_least": count}, {"at_least": count - 1}):
            yield one | right, "passed"
        for wrong in ({"runs": count + 1}, {"runs": count - 1}, {"at_least": count + 1}):
            yield one | wrong, "failed"
    alone = {"select": {"formulation": CAMPBELL}, "measure": "cost", "maximum": 1e9,
             "relative_to": CAMPBELL}  # fmt: skip
    yield alone, "selects-nothing"


# Unchanged since a baseline.


def baseline_batches(results):
    """The baseline of the document, and runs that only one of the two has."""
    one = gate("error", series_of(results), resolution="all", within={"relative": 1e-9})
    words = {"name": "a name", "note": "for people"}
    yield Batch(results, [(one, "passed"), (one | {"note": "for people"}, "passed")], {"old.json": results},
                baseline="old.json", **words)  # fmt: skip
    other = scrambled(results, seed=7)
    # A gate's own baseline comes first.
    yield Batch(results, [(one | {"baseline": "same.json"}, "passed"), (one, "failed"), (one | KNOWN, "expected-failure")],
                {"old.json": other, "same.json": results}, baseline="old.json")  # fmt: skip
    fewer = copy_of(results)
    series_of(fewer)["runs"].pop()
    for now, old in ((results, fewer), (fewer, results)):
        lost = [(one | {"baseline": "old.json"}, "failed"), (one | {"baseline": "old.json"} | KNOWN, "failed")]
        yield Batch(now, lost, {"old.json": old})


def rounding_batches(results):
    """Where the old number is nothing but rounding, the new one may differ by that; where nothing is known of it, by
    nothing."""
    for put, one, rounding in roundings(results):
        inside, outside = rounding * (1 - 1e-9), rounding * (1 + 1e-6)
        cases = [(inside, 0.0, "passed"), (outside, 0.0, "failed"), (0.0, inside, "passed"), (0.0, outside, "failed")]
        for now, old, verdict in cases if rounding else [(0.0, 0.0, "passed"), (1e-300, 0.0, "failed")]:
            documents = []
            for number in (now, old):
                documents.append(copy_of(results))
                put(documents[-1], number)
            trials = [(one | {"within": {"relative": 1e-3}, "baseline": "old.json"}, verdict)]
            # What is absolute is meant.
            if one["measure"] in ("conservation", "stability", "time_error"):
                for part, so in ((1 + 1e-9, "passed"), (1 - 1e-9, "failed") if now != old else (1, "passed")):
                    tolerance = {"relative": 1e-9, "absolute": abs(now - old) * part}
                    trials += [(one | {"within": tolerance, "baseline": "old.json"}, so)]
            yield Batch(documents[0], trials, {"old.json": documents[1]})


def roundings(results):
    """As (what puts a number into a document, the gate that reads it, its rounding)."""
    series = series_of(results)
    run = runs_of(results, series, "finest")[0]
    error = run["errors"]["temperature"]["all"]
    of = lambda document: runs_of(document, series, "finest")[0]  # noqa: E731

    def put_error(unit):
        return lambda document, number: of(document)["errors"]["temperature"]["all"].update(
            dict.fromkeys(NORMS, number * unit))  # fmt: skip

    for measure, keys, unit in (("error", {}, 1.0), ("error", {"relative": True}, error["scale"]["l2"]),
                                ("skill", {}, error["initial"]["l2"])):  # fmt: skip
        yield put_error(unit), gate(measure, series, **keys), error["round_off"] / unit
    energy = run["conservation"]["energy"]
    size = max(abs(energy[key]) for key in ("initial", "final", "exchanged"))
    for relative, unit in ((True, size), (False, 1.0)):
        yield (lambda document, number, unit=unit: of(document)["conservation"]["energy"].update(drift=number * unit),
               gate("conservation", series, resolution="finest", relative=relative), 64 * EPSILON * size / unit)  # fmt: skip
    wall = run["wall_flux"][1]
    most = max(abs(wall["measured"]), abs(wall["exact"]), wall["scale"])
    for relative, unit in ((True, wall["scale"]), (False, 1.0)):
        yield (lambda document, number, unit=unit: of(document)["wall_flux"][1].update(error=number * unit),
               gate("wall_flux", series, wall=1, relative=relative), 64 * EPSILON * most / unit)  # fmt: skip
    stability = run["stability"]
    yield (lambda document, number: of(document)["stability"].update(spectral_abscissa=number),
           gate("stability", series, resolution="finest"), stability["abscissa_uncertainty"])  # fmt: skip
    yield (lambda document, number: of(document)["stability"].update(spectral_radius=number),
           gate("stability", series, resolution="finest", quantity="spectral_radius"), 0.0)  # fmt: skip
    parts = [e["round_off"] / e[norm] for regions in run["errors"].values() for e in regions.values() for norm in NORMS]
    yield (lambda document, number: of(document)["integration"].update(time_error_share=number),
           gate("time_error", series, resolution="finest"), max(parts))  # fmt: skip
    ladder = runs_of(results, series)
    logs = [r["errors"]["temperature"]["all"]["round_off"] / r["errors"]["temperature"]["all"]["l2"] for r in ladder]
    spacings = [r["spacing"] for r in ladder]
    yield (lambda document, number: entry_of(series_of(document), "temperature", "all", "l2").update(
               order=number, interval=[number - 1, number + 1], verdict="asymptotic"),
           gate("order", series), 2 * max(logs) / math.log(max(spacings) / min(spacings)))  # fmt: skip


def all_ladders(results):
    return results


def runs_alone(results):
    """Of measures of runs, without what only ladders have."""
    kept = two_conductors(results)
    piston = [s for s in results["series"] if s["case"] == PISTON and s["formulation"] == SQRT_P]
    kept = only(results, [*kept["series"], *piston])
    for series in kept["series"]:
        series |= {"orders": [], "time_to_error": []}
    return kept


def two_conductors(results):
    return only(results, [s for s in results["series"] if s["case"] == SLAB and s["parameters"]["final_time"] == 0.01])


def one_ladder(results):
    return only(results, [series_of(results)])


def lattices(results):
    """With every partner; seeds of the two forms of conduction alone."""
    chosen = [s for s in results["series"] if s["discretisation"]["layout"] == "lattice" or s["case"] == SLAB]
    return only(results, [s for s in chosen if s["parameters"]["final_time"] != 0.02])


# Of each what it needs of the document, which is read for every batch.
BUILDERS = {
    "error": (error_batches, runs_alone),
    "time_error": (time_error_batches, runs_alone),
    "conservation": (conservation_batches, runs_alone),
    "wall_flux": (wall_flux_batches, runs_alone),
    "status": (status_batches, runs_alone),
    "stability": (stability_batches, runs_alone),
    "order": (order_batches, one_ladder),
    "time_to_error": (time_to_error_batches, lattices),
    "cost": (cost_batches, lattices),
    "select": (select_batches, all_ladders),
    "baseline": (baseline_batches, one_ladder),
    "rounding": (rounding_batches, one_ladder),
}

# The grammar.


def grammar(schema, path=""):
    """Every key and every word of a part of the schema, as (path of keys, word or None)."""
    if "$ref" in schema:
        schema = SCHEMA["$defs"][schema["$ref"].removeprefix("#/$defs/")] | {"$ref": None}
        schema.pop("$ref")
    for word in [*schema.get("enum", []), *([schema["const"]] if "const" in schema else [])]:
        yield path, word
    for word in (True, False) if schema.get("type") == "boolean" else ():
        yield path, word
    for key, part in schema.get("properties", {}).items():
        yield f"{path}.{key}", None
        yield from grammar(part, f"{path}.{key}")
    for part in [schema["items"]] if "items" in schema else []:
        yield path, list
        yield from grammar(part, path)
    for part in schema.get("oneOf", []):
        if set(part) - {"required", "not"}:
            yield from grammar(part, path)


def used(value, path=""):
    """What of the grammar a gate uses."""
    if isinstance(value, dict):
        for key, part in value.items():
            yield f"{path}.{key}", None
            yield from used(part, f"{path}.{key}")
    elif isinstance(value, list):
        yield path, list
        for part in value:
            yield from used(part, path)
    elif isinstance(value, (str, bool)):
        yield path, value


def prepared(results):
    """All runs ended well, and some mode grows in each, so that there is a number on either side."""
    for run in results["runs"]:
        run |= {"status": "ok", "reason": None}
        if run["stability"]:
            run["stability"]["growing_modes"] += 1
    return results


class GateLimits(ProgramTest):
    @classmethod
    def setUpClass(cls):
        helper = cls()
        ProgramTest.setUp(helper)
        try:
            study = helper.study(STUDY)
        finally:
            helper.doCleanups()
        whole = prepared(scrambled(study))
        cls.batches = {name: list(build(scope(whole))) for name, (build, scope) in BUILDERS.items()}

    def runTest(self):
        """Lets `setUpClass` make an instance."""

    def setUp(self):
        super().setUp()
        clean = {key: value for key, value in os.environ.items() if not key.startswith("GITHUB_")}
        patch = unittest.mock.patch.dict(os.environ, clean, clear=True)
        patch.start()
        self.addCleanup(patch.stop)

    def judge(self, batch):
        """All gates of a batch at once, one line each."""
        results = self.write("results.json", batch.results)
        for name, baseline in batch.baselines.items():
            self.write(name, baseline)
        gates = [one | {"name": f"gate {number}"} for number, (one, _) in enumerate(batch.trials)]
        document = {"schema": "sphverify-gates/1", "gates": gates, **batch.keys}
        result = self.run_program("gate", results, self.write("gates.json", document))
        self.assertEqual(result.stderr, "")
        lines = result.stdout.splitlines()
        wrong = []
        for number, (line, (one, verdict)) in enumerate(zip(lines, batch.trials)):
            self.assertEqual(line.split()[1:3], ["gate", str(number)])
            if line.split()[0] != verdict:
                wrong.append(f"{verdict} was meant: {line}\n  {json.dumps(one)}")
        self.assertEqual(wrong[:5], [], f"{len(wrong)} of {len(batch.trials)}")
        holds = all(verdict in HOLD for _, verdict in batch.trials)
        self.assertEqual(result.returncode, DONE if holds else GATE_FAILED)

    def judge_all(self, builder):
        for number, batch in enumerate(self.batches[builder]):
            with self.subTest(batch=number):
                self.judge(batch)

    def test_the_schema_takes_every_gate_of_these(self):
        for batch in (batches[0] for batches in self.batches.values()):
            # The last ones have the most keys; all of them take too long.
            gates = [one | {"name": f"gate {number}"} for number, (one, _) in enumerate(batch.trials[-8:])]
            document = {"schema": "sphverify-gates/1", "gates": gates, **batch.keys}
            self.assert_valid("sphverify-gates-1", document)

    def test_every_key_and_word_of_the_grammar_is_tried_on_both_sides(self):
        holds, fails, whole = set(), set(), set()
        for batch in itertools.chain(*self.batches.values()):
            whole |= {(f".{key}", None) for key in batch.keys}
            for one, verdict in batch.trials:
                words = {("" if path.startswith(".select") else one["measure"], path, word) for path, word in used(one)}
                (holds if verdict in HOLD else fails).update(words)
        measures = {part["$ref"].removeprefix("#/$defs/") for part in SCHEMA["properties"]["gates"]["items"]["oneOf"]}
        wanted = {("", ".select" + path, word) for path, word in grammar(SCHEMA["$defs"]["select"])}
        for measure in measures:
            for path, word in grammar(SCHEMA["$defs"][measure]):
                if not path.startswith(".select.") and path != ".name":
                    wanted.add((measure if path != ".select" else "", path, word))
        # Neither a measure nor what gives a reason or a note decides anything.
        counted = {(m, p, w) for m, p, w in wanted if p not in (".note", ".runs", ".at_least", ".reason")}
        self.assertEqual(counted - holds, set(), "words with which no gate holds here")
        self.assertEqual(counted - fails, set(), "words with which no gate fails here")
        tried = {path for _, path, _ in holds} & {path for _, path, _ in fails}
        self.assertEqual({path for _, path, _ in wanted - counted} - tried, {".note"} - tried)
        keys = {(f".{key}", None) for key in SCHEMA["properties"]}
        self.assertEqual(keys - whole, {(".schema", None), (".gates", None)}, "keys of the document")

    def test_every_verdict_and_measure_of_the_documentation_is_reached(self):
        text = (SOURCE_DIR / "docs" / "gates.md").read_text()
        first_column = lambda heading: set(  # noqa: E731
            re.findall(r"(?m)^\| `([a-z_-]+)` \|", text.split(f"\n## {heading}\n")[1].split("\n## ")[0]))  # fmt: skip
        batches = list(itertools.chain(*self.batches.values()))
        verdicts = {verdict for batch in batches for _, verdict in batch.trials}
        self.assertEqual(verdicts, first_column("Limits and verdicts"))
        measures = {one["measure"] for batch in batches for one, _ in batch.trials}
        self.assertEqual(measures, first_column("Measures"))


for name in BUILDERS:
    setattr(GateLimits, f"test_both_sides_of_{name}", lambda self, name=name: self.judge_all(name))


if __name__ == "__main__":
    unittest.main(verbosity=2)
