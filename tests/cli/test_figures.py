# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of the findings: all points are drawn, and the same document gives the same picture."""

import sys

sys.dont_write_bytecode = True

import importlib.util
import re
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

from program import DONE, SOURCE_DIR, USER_ERROR, ProgramTest, small_study

SVG = "{http://www.w3.org/2000/svg}"
RESOLUTIONS = [8, 12, 16]
STUDY = small_study(
    formulations=[f"conduction/{form}" for form in ("brookshaw", "gamma-brookshaw", "corrected-flux", "gmls")]
    + [{"id": "conduction/brookshaw", "walls": "mirror"}],
    discretisation={
        "density": "given",
        "pair_weight": ["kernel", "voronoi"],
        "layout": ["lattice", {"id": "jittered", "amplitude": 0.3, "seeds": [1, 2]}],
    },
    resolution=RESOLUTIONS,
)


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "needs python3-matplotlib")
class Figures(ProgramTest):
    def draw(self, *options):
        return subprocess.run(
            [sys.executable, SOURCE_DIR / "tools" / "figures", "--results", self.folder, "--into", self.folder, *options],
            capture_output=True,
            encoding="utf-8",
            timeout=120,
        )

    def test_every_point_has_a_mark_and_every_series_a_name(self):
        self.study(STUDY, "heat-1d.json")
        drawn = self.draw("--only", "heat-1d")
        self.assertEqual(drawn.returncode, DONE, drawn.stderr)
        path = self.folder / "heat-1d.svg"
        self.assertEqual(drawn.stdout, f"{path}\n")
        text = path.read_text()
        root = ElementTree.fromstring(text)
        groups = [g for g in root.iter(f"{SVG}g") if re.fullmatch(r"series-\d+", g.get("id", ""))]
        self.assertEqual([len(list(g.iter(f"{SVG}use"))) for g in groups], [len(RESOLUTIONS)] * 6 * 2)  # in each panel
        words = {"".join(t.itertext()).strip() for t in root.iter(f"{SVG}text")}
        self.assertLessEqual({"Brookshaw", "Brookshaw, Voronoi", "least squares"}, words)
        self.assertIn("prefers-color-scheme: dark", text)
        self.assertNotIn("#010203", text)

        self.draw("--only", "heat-1d")
        self.assertEqual(path.read_text(), text)

    def test_what_is_not_there_is_said_in_one_line(self):
        self.assert_user_error(self.draw("--only", "heat-1d"), "heat-1d.json")
        self.assert_user_error(self.draw("--only", "nothing"), "nothing", "heat-1d")
        self.study(small_study(), "heat-1d.json")
        self.assert_user_error(self.draw("--only", "heat-1d"), "Brookshaw, mirror", "lattice")

    def test_a_mean_over_more_than_seeds_is_refused(self):
        study = {**STUDY, "discretisation": {**STUDY["discretisation"], "smoothing_ratio": [1.2, 1.5]}}
        self.study(study, "heat-1d.json")
        self.assert_user_error(self.draw("--only", "heat-1d"), "smoothing_ratio", "1.2, 1.5")


if __name__ == "__main__":
    unittest.main()
