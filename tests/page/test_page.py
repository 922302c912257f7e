# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens the page of `sphverify report` in headless Chromium: what it draws, and whether one can use it."""

import base64
import copy
import functools
import json
import math
import pathlib
import re
import sys
import time
import unittest
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
import program  # noqa: E402
from browser import BrowserTest  # noqa: E402
from selenium import webdriver  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402
from test_tables import TablesTest  # noqa: E402, F401  runs with the rest

UNITS = {"s": 1.0, "ms": 1e-3, "µs": 1e-6}
MOST_BYTES = 3_000_000
HOSTILE = '</script><script>document.title = "caught"</script><!-- <img src=x onerror=alert(1)> {{data}} & "'

# Of every kind of plot something, runs that fail, two cases and two settings.
HEAT = {
    "schema": "sphverify-study/1",
    "name": "heat",
    "cases": ["conduction/slab-dirichlet", "conduction/slab-insulated"],
    "formulations": [
        "conduction/brookshaw",
        {"id": "conduction/brookshaw", "walls": "off"},
        "conduction/campbell-flux",
        {"id": "conduction/campbell-flux", "walls": "off"},
    ],
    "discretisation": {
        "smoothing_ratio": 1.0,
        "layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2, 3]}],
    },
    "resolution": [15, 25, 50],
    "smoothing_exponent": 0.5,
    "measure": ["error", "conservation", "cost", "stability", "profile", "history", "spectrum"],
}
GAS = {
    "schema": "sphverify-study/1",
    "name": "gas",
    "cases": ["hydro/piston-pressure"],
    "formulations": ["momentum/p-rho2", "momentum/sqrt-p", "conduction/brookshaw"],
    "discretisation": {"density": "normalised", "closure": ["interpolated", "one-sided"]},
    "resolution": [20, 40],
    "measure": ["error", "conservation", "cost", "profile", "history"],
}

# One form with everything that may stand for walls.
WALLED = {
    "schema": "sphverify-study/1",
    "name": "walled",
    "cases": ["conduction/slab-dirichlet"],
    "formulations": [{"id": "conduction/brookshaw", "walls": walls} for walls in ("on", "off", "mirror", "dummy")],
    "resolution": [10, 20, 40],
    "measure": ["error", "cost"],
}


RATES = {
    "schema": "sphverify-study/1",
    "name": "rates",
    "cases": ["operator/sine"],
    "formulations": ["momentum/p-rho2", "momentum/sqrt-p", "work/total-energy", "conduction/brookshaw"],
    "resolution": [20, 40],
}

# Operators that grow and that do not, two levels and replicates; a gas whose neighbours pair.
STABLE = {
    "schema": "sphverify-study/1",
    "name": "stable",
    "cases": ["conduction/slab-dirichlet"],
    "formulations": ["conduction/brookshaw", "conduction/campbell-flux"],
    "discretisation": {
        "smoothing_ratio": 1.0,
        "layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2]}],
    },
    "resolution": [8, 12],
    "measure": ["error", "stability", "stable-step", "second-law", "spectrum"],
}
RESTING = {
    "schema": "sphverify-study/1",
    "name": "resting",
    "cases": [{"id": "hydro/uniform", "parameters": {"boundary": "periodic", "final_time": 0.02}}],
    "formulations": ["momentum/p-rho2"],
    "discretisation": {
        "smoothing_ratio": 2.0,
        "layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2]}],
    },
    "resolution": [12, 24],
    "measure": ["error", "stability", "stable-step", "spectrum"],
}
DRIVEN = {
    "schema": "sphverify-study/1",
    "name": "driven",
    "cases": ["conduction/slab-dirichlet"],
    "formulations": ["conduction/brookshaw", "conduction/campbell-flux"],
    "resolution": [50],
    "measure": ["error", "stability"],
    "envelope": {"parameter": "smoothing_ratio", "from": 1.2, "to": 0.5, "bisections": 3},
}
TIMED = {
    "schema": "sphverify-study/1",
    "name": "timed",
    "cases": ["conduction/slab-dirichlet"],
    "formulations": ["conduction/brookshaw", "conduction/lucy-flux"],
    "resolution": [10, 20, 40],
    "measure": ["error", "cost"],
    "repeat": {"most": 8, "least": 6, "spread": 0.1, "seconds": 2},
}
# One ladder for each formulation, so that a card's numbers are this ladder's.
CARDS = {
    "schema": "sphverify-study/1",
    "name": "cards",
    "cases": ["conduction/slab-dirichlet"],
    "formulations": [
        {"id": "conduction/brookshaw", "walls": "off"},
        "conduction/lucy-flux",
        "conduction/brookshaw",
        {"id": "conduction/lucy-flux", "walls": "off"},
    ],
    "resolution": [10, 20, 40],
    "smoothing_exponent": 0.5,
    "measure": ["error", "conservation", "cost", "stability"],
}
LAYOUTS = {
    "schema": "sphverify-study/1",
    "name": "layouts",
    "cases": ["conduction/slab-dirichlet"],
    "formulations": ["conduction/brookshaw"],
    "discretisation": {
        "layout": [{"id": "clumped", "separation": 0.2}, {"id": "clumped", "separation": 0.4}],
        "smoothing_ratio": [1.2, 1.5],
    },
    "resolution": [12, 24],
    "smoothing_exponent": [0, 0.5],
    "measure": ["error"],
}
LAW = {"floor": 2e-3, "coefficient": 3e-3, "exponent": 1.5, "next_coefficient": 0.2, "next_exponent": 1.0}


def with_laws(document):
    """A law of brookshaw, a floor alone of lucy-flux; without wall terms nothing is known."""
    for series in document["series"]:
        for order in series["orders"]:
            order |= {"order": None, "interval": None, "model": None, "law": None, "floor": None, "targets": []}
            order |= {"verdict": "pre-asymptotic", "reason": "made up"}
        if series["walls"] == "off":
            continue
        entry = entry_of(series)
        if series["formulation"] == "conduction/brookshaw":
            entry |= {"order": 1.5, "interval": [1.2, 1.9], "model": "power on a floor", "law": LAW}
            entry["floor"] = {"value": 2e-3, "interval": [1e-3, 4e-3]}
            near = {"error": 0.01, "relative": 0.01, "N": 33.2, "remark": ""}
            entry["targets"] = [near, near | {"relative": 0.001, "N": None, "remark": "never: the floor is higher"}]
        else:
            entry |= {"model": "none", "floor": {"value": 3e-2, "interval": [2e-2, 4e-2]}}
    return document


def law_at(d, exponent=LAW["exponent"]):
    return LAW["floor"] + LAW["coefficient"] * d**exponent * (1 + LAW["next_coefficient"] * d)


SURFACE = {"floor": 1e-4, "smoothing_coefficient": 1e-3, "smoothing_exponent": 2.0, "sampling_coefficient": 2e-3}
SURFACE |= {"sampling_exponent": 3.0, "spacing_exponent": 0.5, "correlation": 0.0, "unit": 1 / 80, "sampling": []}
RATIOS, LEVELS = [1.0, 1.5, 2.25, 3.0], [20, 40, 80]


def surface_at(resolution, ratio):
    d = 80 / resolution
    smoothing = SURFACE["smoothing_coefficient"] * (ratio * d) ** SURFACE["smoothing_exponent"]
    sampling = SURFACE["sampling_coefficient"] * ratio ** -SURFACE["sampling_exponent"] * math.sqrt(d)
    return SURFACE["floor"] + math.hypot(smoothing, sampling)


def estimate(value, lower=None, upper=None):
    return {"value": value, "interval": None if lower is None else [lower, upper]}


def surfaces_of(document):
    """Of brookshaw one whose law is known, of lucy-flux one without a law in which a run failed, and a control."""
    cells = [
        {"resolution": n, "smoothing_ratio": r, "spacing": 1 / n, "particles": n, "replicates": 1}
        | {"error": 1.05 * surface_at(n, r), "spread": None, "fitted": surface_at(n, r)}
        | {"seconds": n * r * 1e-5, "pair_interactions": None}
        for n in LEVELS
        for r in RATIOS
    ]
    best = [
        {"resolution": n, "ratio": estimate(r, r / 1.1, 1.1 * r), "edge": edge, "error": surface_at(n, r)}
        | {"grid_ratio": measured, "grid_error": surface_at(n, measured)}
        for n, r, edge, measured in [(20, 1.0, "lower", 1.0), (40, 1.3, None, 1.5), (80, 1.7, None, 1.5)]
    ]
    path = {
        "unit": "seconds",
        "cost": {"coefficient": 1e-5, "resolution_exponent": 1.0, "ratio_exponent": 1.0, "misfit": 0.01},
        "points": [
            {"error": surface_at(n, r), "N": n, "ratio": estimate(r), "cost": n * r * 1e-5, "edge": None}
            for n, r in [(20, 1.0), (40, 1.25), (80, 1.6)]
        ],
        "grid_exponent": 0.3,
        "rules": [
            {"exponent": 0.5, "N": 80, "ratio": 2.0, "error": 0.004, "error_ratio": estimate(1.4, 1.2, 1.6)}
            | {"cost_ratio": estimate(1.8, 1.5, 2.1), "remark": None}
        ],
        "reason": None,
    }
    known = {"field": "temperature", "region": "all", "norm": "l2", "model": "smoothing and sampling"}
    known |= {"reason": "", "law": SURFACE, "misfit": 0.05, "smoothing_exponent": estimate(2, 1.9, 2.1)}
    known |= {"sampling_exponent": estimate(3, 2.5, 3.5), "spacing_exponent": estimate(0.5)}
    known |= {"neighbour_exponent": estimate(0.3, 0.25, 0.35), "best": best, "paths": [path]}
    known |= {"candidates": [], "cells": cells}
    unknown = copy.deepcopy(known) | {"model": None, "law": None, "reason": "no law comes near", "misfit": 0.8}
    unknown |= {f"{name}_exponent": estimate(None) for name in ["smoothing", "sampling", "spacing", "neighbour"]}
    for b in unknown["best"]:
        b |= {"ratio": estimate(None), "error": None, "edge": None, "grid_ratio": 1.5}
    unknown["paths"][0] |= {"points": [], "rules": [], "reason": "no law"}
    unknown["cells"][0]["error"] = None
    # What erred least lies elsewhere: within what the law is off by, and beyond it.
    elsewhere = copy.deepcopy(known)
    elsewhere["best"][0] |= {"grid_ratio": 3.0, "grid_error": surface_at(20, 3.0)}
    elsewhere["best"][2] |= {"grid_ratio": 1.0, "grid_error": surface_at(80, 1.0)}
    surfaces = []
    for label, error in [("brookshaw (walls off)", elsewhere), ("lucy-flux", unknown), ("brookshaw", known)]:
        series = next(s for s in document["series"] if name_of(s) == label)
        keys = ["case", "parameters", "formulation", "work", "conduction", "walls", "label"]
        discretisation = {k: v for k, v in series["discretisation"].items() if k != "smoothing_ratio"}
        surfaces.append({key: series[key] for key in keys} | {"discretisation": discretisation} | error)
    return surfaces


def name_of(series):
    return series["label"].split("/")[1]


def three_digits(value):
    """A number as the page writes it."""
    text = f"{float(format(value, '.3g')):g}"
    return text if 1e-4 <= abs(value) < 1e5 else f"{value:.1e}".replace("e-0", "e-").replace(".0e", "e")


def envelopes_of(document):
    """One envelope in the form of the results, which this study does not measure itself."""
    series = document["series"][0]
    run = document["runs"][series["runs"][0]]
    keys = ["case", "parameters", "formulation", "work", "conduction", "walls", "label", "discretisation"]
    held, failed = {"value": 0.1, "status": "ok"}, {"value": 0.3, "status": "unstable"}
    return [
        {key: run[key] for key in keys}
        | {"resolution": 50, "parameter": "discretisation.layout.amplitude", "scale": "linear", "held": 0.1}
        | {"failed": 0.3, "status": "unstable", "reason": "a mode grew", "points": [held, failed]}
    ]


def entry_of(series, field="temperature", region="all", norm="l2"):
    return next(o for o in series["orders"] if (o["field"], o["region"], o["norm"]) == (field, region, norm))


def set_times(document, times):
    """Puts [median, low, high] of each formulation in the place of its times to an error."""
    for series in document["series"]:
        for target in series["time_to_error"]:
            given = times.get((series["formulation"], target["relative"]))
            median, low, high = given or (None, None, None)
            target |= {"seconds": median, "median_seconds": median, "low_seconds": low, "high_seconds": high}
            target["is_bound"] = False
    return document


def seed_of(run):
    layout = run["discretisation"]["layout"]
    return str(layout["seed"]) if isinstance(layout, dict) else "–"


def seconds_text(value):
    """As the page writes it: three digits and a unit, of the five that the page's data have."""
    if value is None:
        return "–"
    value = float(f"{value:.5g}")
    scale, unit = (1, "s") if value >= 1 else (1e3, "ms") if value >= 1e-3 else (1e6, "µs")
    return f"{float(format(value * scale * (1 + 1e-12), '.3g')):g} {unit}"  # half a digit goes up


class PageTest(BrowserTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        maker = cls.maker
        cls.heat = maker.study(HEAT, "heat.json")
        cls.gas = maker.study(GAS, "gas.json")
        odd = program.mutated(cls.heat, ("study", "name"), HOSTILE)
        odd["envelopes"] = envelopes_of(odd)
        odd["study"]["envelope"] = {"parameter": "layout.amplitude", "from": 0.05, "to": 0.3, "bisections": 0}
        odd["runs"][0]["status"], odd["runs"][0]["reason"] = "unstable", HOSTILE
        maker.write("odd.json", odd)
        maker.succeed("report", cls.place / "heat.json", "-o", cls.place / "heat.html")
        maker.succeed("report", cls.place / "odd.json", "-o", cls.place / "odd.html")
        timed = [run for run in odd["runs"] if run["cost"]]
        for name, least in (("quiet", 1.0), ("disturbed", 0.5)):
            for run in timed:
                run["cost"]["busy"] = 1.0
            timed[-1]["cost"]["busy"] = least
            maker.write(f"{name}.json", odd)
            maker.succeed("report", cls.place / f"{name}.json", "-o", cls.place / f"{name}.html")
        # On the lattice 1% comes sooner, on disordered particles 0.1%.
        settings = copy.deepcopy(cls.heat)
        for series in settings["series"]:
            is_lattice = series["discretisation"]["layout"] == "lattice"
            for target in series["time_to_error"]:
                seconds = 1 if (target["relative"] == 0.01) == is_lattice else 2
                never = series["label"] != "conduction/brookshaw"
                target |= {"seconds": None if never else seconds, "median_seconds": None if never else seconds}
                target |= {"low_seconds": None, "high_seconds": None, "is_bound": False}
        maker.write("settings.json", settings)
        maker.succeed("report", cls.place / "settings.json", "-o", cls.place / "settings.html")
        maker.study(WALLED, "walled.json")
        maker.succeed("report", cls.place / "walled.json", "-o", cls.place / "walled.html")
        maker.study(RATES, "rates.json")
        maker.succeed("report", cls.place / "rates.json", "-o", cls.place / "rates.html")
        cls.stable = maker.study(STABLE, "stable.json")
        maker.succeed("report", cls.place / "stable.json", "-o", cls.place / "stable.html")
        cls.unknown = unknown = copy.deepcopy(cls.stable)
        for run in unknown["runs"]:
            if run["label"] == "conduction/brookshaw" or run["discretisation"]["layout"] == "lattice":
                run["stability"] |= {"growing_modes": None, "worst_mode": None, "remark": "too many unknowns"}
        for run in unknown["runs"]:
            if run["label"] == "conduction/campbell-flux" and run["stability"]["growing_modes"]:
                run["stability"]["growing_modes"] = None
        maker.write("unknown.json", unknown)
        maker.succeed("report", cls.place / "unknown.json", "-o", cls.place / "unknown.html")
        cls.resting = maker.study(RESTING, "resting.json")
        maker.succeed("report", cls.place / "resting.json", "-o", cls.place / "resting.html")
        cls.driven = maker.study(DRIVEN, "driven.json")
        maker.succeed("report", cls.place / "driven.json", "-o", cls.place / "driven.html")
        cls.timed = maker.study(TIMED, "timed.json")
        maker.succeed("report", cls.place / "timed.json", "-o", cls.place / "timed.html")
        brookshaw, lucy = TIMED["formulations"]
        given = {(brookshaw, 0.01): (0.010, 0.009, 0.011), (lucy, 0.01): (0.0105, 0.0099, 0.012)}
        given |= {(brookshaw, 0.001): (0.1, 0.09, 0.11), (lucy, 0.001): (0.3, 0.297, 0.306)}
        maker.write("given.json", set_times(copy.deepcopy(cls.timed), given))
        maker.succeed("report", cls.place / "given.json", "-o", cls.place / "given.html")
        cls.cards = maker.study(CARDS, "cards.json")
        # Were they not controls, forms without wall terms would be soonest.
        soon = copy.deepcopy(cls.cards)
        for series in soon["series"]:
            for target in series["time_to_error"]:
                slow = 2e-3 if series["formulation"] == "conduction/brookshaw" else 3e-3
                seconds = 1e-3 if series["walls"] == "off" else slow
                target |= {"seconds": seconds, "median_seconds": seconds, "low_seconds": None, "high_seconds": None}
                target["is_bound"] = False
            if series["walls"] == "off":
                for level in entry_of(series)["levels"]:
                    level["error"] *= 1e-6
        maker.write("soon.json", soon)
        # Further off than an answer of 0, and never near.
        useless = copy.deepcopy(cls.cards)
        for series in useless["series"]:
            far = 5 * useless["runs"][series["runs"][-1]]["errors"]["temperature"]["all"]["scale"]["l2"]
            for level in entry_of(series)["levels"]:
                level["error"] = far if series["formulation"] == "conduction/brookshaw" else 2 * far
            for target in series["time_to_error"]:
                target |= {"seconds": None, "median_seconds": None, "low_seconds": None, "high_seconds": None}
        maker.write("useless.json", useless)
        near = copy.deepcopy(useless)  # untimed and within a tenth of each other
        for series in near["series"]:
            for level in entry_of(series)["levels"]:
                level["error"] *= 1e-3 * (1 if series["formulation"] == "conduction/brookshaw" else 0.5 * 1.05)
        maker.write("near.json", near)
        # The formulation that the verdict takes was below 1% on its coarsest level already, which took longer than
        # the other needed in all.
        verdict = json.loads(maker.succeed("compare", cls.place / "cards.json", "--format", "json"))["summary"][0]
        cls.taken = verdict["formulations"][0]["name"]
        bound = copy.deepcopy(cls.cards)
        for series in bound["series"]:
            is_taken = name_of(series) == cls.taken
            for target in series["time_to_error"]:
                seconds = 3e-3 if is_taken else 1e-3
                target |= {"seconds": seconds, "median_seconds": seconds, "low_seconds": None, "high_seconds": None}
                target["is_bound"] = is_taken
        maker.write("bound.json", bound)
        later = copy.deepcopy(bound)  # the same without a bound: the other is soonest beyond doubt
        for series in later["series"]:
            for target in series["time_to_error"]:
                target["is_bound"] = False
        maker.write("later.json", later)
        cls.laws = with_laws(copy.deepcopy(cls.cards))
        maker.write("laws.json", cls.laws)
        cls.scale = cls.laws["runs"][0]["errors"]["temperature"]["all"]["scale"]["l2"]
        old = copy.deepcopy(cls.cards)
        for series in old["series"]:
            for order in series["orders"]:
                for key in ["model", "law", "floor", "targets"]:
                    del order[key]
        maker.write("old.json", old)
        maker.study(LAYOUTS, "layouts.json")
        maker.write("surface.json", cls.cards | {"surfaces": surfaces_of(cls.cards)})
        for name in ["cards", "soon", "bound", "later", "useless", "near", "laws", "old", "layouts", "surface"]:
            maker.succeed("report", cls.place / f"{name}.json", "-o", cls.place / f"{name}.html")
        both = [cls.place / "heat.json", cls.place / "gas.json"]
        maker.succeed("report", *both, "-o", cls.place / "both.html")
        cls.start_browser()

    def setUp(self):
        super().setUp()
        self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": []})

    def count(self, section, marks):
        """Marks of a section's plots, by a selector within them."""
        return len(self.all(f"section.{section} figure svg {marks}"))

    def cells(self, title, column):
        """The texts of a column of a table."""
        rows = "div[aria-label='%s'] table" % title
        heads = [head.get_attribute("textContent") for head in self.all(f"{rows} thead th")]
        k = heads.index(column) + 1
        cells = self.all(f"{rows} tbody tr:not(.group) > :nth-child({k})")
        return [cell.get_attribute("textContent") for cell in cells]

    def test_asks_no_network_and_says_nothing_on_the_console(self):
        for name in ["heat.html", "both.html", "odd.html", "stable.html", "resting.html", "timed.html"]:
            with self.subTest(name):
                self.open(name)
                log = self.driver.get_log("performance")
                messages = [json.loads(entry["message"])["message"] for entry in log]
                asked = [
                    message["params"]["request"]["url"]
                    for message in messages
                    if message["method"] == "Network.requestWillBeSent"
                ]
                outside = [url for url in asked if not url.startswith(("file:", "data:", "blob:"))]
                self.assertEqual(outside, [])
                self.assertEqual(len([url for url in asked if url.startswith("file:")]), 1)
                self.assert_silent()
                self.assertLess((self.place / name).stat().st_size, MOST_BYTES)

    def test_draws_every_level_and_every_failure(self):
        self.open("heat.html")
        drawn = failed = 0
        for series in self.heat["series"]:
            if series["case"] != "conduction/slab-dirichlet":
                continue
            drawn += sum(level["error"] is not None for level in entry_of(series)["levels"])
            broken = {
                self.heat["runs"][run]["resolution"]
                for run in series["runs"]
                if self.heat["runs"][run]["status"] != "ok"
            }
            failed += len(broken)
        self.assertGreater(failed, 0)
        dots = "g[aria-label=dot]:not([aria-description=failed])"
        circles = self.count("convergence", f"{dots} circle")
        self.assertEqual(circles + self.count("convergence", f"{dots} path"), drawn)
        self.assertEqual(self.count("convergence", "g[aria-description=failed] path"), failed)
        self.assertEqual(self.count("convergence", "g[aria-description='reference slope'] path"), 4)
        spread = [
            level
            for series in self.heat["series"]
            if series["case"] == "conduction/slab-dirichlet"
            for level in entry_of(series)["levels"]
            if level["spread"] and level["error"] is not None
        ]
        bars = self.count("convergence", "g[aria-description='spread of replicates'] line")
        self.assertEqual(bars, len(spread))

    def test_draws_the_other_plots(self):
        self.open("heat.html")
        panels_of = {"convergence": 2, "cost": 1, "history": 2, "profile": 2, "spectrum": 2}
        for section, panels in panels_of.items():
            with self.subTest(section):
                self.assertEqual(len(self.all(f"section.{section} figure")), panels)
        self.assertEqual(self.count("cost", "g[aria-description='Pareto front'] path"), 1)
        self.assertEqual(self.count("profile", "g[aria-description=exact] path"), 2)
        # The histories are lines, one of each ladder that kept one.
        kept = {
            (run["label"], str(run["discretisation"]["layout"])[:5])
            for run in self.heat["runs"]
            if "history" in run and run["case"] == "conduction/slab-dirichlet"
        }
        self.assertEqual(self.count("history", "g[aria-label=line] path"), len(kept))
        # Of each ladder one replicate; what grows in it is what the document counts.
        counted = 0
        for series in self.heat["series"]:
            if series["case"] != "conduction/slab-dirichlet":
                continue
            runs = [self.heat["runs"][run] for run in series["runs"]]
            finest = [run for run in runs if run["resolution"] == 50 and "spectrum" in run]
            most = max(finest, key=lambda run: max(real for real, _ in run["spectrum"]))
            counted += most["stability"]["growing_modes"]
        self.assertGreater(counted, 0)
        self.assertEqual(self.count("spectrum", "g[aria-description='growing mode'] path"), counted)
        self.assertEqual(self.all("section.envelope"), [])
        self.open("odd.html")
        self.assertEqual(self.count("envelope", "g[aria-description=failed] path"), 1)
        self.assertEqual(self.count("envelope", "g[aria-description=held] line"), 1)

    def test_a_number_of_growing_modes_that_is_not_known_is_not_made_up(self):
        self.open("unknown.html")
        captions = [node.text for node in self.all("section.spectrum figcaption")]
        self.assertTrue(any("the document does not say what grows" in text for text in captions), captions)
        # A worst mode without a number of those that grow: it alone is known to.
        self.assertEqual(self.count("spectrum", "g[aria-description='growing mode'] path"), 1)

    def test_run_times_are_titled_with_the_region_of_their_errors(self):
        self.open("heat.html")
        for region in ("all", "wall"):
            self.choose("region", region)
            self.assertIn(f"region {region}", self.one("section.cost figcaption").text)
            self.assertEqual(set(self.cells("Ladders", "region")), {region})

    def test_warns_of_disturbed_timings(self):
        self.open("disturbed.html")
        for section in ("summary", "cost"):
            self.assertIn("Disturbed timings: 1 of ", self.one(f"section.{section} .disturbed").text)
        self.open("quiet.html")
        self.assertEqual(self.all(".disturbed"), [])

    def test_the_verdict_names_the_setting_of_each_number_and_fits_the_page(self):
        self.open("settings.html")
        settings = self.cells("Verdict on conduction/slab-dirichlet", "setting")
        self.assertTrue(all(settings), settings)
        self.assertRegex(settings[0], r"^1%(, smallest error)?: lattice0\.1%(, smallest error)?: jitter 0\.1$")
        for table in self.all(".verdict .scroll"):
            self.assertLessEqual(*(int(table.get_property(key)) for key in ("scrollWidth", "clientWidth")))

    def test_draws_how_far_a_parameter_was_driven_down(self):
        self.open("driven.html")
        self.assertIn("see Stability envelope", self.one("section.summary").text)
        held = {e["label"]: e["held"] for e in self.driven["envelopes"]}
        self.assertEqual(held["conduction/brookshaw"], 0.5)
        self.assertGreater(held["conduction/campbell-flux"], 0.5)
        ends = [
            self.script("return [arguments[0].x1.baseVal.value, arguments[0].x2.baseVal.value]", line)
            for line in self.all("section.envelope figure svg g[aria-description=held] line")
        ]
        # Bars start together, where the study does, and go down as far as each held.
        self.assertEqual(len({start for start, _ in ends}), 1)
        lengths = sorted(start - end for start, end in ends)
        self.assertGreater(lengths[0], 0)
        reach = [1.2 - held["conduction/campbell-flux"], 1.2 - 0.5]
        self.assertAlmostEqual(lengths[0] / lengths[1], reach[0] / reach[1], places=6)
        broken = {run["label"] for run in self.driven["runs"] if run["status"] != "ok"}
        listed = {cell.text for cell in self.all("section.failures tbody tr > :nth-child(1)")}
        self.assertEqual(listed, broken)

    def test_the_verdict_follows_from_the_numbers(self):
        self.open("heat.html")
        best = {}
        for series in self.heat["series"]:
            if series["case"] != "conduction/slab-dirichlet":
                continue
            runs = [self.heat["runs"][run] for run in series["runs"]]
            finest = [run for run in runs if run["resolution"] == 50]
            for target in series["time_to_error"]:
                wanted = (target["field"], target["region"], target["norm"], target["relative"])
                if wanted != ("temperature", "all", "l2", 0.01) or target["seconds"] is None:
                    continue
                if any(run["status"] != "ok" for run in finest) or entry_of(series)["verdict"] == "diverging":
                    continue
                name = series["label"].split("/")[1]
                best[name] = min(best.get(name, float("inf")), target["median_seconds"])
        rows = "section.summary article.verdict:not(.across)"
        card = self.all(rows)[0]
        names = lambda body: [  # noqa: E731
            head.get_attribute("textContent") for head in card.find_elements(By.CSS_SELECTOR, f"{body} th[scope=row]")
        ]
        ranked = names("tbody:not(.controls)")
        best = {name: seconds for name, seconds in best.items() if not name.endswith("(walls off)")}
        self.assertEqual(ranked[: len(best)], sorted(best, key=best.get))
        self.assertEqual(sorted(ranked), ["brookshaw", "campbell-flux"])
        self.assertEqual(sorted(names("tbody.controls")), [f"{name} (walls off)" for name in sorted(ranked)])
        sentences = card.find_element(By.CSS_SELECTOR, ".sentences").text
        self.assertIn(ranked[0], sentences.split("\n")[0])
        self.assertRegex(sentences, r"For comparison only\. .*campbell-flux \(walls off\): .*fails on 2 of 2 ladders")
        self.assertEqual(len(card.find_elements(By.CSS_SELECTOR, "tr.failed")), 1)

    def card_sentences(self):
        card = self.all("section.summary article.verdict:not(.across)")[0]
        return card.find_element(By.CSS_SELECTOR, ".sentences").text.split("\n")

    def test_controls_never_win_a_headline(self):
        self.open("soon.html")
        first = self.one("section.summary article.across .sentences li").text
        self.assertRegex(first, "^(brookshaw|lucy-flux): smallest error")
        lines = self.card_sentences()
        self.assertRegex(lines[0], r"^Soonest to 1%: brookshaw, 2 ms ")
        self.assertEqual([line for line in lines if "walls off" in line], [lines[-1]])
        self.assertTrue(lines[-1].startswith("For comparison only. "), lines[-1])
        self.assertEqual(self.verdict_cells("times the soonest"), ["1", "1.50", "0.50", "0.50"])
        body = "article.verdict:not(.across) tbody.controls th[scope=row]"
        controls = sorted(head.get_attribute("textContent") for head in self.all(body))
        self.assertEqual(controls, ["brookshaw (walls off)", "lucy-flux (walls off)"])

    def test_where_bounds_leave_open_who_is_soonest_the_card_takes_whom_the_verdict_takes(self):
        self.open("bound.html")
        across = self.one("section.summary article.across .sentences li").text
        self.assertTrue(across.startswith(f"{self.taken}: "), across)
        lines = self.card_sentences()
        self.assertTrue(lines[0].startswith(f"Soonest to 1%, as far as can be told: {self.taken}, at most 3 ms"), lines)
        (other,) = {"brookshaw", "lucy-flux"} - {self.taken}
        self.assertTrue(any(line.startswith(f"Perhaps as soon or sooner: {other} (1 ms)") for line in lines), lines)
        self.assertEqual(self.verdict_cells("formulation")[:2], [self.taken, other])

    def test_a_card_sets_none_before_another_that_is_within_a_tenth(self):
        self.open("near.html")
        lines = self.card_sentences()
        self.assertTrue(lines[0].startswith("Smallest error, but for a tenth: brookshaw, "), lines)
        self.assertIn("As near, within a tenth: lucy-flux.", lines)
        card = self.all("section.summary article.verdict:not(.across)")[0]
        self.assertNotIn("good", card.find_element(By.CSS_SELECTOR, ".sentences li").get_attribute("class"))

    def test_a_card_that_takes_another_than_the_verdict_says_whom_that_takes(self):
        taken_else = "The verdict goes by failures, then by error over all cases, and takes"
        self.open("soon.html")
        first = self.one("section.summary article.across .sentences li").text.split(":")[0]
        lines = [line for line in self.card_sentences() if line.startswith(taken_else)]
        self.assertEqual(len(lines), 0 if first == "brookshaw" else 1, lines)
        self.open("bound.html")
        self.assertFalse(any(line.startswith(taken_else) for line in self.card_sentences()))
        self.open("later.html")
        (other,) = {"brookshaw", "lucy-flux"} - {self.taken}
        lines = self.card_sentences()
        self.assertTrue(lines[0].startswith(f"Soonest to 1%: {other}, "), lines)
        self.assertEqual([line.split("takes ")[1].split(" (")[0] for line in lines if line.startswith(taken_else)], [self.taken])
        self.open("settings.html")
        across = self.one("section.summary article.across .sentences li").text.split(":")[0]
        lines = [line for line in self.card_sentences() if line.startswith(taken_else)]
        self.assertTrue(all(f"takes {across} (" in line for line in lines), lines)

    def test_opens_with_one_verdict_across_cases(self):
        for name in ["heat", "cards"]:
            self.open(f"{name}.html")
            text = self.succeed("compare", self.place / f"{name}.json", "--format", "json")
            group = json.loads(text)["summary"][0]
            rows = group["formulations"]
            article = self.one("section.summary > article:first-of-type")
            self.assertEqual(article.get_attribute("class"), "verdict across")
            self.assertEqual(self.one("section.part:first-of-type").get_attribute("id"), "document-1-summary")
            title = article.find_element(By.CSS_SELECTOR, "h4").text
            cases = len({scene["case"] for scene in group["scenes"]})
            self.assertTrue(title.startswith(f"Across {cases} cases" if cases > 1 else "On slab-dirichlet, lattice:"))
            lines = [line.text for line in article.find_elements(By.CSS_SELECTOR, ".sentences li")]
            self.assertEqual(lines, group["sentences"])
            cells = functools.cache(lambda column, title=title: self.cells(title, column))
            self.assertEqual(cells("formulation"), [row["name"] for row in rows])
            controls = article.find_elements(By.CSS_SELECTOR, ".controls th[scope=row]")
            self.assertEqual([c.text for c in controls], [row["name"] for row in rows if row["control"]])
            self.assertTrue(all("walls off" in control.text for control in controls))
            many = len(group["scenes"]) > 1
            for k, row in enumerate(rows):
                error = cells("mean error" if many else "error")[k]
                if row["error"] is not None:
                    self.assertAlmostEqual(float(error[:-1]) / row["error"], 100, delta=5.1)
                order = cells("order [95%]")[k]
                if row["order"] is None:
                    self.assertEqual(order, "not known")
                else:
                    ends = [f"{row[key]:.2f}".replace("-0.00", "0.00") for key in ["order", "order_low", "order_high"]]
                    self.assertEqual(order, f"{ends[0]} [{ends[1]}, {ends[2]}]")
                flux = cells("wall flux error")[k]
                if row["wall_flux_error"] is None:
                    self.assertEqual(flux, "not known")
                else:
                    self.assertAlmostEqual(float(flux[:-1]) / row["wall_flux_error"], 100, delta=5.1)
                drift, made = row["energy_pair_drift"], cells("energy made by pairs")[k]
                if drift:
                    self.assertAlmostEqual(float(made[:-1]) / drift, 100, delta=5.1)
                else:
                    self.assertEqual(made, "not known" if drift is None else "rounding")
                growing = cells("growing modes")[k]
                known = row["growing_modes"] is not None
                self.assertEqual(growing, f"{row['growing_modes']:g}" if known else "not known")
                fail = row["failed"] + row["missing"]
                self.assertEqual(cells("fail")[k], f"{fail} of {row['scenes']}" if many and fail else str(fail))
                self.assertIn(f"density {row['density']}", cells("setting")[k])
                self.assertIn(f"h/dx {float(row['smoothing_ratio']):g} (N/", cells("setting")[k])
                seconds = row["seconds_to_1_percent"]
                if seconds is not None:
                    shown, unit = cells("1% after")[k].split()[-2:]
                    self.assertAlmostEqual(float(shown) * UNITS[unit] / seconds, 1, delta=0.006)
                    self.assertEqual("≤" in cells("1% after")[k], row["seconds_are_bound"])
            scroll = article.find_element(By.CSS_SELECTOR, ".scroll")
            self.assertLessEqual(*(int(scroll.get_property(key)) for key in ("scrollWidth", "clientWidth")))
            self.assert_silent()
        # One case, one layout, one setting: the error is this ladder's.
        for series in self.cards["series"]:
            run = self.cards["runs"][series["runs"][-1]]
            error = entry_of(series)["levels"][-1]["error"] / run["errors"]["temperature"]["all"]["scale"]["l2"]
            shown = cells("error")[cells("formulation").index(name_of(series))]
            self.assertAlmostEqual(float(shown[:-1]) / error, 100, delta=5.1)

    def test_errors_larger_than_the_field_are_no_merit(self):
        self.open("useless.html")
        lines = self.card_sentences()
        self.assertTrue(lines[0].startswith("None comes near; smallest error: brookshaw, 500% "), lines[0])
        across = self.one("section.summary article.across .sentences li").text
        self.assertTrue(across.startswith("None comes near. brookshaw: "), across)
        self.assertEqual(self.all("article.verdict .sentences .good"), [])

    def test_cards_say_wall_flux_conservation_and_stability(self):
        self.open("cards.html")
        names = self.verdict_cells("formulation")
        self.assertEqual(sorted(names), sorted(map(name_of, self.cards["series"])))
        kept = 0
        for k, name in enumerate(names):
            series = next(s for s in self.cards["series"] if name_of(s) == name)
            run = max((self.cards["runs"][i] for i in series["runs"]), key=lambda r: r["resolution"])
            cell = lambda column: self.verdict_cells(column)[k]  # noqa: E731, B023
            flux = max(abs(w["error"]) / w["scale"] for w in run["wall_flux"])
            self.assertAlmostEqual(float(cell("wall flux error")[:-1]) / flux, 100, delta=5)
            energy = run["conservation"]["energy"]
            drift = abs(energy["drift"]) / max(abs(energy["initial"]), abs(energy["final"]))
            shown = cell("energy drift")
            kept += shown == "rounding"
            if shown == "rounding":
                self.assertLess(drift, 1e-12)
            else:
                self.assertEqual(shown, three_digits(drift))
            self.assertEqual(cell("growing modes"), str(run["stability"]["growing_modes"]))
            error = entry_of(series)["levels"][-1]["error"] / run["errors"]["temperature"]["all"]["scale"]["l2"]
            self.assertAlmostEqual(float(cell("smallest error")[:-1]) / error, 100, delta=5)
        self.assertLess(kept, len(names))
        # What stands first is said of, too.
        beside = next(line for line in self.card_sentences() if line.startswith(f"{names[0]} there: "))
        self.assertIn(f"wall flux off by {self.verdict_cells('wall flux error')[0]}", beside)
        self.assertIn("energy kept", beside)
        self.assertIn("no mode grows", beside)
        self.assert_silent()

    def scales_of(self, section, points):
        """Pixels over logarithms of both axes, from dots of a section's first plot whose values are known."""
        text = "return [...document.querySelectorAll(arguments[0])].map(e => e.transform.baseVal.length ?"
        text += "[e.transform.baseVal[0].matrix.e, e.transform.baseVal[0].matrix.f] :"
        text += "[e.cx.baseVal.value, e.cy.baseVal.value])"
        places = self.script(text, f"section.{section} figure:first-child g[aria-label=dot] :is(circle, path)")
        self.assertEqual(len(places), len(points))
        # The higher the value, the smaller its pixel.
        scales = []
        for axis, sign in [(0, 1), (1, -1)]:
            values = sorted(math.log(point[axis]) for point in points)
            pixels = sorted((place[axis] for place in places), reverse=sign < 0)
            slope = (pixels[-1] - pixels[0]) / (values[-1] - values[0])
            scales.append(lambda v, a=pixels[0], b=slope, c=values[0]: a + b * (math.log(v) - c))
            for value, pixel in zip(values, pixels):
                self.assertAlmostEqual(scales[-1](math.exp(value)), pixel, delta=0.5)
        return scales

    def path_points(self, section, description):
        paths = self.all(f"section.{section} figure:first-child g[aria-description='{description}'] path")
        self.assertEqual(len(paths), 1, description)
        numbers = re.findall(r"-?[0-9.]+", paths[0].get_attribute("d"))
        return list(zip(map(float, numbers[::2]), map(float, numbers[1::2])))

    def test_draws_the_fitted_law_the_floor_and_the_interval_of_the_order(self):
        self.open("laws.html")
        levels = [
            (level["resolution"], level["error"] / self.scale)
            for series in self.laws["series"]
            for level in entry_of(series)["levels"]
        ]
        x, y = self.scales_of("convergence", levels)
        curve = self.path_points("convergence", "fitted law")
        self.assertGreater(len(curve), 20)
        self.assertAlmostEqual(curve[0][0], x(10), delta=0.5)
        self.assertAlmostEqual(curve[-1][0], x(80), delta=0.5)
        for n in [10, 20, 40, 80]:
            nearest = min(curve, key=lambda p: abs(p[0] - x(n)))
            self.assertAlmostEqual(nearest[1], y(law_at(40 / n) / self.scale), delta=4, msg=n)
        self.assertAlmostEqual(curve[0][1], y(law_at(4) / self.scale), delta=0.6)
        self.assertAlmostEqual(curve[-1][1], y(law_at(0.5) / self.scale), delta=0.6)
        # From the finest level on, between the ends of the interval.
        fan = self.path_points("convergence", "interval of the order")
        self.assertAlmostEqual(min(p[0] for p in fan), x(40), delta=0.5)
        ends = sorted(p[1] for p in fan if p[0] > x(80) - 0.5)
        for pixel, exponent in [(ends[0], 1.2), (ends[-1], 1.9)]:
            self.assertAlmostEqual(pixel, y(law_at(0.5, exponent) / self.scale), delta=0.6)
        floors = sorted(self.marks("convergence", "floor", "line", "y1"))
        self.assertEqual(len(floors), 2)
        for pixel, value in zip(floors, [3e-2, 2e-3]):
            self.assertAlmostEqual(pixel, y(value / self.scale), delta=0.6)
        bands = sorted(zip(*(self.marks("convergence", "interval of the floor", "rect", k) for k in ("y", "height"))))
        for (top, height), (low, high) in zip(bands, [(2e-2, 4e-2), (1e-3, 4e-3)], strict=True):
            self.assertAlmostEqual(top, y(high / self.scale), delta=0.6)
            self.assertAlmostEqual(top + height, y(low / self.scale), delta=0.6)
        hint = self.one("section.convergence .hint").text
        for word in ["law", "Fans", "floor"]:
            self.assertIn(word, hint)
        # Older documents have no laws.
        self.open("old.html")
        self.assertGreater(self.count("convergence", "circle"), 0)
        for mark in ["fitted law", "floor", "interval of the floor"]:
            self.assertEqual(self.all(f"g[aria-description='{mark}'] > *"), [])
        self.assert_silent()

    def test_hover_texts_and_tables_say_model_floor_and_where_one_percent_is_reached(self):
        self.open("laws.html")
        self.assertEqual(self.cells("Ladders", "formulation"), [name_of(s) for s in self.laws["series"]])
        over = lambda v: f"{float(format(100 * v / self.scale, '.2g')):g}%"  # noqa: E731
        floor = f"{over(2e-3)} [{over(1e-3)}, {over(4e-3)}]"
        other = f"{over(3e-2)} [{over(2e-2)}, {over(4e-2)}]"
        for column, texts in {
            "model": ["–", "none", "power on a floor", "–"],
            "floor [95%]": ["not known", other, floor, "not known"],
            "N to 1%": ["not known", "not known", "N = 34", "not known"],
            "N to 0.1%": ["not known", "not known", "never: the floor is higher", "not known"],
            "because": ["made up"] * 4,
        }.items():
            self.assertEqual(self.cells("Ladders", column), texts, column)
        dots = self.all("section.convergence figure:first-child g[aria-label=dot] :is(circle, path)")
        self.script("arguments[0].scrollIntoView({block: 'center'})", dots[0])
        tips = set()
        for dot in dots:
            webdriver.ActionChains(self.driver).move_to_element(dot).perform()
            tip = self.all("section.convergence figure:first-child g[aria-label=tip] text")
            # Lines are told apart by spaces without width.
            tips |= {node.get_attribute("textContent").replace("\u200b", " ") for node in tip}
        law = [tip for tip in tips if "power on a floor" in tip]
        self.assertTrue(law, tips)
        self.assertTrue(all(floor in tip and "1%: N = 34" in tip for tip in law), law)
        self.assertTrue(all("1.50 [1.20, 1.90]" in tip for tip in law), law)

    def test_draws_the_error_surface_with_its_best_path(self):
        self.open("surface.html")
        captions = [node.text for node in self.all("section.surface figcaption")]
        self.assertEqual(captions, ["lucy-flux", "brookshaw", "brookshaw (walls off)"])  # controls last
        figure = "section.surface figure:nth-child(2)"
        # Pixels of both axes, from the best h/dx at each N.
        place = "const [dot] = [arguments[0]]; return [dot.cx.baseVal.value, dot.cy.baseVal.value]"
        dots = self.all(f"{figure} g[aria-description='best h/dx'] circle")
        places = [self.script(place, dot) for dot in dots]
        known = [(20, 1.0), (40, 1.3), (80, 1.7)]
        self.assertEqual(len(places), len(known))
        scales = []
        for axis in (0, 1):
            a, b = places[0][axis], places[-1][axis]
            c, d = math.log(known[0][axis]), math.log(known[-1][axis])
            slope = (b - a) / (d - c)
            scales.append(lambda v, a=a, c=c, s=slope: a + (math.log(v) - c) * s)
            scales.append(lambda p, a=a, c=c, s=slope: math.exp(c + (p - a) / s))
        x, n_at, y, ratio_at = scales
        self.assertAlmostEqual(places[1][0], x(40), delta=0.1)
        self.assertAlmostEqual(places[1][1], y(1.3), delta=0.1)
        points = lambda path: [  # noqa: E731
            tuple(map(float, pair)) for pair in re.findall(r"(-?[0-9.]+),(-?[0-9.]+)", path.get_attribute("d"))
        ]
        # On a contour the law is one of 1, 2, 5 times a power of ten.
        contours = [points(p) for p in self.all(f"{figure} g[aria-description='contours of the law'] path")]
        self.assertGreater(len(contours), 2)
        for contour in contours:
            errors = [surface_at(n_at(px), ratio_at(py)) / self.scale for px, py in contour]
            middle = sorted(errors)[len(errors) // 2]
            mantissa = middle / 10 ** math.floor(math.log10(middle) + 1e-3)
            self.assertLess(min(abs(mantissa / m - 1) for m in (1, 2, 5, 10)), 0.01)
            self.assertLess(max(errors) / min(errors), 1.03)
        numbers = self.all(f"{figure} g[aria-description='contour label'] text")
        labels = {node.get_attribute("textContent") for node in numbers}
        self.assertIn("1%", labels)
        path = points(self.one(f"{figure} g[aria-description='path of least cost'] path"))
        for (px, py), (n, r) in zip((path[0], path[-1]), [(20, 1.0), (80, 1.6)]):
            self.assertAlmostEqual(px, x(n), delta=0.5)
            self.assertAlmostEqual(py, y(r), delta=0.5)
        rule = points(self.one(f"{figure} g[aria-description='neighbour rule'] path"))
        self.assertAlmostEqual(rule[0][0], x(20), delta=0.5)
        for px, py in rule:
            self.assertAlmostEqual(py, y(2.0 * (n_at(px) / 80) ** 0.5), delta=0.5)
        cells = self.all(f"{figure} g[aria-description='measured error'] rect")
        self.assertEqual(len(cells), len(LEVELS) * len(RATIOS))
        shades = [float(cell.get_attribute("fill-opacity")) for cell in cells]
        errors = [surface_at(n, r) for n in LEVELS for r in RATIOS]
        falling = [shade for _, shade in sorted(zip(errors, shades))]
        self.assertEqual(falling, sorted(shades, reverse=True))
        # No law: no contours of it, what was tried alone, and what failed.
        other = "section.surface figure:nth-child(1)"
        self.assertEqual(self.all(f"{other} g[aria-description='contours of the law'] path"), [])
        self.assertEqual(len(self.all(f"{other} g[aria-description='best h/dx'] circle")), 3)
        self.assertEqual(len(self.all(f"{other} g[aria-description='failed'] path")), 1)
        for column, texts in {
            "formulation": ["lucy-flux", "brookshaw", "brookshaw (walls off)"],
            "model": ["no law comes near"] + 2 * ["smoothing and sampling"],
            "best h/dx at N = 20": ["1.5 of those tried", "1 [0.909, 1.1] or less"]
            + ["1 [0.909, 1.1] or less (by the law; measured 3)"],
            "best h/dx at N = 80": ["1.5 of those tried", "1.7 [1.55, 1.87]"]
            + ["1 (measured; by the law 1.7 [1.55, 1.87], within its misfit)"],
            "neighbours ~ N^k: best k": ["not known"] + 2 * ["0.3 [0.25, 0.35]"],
            "k = 0.5: error / best, same cost": ["not known"] + 2 * ["1.40 [1.20, 1.60]"],
            "k = 0.5: cost / best, same error": ["not known"] + 2 * ["1.80 [1.50, 2.10]"],
        }.items():
            self.assertEqual(self.cells("Error surfaces", column), texts, column)
        self.assertIn("neighbours ~ N^0.5: 1.40 [1.20, 1.60] times the error", self.lines("surface")[1])
        self.assert_silent()
        self.open("cards.html")
        self.assertEqual(self.all("section.surface"), [])

    def test_headings_name_their_quantities_and_tell_settings_apart(self):
        self.open("layouts.html")
        captions = [node.text for node in self.all("section.convergence figcaption")]
        ratios = ["1.2", "1.2 (N/12)^0.5", "1.5", "1.5 (N/12)^0.5"]
        self.assertEqual(sorted(captions), [f"clumped {a} · h/dx {r}" for a in ["0.2", "0.4"] for r in ratios])
        self.choose("h/dx", "1.5 (N/12)^0.5")
        self.assertEqual(len(self.all("section.convergence figure")), 2)

    def test_forms_of_different_equations_are_not_ranked_together(self):
        self.open("rates.html")
        ranked = {
            article.find_element(By.CSS_SELECTOR, "h4").text: sorted(
                head.get_attribute("textContent")
                for head in article.find_elements(By.CSS_SELECTOR, "tbody th")
            )
            for article in self.all("article.verdict:not(.across)")
        }
        self.assertEqual(
            ranked,
            {
                "operator/sine, momentum": ["p-rho2", "sqrt-p"],
                "operator/sine, work on total energy": ["total"],
                "operator/sine, conduction": ["brookshaw"],
            },
        )
        self.assert_silent()

    def finest_runs(self, document):
        """In the order of the page."""
        runs = [document["runs"][run] for series in document["series"] for run in series["runs"]]
        finest = max(run["resolution"] for run in runs)
        return [run for run in runs if run["resolution"] == finest]

    def marks(self, section, description, tag, attribute):
        """A number of every mark of a section's plots, by description, as drawn."""
        nodes = self.all(f"section.{section} figure svg g[aria-description='{description}'] {tag}")
        return [float(node.get_attribute(attribute)) for node in nodes]

    def places(self, section, description):
        """Where the centres of a section's symbols are, of all its plots; crosses and circles alike."""
        text = "return [...document.querySelectorAll(arguments[0])].map(e => { const m = e.transform.baseVal;"
        text += "return m.length ? [m[0].matrix.e, m[0].matrix.f] : [e.cx.baseVal.value, e.cy.baseVal.value] })"
        marks = f"section.{section} figure svg g[aria-description='{description}'] :is(circle, path)"
        return self.script(text, marks)

    def assert_drawn_at(self, values, pixels):
        """That these values, on a linear axis, lie at these pixels."""
        values, pixels = sorted(values), sorted(pixels)
        self.assertEqual(len(values), len(pixels))
        self.assertGreater(values[-1], values[0])
        scale = (pixels[-1] - pixels[0]) / (values[-1] - values[0])
        for value, pixel in zip(values, pixels):
            self.assertAlmostEqual(pixels[0] + scale * (value - values[0]), pixel, delta=0.5)

    def test_draws_stable_steps_by_theory_and_by_experiment(self):
        self.open("stable.html")
        runs = self.finest_runs(self.stable)
        steps = [(method, step) for run in runs for method, step in run["stability"]["stable_steps"].items()]
        theory = [step["theory"] for _, step in steps if step["theory"] is not None]
        measured = [step["measured"] for _, step in steps if step["measured"] is not None]
        none = [step for _, step in steps if step["remark"].startswith("no step is stable")]
        self.assertGreater(len(measured), 12)
        self.assertGreater(len(none), 0)
        self.assertEqual(len(self.all("section.steps figure")), 2)
        self.assert_drawn_at([math.log(dt) for dt in theory], self.marks("steps", "by theory", "line", "x1"))
        tried = [x for x, _ in self.places("steps", "by experiment")]
        self.assert_drawn_at([math.log(dt) for dt in measured], tried)
        self.assertEqual(self.count("steps", "g[aria-description='no step is stable'] path"), len(none))

        table = "Largest stable steps"
        self.assertEqual(self.cells(table, "method"), [method for method, _ in steps])
        self.assertEqual(self.cells(table, "seed"), [seed_of(run) for run in runs for _ in range(4)])
        for column, key in [("by theory", "theory"), ("by experiment", "measured")]:
            self.assertEqual(self.cells(table, column), [seconds_text(step[key]) for _, step in steps])
        words = []
        for run in runs:
            for step in run["stability"]["stable_steps"].values():
                tried = step["theory"] is not None and step["measured"] is not None
                near = tried and abs(step["measured"] / step["theory"] - 1) <= 0.01
                grows = ", but a mode grows" if run["stability"]["growing_modes"] else ""
                words.append((("agree" if near else "differ") + grows) if tried else "")
        self.assertEqual(self.cells(table, "agreement"), words)
        sentence = next(line for line in self.lines("steps") if line.startswith("brookshaw: "))
        self.assertIn("agree within 1% on 12 of 12 steps", sentence)
        self.open("resting.html")
        self.assertEqual(set(self.cells(table, "method")), {"leapfrog"})
        self.assert_silent()

    def lines(self, section):
        return [line.text for line in self.all(f"section.{section} .sentences li")]

    def test_draws_the_worst_modes(self):
        self.open("stable.html")
        runs = self.finest_runs(self.stable)
        stabilities = [run["stability"] for run in runs]
        growing = [s for s in stabilities if s["growing_modes"] > 0]
        self.assertTrue(0 < len(growing) < len(stabilities))
        for kind, chosen in [
            ("growing mode", growing),
            ("worst mode", [s for s in stabilities if s not in growing]),
        ]:
            places = self.places("modes", kind)
            modes = [s["worst_mode"] for s in chosen]
            self.assert_drawn_at([math.log(mode["wavelength"]) for mode in modes], [x for x, _ in places])
            self.assert_drawn_at([-mode["wall_share"] for mode in modes], [y for _, y in places])
        self.assertEqual(
            self.cells("Worst modes", "growing modes"), [str(s["growing_modes"]) for s in stabilities]
        )
        for column, key in [("growth [1/s]", "growth"), ("wavelength [dx]", "wavelength")]:
            for cell, s in zip(self.cells("Worst modes", column), stabilities, strict=True):
                self.assertAlmostEqual(float(cell) / s["worst_mode"][key], 1.0, delta=0.006)
        for cell, s in zip(self.cells("Worst modes", "centre [m]"), stabilities, strict=True):
            self.assertAlmostEqual(float(cell), s["worst_mode"]["centre"][0], delta=0.002)
        unseen = [str(s["unseen_modes"]) for s in stabilities]
        self.assertEqual(self.cells("Worst modes", "unseen modes"), unseen)
        self.assertIn("brookshaw: no mode grows in 3 runs.", self.lines("modes"))
        fastest = max(s["worst_mode"]["growth"] for s in growing)
        sentence = next(line for line in self.lines("modes") if line.startswith("campbell-flux: "))
        self.assertIn(f"modes grow in {len(growing)} of 3 runs, fastest at {fastest:.3g}/s", sentence)

    def test_modes_that_are_not_known_are_not_said_to_decay(self):
        self.open("unknown.html")
        growing = [run["stability"]["growing_modes"] for run in self.finest_runs(self.unknown)]
        worst = [run["stability"]["worst_mode"] for run in self.finest_runs(self.unknown)]
        words = [str(n) if n is not None else "at least 1" if m else "not known" for n, m in zip(growing, worst)]
        self.assertEqual(set(words), {"not known", "at least 1", "0"} & set(words) | {"not known"})
        self.assertEqual(self.cells("Worst modes", "growing modes"), words)
        brookshaw, campbell = self.all("section.modes .sentences li")
        self.assertEqual(brookshaw.text, "brookshaw: not known: too many unknowns.")
        self.assertEqual(brookshaw.get_attribute("class"), "")
        self.assertRegex(campbell.text, "modes grow in . of 2 runs, .*dx. Not known of 1: too many unknowns.$")
        self.assert_silent()

    def test_draws_perturbations_of_a_gas_about_rest(self):
        self.open("stable.html")
        self.assertEqual(self.all("section.perturbations"), [])
        self.open("resting.html")
        runs = self.finest_runs(self.resting)
        lattice = next(run for run in runs if run["discretisation"]["layout"] == "lattice")
        disordered = [run for run in runs if run is not lattice]
        worst = max(disordered, key=lambda run: run["stability"]["spectral_abscissa"])
        self.assertGreater(worst["stability"]["growing_modes"], 0)
        drawn = {"mode": [], "growing mode": []}
        for run in [lattice, worst]:
            radius = run["stability"]["spectral_radius"]
            for mode in run["stability"]["modes"]:
                if mode["frequency"] >= 0 and mode["centre"]:
                    drawn["growing mode" if mode["growth"] > 1e-4 * radius else "mode"].append(mode)
        for quantity in ["growth", "frequency"]:
            self.choose("Quantity", f"{quantity} [1/s]")
            for kind, modes in drawn.items():
                places = self.places("perturbations", kind)
                waves = [2 * math.pi / m["wavelength"] if m["wavelength"] else 0.0 for m in modes]
                self.assert_drawn_at(waves, [x for x, _ in places])
                self.assertEqual(len(places), len(modes))
        growths = [mode["growth"] for mode in drawn["growing mode"]]
        self.choose("Quantity", "growth [1/s]")
        heights = [y for _, y in self.places("perturbations", "growing mode")]
        self.assert_drawn_at([-growth for growth in growths], heights)
        captions = [node.text for node in self.all("section.perturbations figcaption")]
        self.assertIn("nothing grows", captions[0])
        self.assertIn(f"grows at up to {max(growths):.3g}/s", captions[1])
        self.assert_silent()

    def test_draws_where_the_second_law_broke(self):
        self.open("stable.html")
        laws = [run["second_law"] for run in self.finest_runs(self.stable)]
        kinds = {
            "heat from cold to hot": "cold_to_hot",
            "hotter than ever before": "overshoot",
            "colder than ever before": "undershoot",
        }
        self.assertEqual([law["remark"] for law in laws], [""] * len(laws))
        dots = self.count("second-law", "g[aria-description=breach] :is(circle, path)")
        self.assertEqual(dots, 4 * len(laws))
        for column, key in kinds.items():
            self.assertTrue(any(law[key]["size"] > 0 for law in laws), key)
            for cell, law in zip(self.cells("Second law", column), laws, strict=True):
                size = 100 * law[key]["size"]
                self.assertAlmostEqual(float(cell.split("%")[0]), size, delta=0.06 * size)
                if size > 0:
                    time = float(cell.split("t = ")[1].split(",")[0])
                    self.assertAlmostEqual(time, law[key]["time"], delta=0.006 * time)
                    place = float(cell.split("x = ")[1])
                    self.assertAlmostEqual(place, law[key]["position"][0], delta=0.002)
        # Linear up to 1%, logarithmic beyond.
        sizes = [law[key]["size"] for law in laws for key in kinds.values()]
        sizes += [max(0.0, -law["smallest_entropy_production"]) for law in laws]
        drawn = [x for x, _ in self.places("second-law", "breach")]
        self.assert_drawn_at([math.log1p(size / 0.01) for size in sizes], drawn)
        falls = sum(law["smallest_entropy_production"] < 0 for law in laws)
        broken = self.cells("Second law", "broken")
        self.assertEqual(sum("entropy falls" in text for text in broken), falls)
        self.assertGreater(falls, 0)
        sentences = self.lines("second-law")
        self.assertIn("brookshaw: kept in 3 runs.", sentences)
        sentence = next(line for line in sentences if line.startswith("campbell-flux: broken in "))
        self.assertIn(f"entropy falls in {falls}", sentence)

    def test_draws_the_interval_of_run_times(self):
        self.open("timed.html")
        levels = [level for s in self.timed["series"] for level in entry_of(s)["levels"]]
        self.assertTrue(all(level["low_seconds"] is not None for level in levels))
        ends = [math.log(level[key]) for level in levels for key in ["low_seconds", "high_seconds"]]
        bars = "interval of the run time"
        drawn = self.marks("cost", bars, "line", "x1") + self.marks("cost", bars, "line", "x2")
        self.assert_drawn_at(ends, drawn)
        dots = "section.cost figure svg g[aria-label=dot] :is(circle, path)"
        self.assertEqual(len(self.all(dots)), len(levels))
        self.assertIn("95% interval", self.one("section.cost .hint").text)
        times = self.cells("Ladders", "run time")
        for cell, s in zip(times, self.timed["series"], strict=True):
            level = entry_of(s)["levels"][-1]
            low, high = (seconds_text(level[key]) for key in ["low_seconds", "high_seconds"])
            self.assertEqual(cell, f"{seconds_text(level['median_seconds'])} [{low}, {high}]")
        self.assert_silent()

    def verdict_cells(self, column):
        return self.cells("Verdict on conduction/slab-dirichlet", column)

    def test_tells_only_what_run_times_tell(self):
        self.open("given.html")
        self.assertEqual(self.verdict_cells("formulation"), ["brookshaw", "lucy-flux"])
        self.assertEqual(self.verdict_cells("time to 1%"), ["10 ms", "10.5 ms"])
        # 0.0099/0.011 and 0.012/0.009: 1 lies between.
        self.assertEqual(self.verdict_cells("times the soonest"), ["1", "≈ 1.05 [0.90, 1.33]"])
        self.assertEqual(self.verdict_cells("time to 0.1%"), ["100 ms", "300 ms"])
        self.assertEqual(self.verdict_cells("times the soonest to 0.1%"), ["1", "3.00 [2.70, 3.40]"])
        text = self.one("article.verdict:not(.across)").text
        self.assertIn("Run times do not tell it from lucy-flux (1.05 times as long).", text)
        self.assertIn("Soonest to 1%, as far as can be told: brookshaw, 10 ms", text)
        self.assertIn("≈: run times do not tell it from the soonest.", text)
        self.assertNotIn("Next:", text)
        cells = ["10 ms [9 ms, 11 ms]", "10.5 ms [9.9 ms, 12 ms]"]
        self.assertEqual(self.cells("Ladders", "time to 1% (all)"), cells)

    def test_one_repeat_has_no_interval(self):
        self.open("heat.html")
        self.assertEqual(self.count("cost", "g[aria-description='interval of the run time']"), 0)
        self.assertNotIn("95% interval", self.one("section.cost .hint").text)
        ratios = self.verdict_cells("times the soonest")
        self.assertEqual(ratios[0], "1")
        self.assertFalse(any("[" in text or "≈" in text for text in ratios))

    def test_sections_without_data_are_left_out(self):
        self.open("rates.html")
        for section in ["modes", "perturbations", "steps", "second-law", "spectrum", "envelope"]:
            self.assertEqual(self.all(f"section.{section}"), [], section)
        # Stability without the measure stable-step: theory alone.
        self.open("heat.html")
        self.assertEqual(self.all("section.second-law"), [])
        heads = "div[aria-label='Largest stable steps'] thead th"
        columns = [head.get_attribute("textContent") for head in self.all(heads)]
        self.assertIn("by theory", columns)
        self.assertNotIn("by experiment", columns)
        self.assertNotIn("agreement", columns)

    def test_failures_are_listed_with_their_reasons(self):
        self.open("heat.html")
        failed = [run for run in self.heat["runs"] if run["status"] != "ok"]
        self.assertEqual(self.cells("Failures", "reason"), [run["reason"] for run in failed])

    def test_filters_change_plots_and_tables(self):
        self.open("heat.html")
        before = self.count("convergence", "circle")
        rows = len(self.cells("Ladders", "formulation"))
        self.driver.find_element(By.XPATH, "//fieldset//label[span='brookshaw (walls off)']/input").click()
        self.assertLess(self.count("convergence", "circle"), before)
        self.assertEqual(len(self.cells("Ladders", "formulation")), rows - 2)
        self.choose("layout", "lattice")
        self.assertEqual(len(self.all("section.convergence figure")), 1)
        self.assertEqual(len(self.cells("Ladders", "formulation")), 3)
        self.choose("case", "conduction/slab-insulated")
        self.assertEqual(set(self.cells("Ladders", "case")), {"conduction/slab-insulated"})
        self.driver.find_element(By.XPATH, "//label[span[contains(., 'all cases')]]/input").click()
        self.assertEqual(len(set(self.cells("Ladders", "case"))), 2)
        search = self.one("section.tables .table input[type=search]")
        search.send_keys("campbell DIRICHLET")
        self.assertEqual(set(self.cells("Ladders", "case")), {"conduction/slab-dirichlet"})
        self.assertIn(" of ", self.one("section.tables .table .count").text)
        self.assert_silent()

    def test_tables_sort_by_keyboard(self):
        self.open("heat.html")
        heads = self.all("div[aria-label=Ladders] thead th")
        head = next(h for h in heads if h.get_attribute("textContent") == "run time")
        self.assertEqual(head.get_attribute("aria-sort"), "none")
        button = head.find_element(By.TAG_NAME, "button")
        seconds = []
        for order in ["ascending", "descending"]:
            button.send_keys(Keys.ENTER)
            self.assertEqual(head.get_attribute("aria-sort"), order)
            texts = self.cells("Ladders", "run time")
            numbers = [float(t.split()[0]) * UNITS[t.split()[1]] for t in texts if t != "–"]
            # A ladder that failed has no time and stands last either way.
            self.assertEqual(texts[-1], "–")
            seconds.append(numbers)
        self.assertEqual(seconds[0], sorted(seconds[0]))
        self.assertEqual(seconds[1], sorted(seconds[0], reverse=True))

    def test_works_by_keyboard(self):
        self.open("heat.html")
        active = self.driver.switch_to.active_element
        active.send_keys(Keys.TAB)
        self.assertEqual(self.driver.switch_to.active_element.get_attribute("class"), "skip")
        stops = set()
        for _ in range(60):
            element = self.driver.switch_to.active_element
            element.send_keys(Keys.TAB)
            stops.add(self.script("const e = document.activeElement; return e.tagName + (e.type ?? '')"))
        for stop in ["A", "BUTTONbutton", "SELECTselect-one", "INPUTcheckbox", "SUMMARY", "DIV"]:
            self.assertIn(stop, stops)
        box = self.driver.find_element(By.XPATH, "//fieldset//label[span='brookshaw']/input")
        before = self.count("convergence", "circle")
        box.send_keys(Keys.SPACE)
        self.assertLess(self.count("convergence", "circle"), before)
        # What is drawn anew does not take the focus away.
        focused = self.script("return document.activeElement.closest('label').textContent")
        self.assertEqual(focused, "brookshaw")

    def test_what_stands_for_walls_tells_forms_apart(self):
        self.open("walled.html")
        names = ["brookshaw", "brookshaw (walls dummy)", "brookshaw (walls mirror)", "brookshaw (walls off)"]
        labels = self.driver.find_elements(By.XPATH, "//fieldset//label/span")
        self.assertEqual(sorted(label.text for label in labels if label.text), names)
        # A curve each, of which only the control's is dashed and only it shares a colour.
        marks = self.script("""
          return [...document.querySelectorAll('fieldset label')].map((label) => {
            const line = label.querySelector('svg line, svg path');
            const style = getComputedStyle(line);
            return [label.querySelector('span').textContent, style.stroke, style.strokeDasharray];
          });""")
        strokes = {name: (stroke, dash) for name, stroke, dash in marks}
        self.assertEqual(len({stroke for stroke, _ in strokes.values()}), 3)
        self.assertEqual(strokes["brookshaw"][0], strokes["brookshaw (walls off)"][0])
        self.assertEqual({name for name, (_, dash) in strokes.items() if dash not in ("none", "")}, {"brookshaw (walls off)"})
        self.assert_silent()

    def saved(self, suffix):
        for _ in range(100):
            files = list((self.place / "saved").glob(f"*{suffix}"))
            if files and files[0].stat().st_size > 0:
                return files[0]
            time.sleep(0.1)
        self.fail(f"no {suffix} was saved")

    def test_saves_plots_as_files_that_stand_alone(self):
        self.open("heat.html")
        for button in self.all("section.convergence figure:first-child .save button"):
            button.click()
        svg = self.saved("lattice.svg").read_text()
        root = xml.etree.ElementTree.fromstring(svg)
        self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
        for word in ["var(", "currentColor", "<style", "href", "class="]:
            self.assertNotIn(word, svg)
        texts = [node.text for node in root.iter("{http://www.w3.org/2000/svg}text")]
        for name in ["brookshaw", "brookshaw (walls off)", "campbell-flux", "campbell-flux (walls off)"]:
            self.assertIn(name, texts)
        self.assertEqual(self.saved("lattice.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.open("stable.html")
        for section in ["modes", "steps", "second-law"]:
            self.one(f"section.{section} figure:first-child .save button").click()
        for name, word in [("worst-modes", "dx"), ("stable-steps", "heun"), ("second-law", "hot")]:
            svg = self.saved(f"{name}-lattice.svg").read_text()
            self.assertEqual(xml.etree.ElementTree.fromstring(svg).tag, root.tag)
            self.assertNotIn("var(", svg)
            self.assertIn(word, svg)
        self.assert_silent()

    def background(self):
        return self.script("return getComputedStyle(document.body).backgroundColor")

    def test_is_dark_and_light(self):
        self.open("heat.html")
        for scheme, colour in [("dark", "rgb(20, 23, 28)"), ("light", "rgb(255, 255, 255)")]:
            features = [{"name": "prefers-color-scheme", "value": scheme}]
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
            # The page hears of it with the next frame.
            self.driver.execute_async_script("requestAnimationFrame(() => setTimeout(arguments[0]))")
            self.assertEqual(self.background(), colour)
        button = self.one("#theme")
        for theme, colour in [("light", "rgb(255, 255, 255)"), ("dark", "rgb(20, 23, 28)")]:
            button.send_keys(Keys.ENTER)
            self.assertEqual(button.text, f"Colours: {theme}")
            self.assertEqual(self.background(), colour)

    def test_fits_a_phone(self):
        phone = {"width": 360, "height": 800, "deviceScaleFactor": 2, "mobile": True}
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", phone)
        for name in ["both.html", "odd.html", "stable.html", "resting.html", "given.html"]:
            self.open(name)
            self.assertLessEqual(self.script("return document.documentElement.scrollWidth"), 360)
        plot = self.script("return document.querySelector('section.cost svg').clientWidth")
        self.assertLessEqual(plot, 360)

    def test_prints(self):
        self.open("stable.html")
        pdf = base64.b64decode(self.driver.execute_cdp_cmd("Page.printToPDF", {})["data"])
        self.assertTrue(pdf.startswith(b"%PDF"))
        page = {"width": 1040, "height": 700, "deviceScaleFactor": 1, "mobile": False}  # A4, landscape
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", page)
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        self.assertLessEqual(self.script("return document.documentElement.scrollWidth"), 1040)
        self.assertEqual(self.background(), "rgb(255, 255, 255)")

    def test_text_of_the_results_stays_text(self):
        self.open("odd.html")
        self.assertEqual(self.driver.title, "sphverify · odd")
        self.assertEqual(self.one("h2").text, HOSTILE)
        self.assertEqual(self.all("img"), [])
        self.assertIn(HOSTILE, self.cells("Failures", "reason"))

    def test_several_documents_are_shown_but_not_compared(self):
        self.open("both.html")
        self.assertEqual([h.text for h in self.all("h2")], ["heat", "gas"])
        self.assertIn("not compared", self.one("#documents > .note").text)
        ids = self.script("return [...document.querySelectorAll('[id]')].map(e => e.id)")
        self.assertEqual(len(ids), len(set(ids)))
        # A conduction form does not move a gas.
        skipped = self.cells("Skipped", "reason")
        self.assertEqual(len(skipped), len(self.gas["skipped"]))

    def test_says_what_ran(self):
        self.open("heat.html")
        facts = self.one(".context dl").text
        for key in ["version", "commit", "compiler", "processor"]:
            self.assertIn(self.heat["context"][key], facts)
        failed = sum(run["status"] != "ok" for run in self.heat["runs"])
        line = f"{len(self.heat['runs'])} runs in {len(self.heat['series'])} ladders, {failed} failed"
        self.assertIn(line, self.one("article.document > .parameters").text)

    def test_drawing_takes_little_time(self):
        # Printed, not judged: timings never decide a test.
        for name in ["heat.html", "both.html"]:
            start = time.monotonic()
            self.open(name)
            size = (self.place / name).stat().st_size
            print(f"{name}: {size} bytes, {time.monotonic() - start:.1f} s to open and draw", file=sys.stderr)


class ReportCommandTest(program.ProgramTest):
    def test_refuses_what_is_not_a_results_document(self):
        path = self.write("bad.json", {"schema": "sphverify-study/1"})
        self.assert_user_error(self.run_program("report", path), "bad.json", "schema")
        self.assert_user_error(self.run_program("report", self.folder / "none.json"), "none.json")

    def test_refuses_to_overwrite_its_input(self):
        self.study(program.small_study())
        path = self.folder / "results.json"
        self.assert_user_error(self.run_program("report", path, "-o", path), "results.json")

    def test_writes_to_standard_output_by_default(self):
        self.study(program.small_study())
        page = self.succeed("report", self.folder / "results.json")
        self.assertTrue(page.startswith("<!DOCTYPE html>"))
        self.assertNotIn("{{", page.split('<script type="application/json"')[0])


if __name__ == "__main__":
    unittest.main()
