# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of sphverify as pandas data frames, and its program from Python.

    import sphverify
    results = sphverify.load("results.json")            # or sphverify.study("study.json", "results.json")
    results.runs, results.levels, results.series        # docs/python.md says what they hold

Nothing is computed here: orders, floors, verdicts and times to an error are those of the document.
"""

try:
    import pandas as _pandas  # noqa: F401
except ImportError:
    raise ImportError("sphverify needs pandas, which is not installed (Debian: apt install python3-pandas)") from None

from .errors import Error
from .program import compare, find_program, gate, study
from .results import Results, load
from .units import UNITS

__all__ = ["Error", "Results", "UNITS", "compare", "find_program", "gate", "load", "study"]
