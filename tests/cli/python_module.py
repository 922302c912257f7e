# SPDX-License-Identifier: GPL-3.0-or-later
"""The module python/sphverify as tests use it, and results documents that hold a little of everything."""

import functools
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from program import DONE, PROGRAM, SOURCE_DIR, small_study, strict_json

try:
    import pandas
except ImportError:
    raise unittest.SkipTest("python3-pandas is missing") from None

sys.path.insert(0, str(SOURCE_DIR / "python"))
import sphverify  # noqa: E402

LARGEST_SEED = 2**63 - 1

HEAT = small_study(
    name="heat",
    formulations=["conduction/brookshaw", "conduction/lucy-flux", {"id": "conduction/brookshaw", "walls": "off"}],
    discretisation={
        "density": "given",
        "layout": ["lattice", {"id": "jittered", "amplitude": 0.3, "seeds": [1, LARGEST_SEED]}],
    },
    measure=["error", "conservation", "cost", "spectrum", "second-law", "profile", "history"],
)
# With viscosity off the particles meet the piston.
GAS = small_study(
    name="gas",
    cases=[
        {"id": "hydro/piston-velocity", "parameters": {"dimension": 2, "final_time": 0.1}},
        {"id": "hydro/riemann", "parameters": {"final_time": 0.02}},
    ],
    formulations=["momentum/p-rho2", {"id": "momentum/p-rho2", "conduction": "conduction/brookshaw"}],
    discretisation={"density": "normalised", "viscosity": ["off", "riemann", {"alpha": 1, "beta": 2}]},
    resolution=[24],
    measure=["error", "conservation", "cost", "profile", "history"],
)
ENVELOPE = small_study(
    name="envelope",
    formulations=["conduction/brookshaw", "conduction/gmls"],
    discretisation={"layout": {"id": "jittered", "amplitude": 0.2, "seed": 1}},
    envelope={"parameter": "smoothing_ratio", "from": 1.2, "to": 0.5, "bisections": 2},
    resolution=[16],
    measure="error",
)
MODES = small_study(
    name="modes",
    cases=[{"id": "hydro/uniform", "parameters": {"boundary": "periodic"}}],
    formulations=["momentum/p-rho2"],
    discretisation=None,
    resolution=[10],
    measure=["stability", "spectrum"],
)
STUDIES = {"heat": HEAT, "gas": GAS, "envelope": ENVELOPE, "modes": MODES}

_folder = tempfile.TemporaryDirectory(prefix="sphverify-test-")
unittest.addModuleCleanup(_folder.cleanup)


@functools.cache
def path_of(name):
    """The results of one of the studies, run once."""
    study = pathlib.Path(_folder.name) / f"{name}-study.json"
    study.write_text(json.dumps(STUDIES[name]))
    results = pathlib.Path(_folder.name) / f"{name}.json"
    done = subprocess.run([PROGRAM, "study", study, "-o", results], capture_output=True, text=True)
    assert done.returncode == DONE, done.stderr
    return results


def document_of(name):
    return strict_json(path_of(name).read_text())


@functools.cache
def results_of(name):
    return sphverify.load(path_of(name))


def cells(row):
    """What is not missing in a row of a frame, by column."""
    return {name: value for name, value in row.items() if isinstance(value, tuple) or not pandas.isna(value)}
