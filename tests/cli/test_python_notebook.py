# SPDX-License-Identifier: GPL-3.0-or-later
"""The notebook of examples/notebook is executed, on a small study, and draws what the document says.

Jupyter would bring 47 packages: the cells are executed here as it does, the last expression of each shown.
"""

import sys

sys.dont_write_bytecode = True

import ast
import contextlib
import io
import json
import os
import unittest
import warnings

from program import PROGRAM, SOURCE_DIR, ProgramTest, small_study, strict_json
from python_module import pandas, sphverify

try:
    import matplotlib
except ImportError:
    raise unittest.SkipTest("python3-matplotlib is missing") from None

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

PATH = SOURCE_DIR / "examples" / "notebook" / "convergence.ipynb"
NOTEBOOK = json.loads(PATH.read_text(encoding="utf-8"))
CODE = [cell for cell in NOTEBOOK["cells"] if cell["cell_type"] == "code"]

CASES = ["conduction/slab-dirichlet", "conduction/slab-insulated"]
STUDY = small_study(
    cases=[{"id": case, "parameters": {"final_time": 0.01}} for case in CASES],
    formulations=["conduction/brookshaw", {"id": "conduction/brookshaw", "walls": "off"}, "conduction/lucy-flux"],
    discretisation={
        "density": ["given", "summation"],
        "layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2]}],
    },
    smoothing_exponent=[0, 0.5],
    measure=["error", "cost"],
    repeat={"most": 6, "seconds": 0.05},
)


def execute(cell, names):
    """What Jupyter would show below a cell: the value of its last expression, if it has one."""
    tree = ast.parse("".join(cell["source"]))
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, PATH.name, "exec"), names)
    return eval(compile(ast.Expression(last.value), PATH.name, "eval"), names) if last else None


class Notebook(ProgramTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(plt.close, "all")
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir(self.folder)
        os.environ["SPHVERIFY"] = PROGRAM

    def execute_all(self, study, names):
        shown = []
        with warnings.catch_warnings(), contextlib.redirect_stderr(io.StringIO()):
            warnings.filterwarnings("error", module=f"{PATH.name}|numpy|pandas|matplotlib")
            for cell in CODE:
                shown.append(execute(cell, names))
                if "parameters" in cell["metadata"].get("tags", []):
                    names["study"] = study
        return shown

    def panels(self, figure):
        return [axes for axes in plt.figure(figure).axes if axes.get_title()]

    def expected(self, document, x):
        """The curves of each panel by title, as the document has them: label, x and error of each level with both."""
        panels = {}
        for series in document["series"]:
            d = series["discretisation"]
            if d["density"] != "given" or d["layout"] != {"id": "jittered", "amplitude": 0.1}:
                continue
            refined = "fixed" if series["smoothing_exponent"] == 0 else "~ N^0.5"
            order = next(o for o in series["orders"] if [o[k] for k in ("field", "region", "norm")] == ["temperature", "all", "l2"])
            points = [(level[x], level["error"]) for level in order["levels"] if None not in (level[x], level["error"])]
            panels.setdefault(f"{series['case']}, h/dx {refined}", {})[series["label"]] = points
        return panels

    def drawn(self, figure):
        return {
            panel.get_title(): {
                container.get_label(): list(zip(*(map(float, data) for data in container.lines[0].get_data())))
                for container in panel.containers
            }
            for panel in self.panels(figure)
        }

    def test_it_draws_the_ladders_of_the_document(self):
        names = {}
        shown = self.execute_all(self.write("study.json", STUDY), names)
        document = strict_json((self.folder / names["output"]).read_text())
        self.assertEqual(plt.get_fignums(), [1, 2])
        for figure, x in ((1, "resolution"), (2, "median_seconds")):
            expected = self.expected(document, x)
            self.assertEqual(len(expected), 4)
            self.assertEqual({len(curves) for curves in expected.values()}, {3})
            self.assertTrue(all(len(points) == 3 for curves in expected.values() for points in curves.values()))
            self.assertEqual(self.drawn(figure), expected)
            for panel in self.panels(figure):
                self.assertEqual((panel.get_xscale(), panel.get_yscale()), ("log", "log"))
            self.assertIn("[K]", plt.figure(figure)._supylabel.get_text())
        tables = [table for table in shown if isinstance(table, pandas.DataFrame)]
        self.assertEqual(tables[0].to_numpy().sum(), len(document["runs"]))
        self.assertEqual(len(tables[1]), 12)
        self.assertIn("verdict", tables[1])
        self.assertEqual(len(tables[2]), 12)

    def test_times_of_two_machines_are_not_drawn(self):
        names = {}
        results = self.folder / "conduction-walls-1d-results.json"
        document = self.study(STUDY, results.name)
        for series in document["series"]:
            series["is_timed_apart"] = True
        results.write_text(json.dumps(document))
        self.execute_all("nothing is run: the results are there", names)
        self.assertEqual(sum(len(curves) for curves in self.drawn(1).values()), 12)
        self.assertEqual(sum(len(curves) for curves in self.drawn(2).values()), 0)

    def test_it_is_kept_without_outputs_and_names_a_study_that_is_there(self):
        for cell in CODE:
            self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None))
        parameters = [cell for cell in CODE if "parameters" in cell["metadata"].get("tags", [])]
        self.assertEqual(len(parameters), 1)
        names = {}
        execute(parameters[0], names)
        study = strict_json((PATH.parent / names["study"]).resolve().read_text())
        self.assertIn(names["selection"]["density"], study["discretisation"]["density"])
        layouts = [l if isinstance(l, str) else f"{l['id']} amplitude={l['amplitude']}" for l in study["discretisation"]["layout"]]
        self.assertIn(names["selection"]["layout"], layouts)
        self.assertLessEqual(os.path.getsize(PATH), 20000)


if __name__ == "__main__":
    unittest.main()
