# SPDX-License-Identifier: GPL-3.0-or-later
"""The scripts of examples/codes, on files as other libraries write them; and PySPH itself, where it is installed."""

import sys

sys.dont_write_bytecode = True

import importlib.util
import json
import subprocess
import unittest

from program import SOURCE_DIR, strict_json
from test_codes import PYTHON, Codes, read_csv, write_csv

FOLDER = SOURCE_DIR / "examples" / "codes"
GRESHO = {"id": "hydro/gresho", "parameters": {"final_time": 0.1}}


def there_is(module):
    return importlib.util.find_spec(module) is not None


@unittest.skipUnless(there_is("numpy"), "python3-numpy is missing")
class Adapters(Codes):
    def setUp(self):
        super().setUp()
        path, _ = self.particles("hydro/gresho", "-n", "20", "-p", "final_time=0.1")
        _, self.start = read_csv(path)
        write_csv(self.folder / "plain.csv", self.start, 0.1)
        self.plain = self.assess([{"file": "plain.csv", "resolution": 20}], case=GRESHO)["runs"][0]

    def convert(self, script, *arguments, fails=None):
        done = subprocess.run([PYTHON, str(FOLDER / script), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        if fails:
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(fails, done.stderr)
        else:
            self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def assert_same(self, name, tolerance, fields=("velocity", "density", "pressure")):
        run = self.assess([{"file": name, "resolution": 20}], case=GRESHO)["runs"][0]
        self.assertEqual(run["particles"], 400)
        for field in fields:
            error = self.plain["errors"][field]["all"]
            for norm in ("l1", "l2", "linf"):
                self.assertAlmostEqual(run["errors"][field]["all"][norm], error[norm], delta=tolerance, msg=field)

    @unittest.skipUnless(there_is("meshio"), "python3-meshio is missing")
    def test_vtu_as_trixiparticles_writes_it(self):
        import meshio
        import numpy

        points = numpy.stack([self.start["x"], self.start["y"], numpy.zeros(400)], axis=1)
        velocity = numpy.stack([self.start["vx"], self.start["vy"], numpy.zeros(400)], axis=1)
        mesh = meshio.Mesh(points, [("vertex", numpy.arange(400).reshape(-1, 1))],
                           point_data={"velocity": velocity, "density": numpy.array(self.start["rho"]),
                                       "pressure": numpy.array(self.start["P"])})  # fmt: skip
        mesh.write(self.folder / "fluid_1_10.vtu")
        self.convert("vtk_to_csv.py", "fluid_1_10.vtu", "out.csv", "--time", "0.1", "--spacing", "0.05")
        self.assert_same("out.csv", 1e-12)
        self.convert("vtk_to_csv.py", "fluid_1_10.vtu", "out.csv", fails="no masses")

    def test_vtp_as_sphinxsys_writes_it(self):
        def array(name, rows, width=1):
            text = "\n".join(" ".join(f"{value:.9f}" for value in row) for row in rows)
            return f'<DataArray Name="{name}" type="Float32" NumberOfComponents="{width}" Format="ascii">{text}</DataArray>'

        s = self.start
        text = "".join([
            '<VTKFile type="PolyData" version="1.0"><PolyData><FieldData>', array("TimeValue", [[0.1]]),
            '</FieldData><Piece Name="body" NumberOfPoints="400"><Points>',
            array("Position", [[x, y, 0.0] for x, y in zip(s["x"], s["y"])], 3), "</Points><PointData Vectors='vector'>",
            array("Velocity", [[u, v, 0.0] for u, v in zip(s["vx"], s["vy"])], 3), array("Density", [[r] for r in s["rho"]]),
            array("Pressure", [[p] for p in s["P"]]), array("VolumetricMeasure", [[1 / 400]] * 400),
            "</PointData></Piece></PolyData></VTKFile>",
        ])  # fmt: skip
        (self.folder / "body.vtp").write_text(text)
        said = self.convert("vtk_to_csv.py", "body.vtp", "out.csv")
        self.assertIn("rho is Density", said)
        self.assert_same("out.csv", 1e-8)

    def test_legacy_vtk_as_dualsphysics_writes_it(self):
        import numpy

        s, n = self.start, 403  # three of them walls
        place = numpy.zeros((n, 3))
        place[:400, 0], place[:400, 2] = s["x"], s["y"]
        velocity = numpy.zeros((n, 3))
        velocity[:400, 0], velocity[:400, 2] = s["vx"], s["vy"]
        with open(self.folder / "PartFluid_0001.vtk", "wb") as file:
            def put(text, values=None, kind=">f4"):
                file.write(text.encode() + b"\n")
                if values is not None:
                    file.write(numpy.asarray(values).astype(kind).tobytes() + b"\n")

            put("# vtk DataFile Version 3.0\nParticles\nBINARY\nDATASET POLYDATA")
            put(f"POINTS {n} float", place)
            put(f"VERTICES {n} {2 * n}", numpy.stack([numpy.ones(n), numpy.arange(n)], axis=1), ">i4")
            put(f"POINT_DATA {n}\nSCALARS Idp unsigned_int\nLOOKUP_TABLE default", numpy.arange(n), ">u4")
            put("FIELD FieldData 4")
            put(f"Vel 3 {n} float", velocity)
            put(f"Rhop 1 {n} float", [*s["rho"], 1, 1, 1])
            put(f"Press 1 {n} float", [*s["P"], 0, 0, 0])
            put(f"Type 1 {n} unsigned_char", [3] * 400 + [0] * 3, ">u1")
        said = self.convert("vtk_to_csv.py", "PartFluid_0001.vtk", "out.csv", "--time", "0.1", "--plane", "xz", "--mass", "0.0025")
        self.assertIn("3 particles of other types", said)
        self.assert_same("out.csv", 2e-6)

    def test_csv_as_dualsphysics_writes_it(self):
        s = self.start
        lines = ["Pos.x [m];Pos.y [m];Pos.z [m];Idp;Vel.x [m/s];Vel.y [m/s];Vel.z [m/s];Rho [kg/m^3];Press [Pa];Type;"]
        for i in range(400):
            lines.append(f"{s['x'][i]:.8g};0;{s['y'][i]:.8g};{i};{s['vx'][i]:.8g};0;{s['vy'][i]:.8g};{s['rho'][i]:.8g};"
                         f"{s['P'][i]:.8g};3;")  # fmt: skip
        lines.append("0;0;0;400;0;0;0;1;1;0;")
        (self.folder / "PartCsv_0001.csv").write_text("\n".join(lines) + "\n")
        self.convert("dualsphysics_to_csv.py", "PartCsv_0001.csv", "out.csv", "--time", "0.1", "--spacing", "0.05", "--plane", "xz")
        self.assert_same("out.csv", 1e-6)
        self.convert("dualsphysics_to_csv.py", "plain.csv", "out.csv", "--time", "0.1", "--mass", "1", fails="Pos.x")

    def test_what_sarracen_gives_of_a_dump_of_phantom(self):
        """With a stand-in for the library, which is not packaged: the frame and parameters that its documentation names."""
        (self.folder / "sarracen.py").write_text(
            "import pandas\n"
            "def read_phantom(path):\n"
            "    frame = pandas.DataFrame({'x': [0.25, 0.75, 0.5], 'y': [0.0, 0.0, 0.0], 'z': [0.0] * 3, 'vx': [1.0, -1.0, 0.0],\n"
            "                              'u': [2.0, 3.0, 4.0], 'h': [0.1, 0.2, -1.0]})\n"
            "    frame.__class__._metadata = ['params']\n"
            "    frame.params = {'mass': 0.5, 'hfact': 1.2, 'time': 0.1, 'gamma': 1.4}\n"
            "    return [frame, None]\n"
        )
        if not there_is("pandas"):
            self.skipTest("python3-pandas is missing")
        done = subprocess.run([PYTHON, str(FOLDER / "sarracen_to_csv.py"), "dump", "out.csv"], cwd=self.folder,
                              env={"PYTHONPATH": str(self.folder)}, capture_output=True, text=True)  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)
        comments, columns = read_csv(self.folder / "out.csv")
        self.assertEqual(comments, ["# time = 0.1", "# gamma = 1.4"])
        self.assertEqual(columns["e"], [2.0, 3.0])
        self.assertEqual(columns["m"], [0.5, 0.5])
        for rho, h in zip(columns["rho"], (0.1, 0.2)):
            self.assertAlmostEqual(rho, 0.5 * (1.2 / h) ** 3, delta=1e-12 * rho)


@unittest.skipUnless(there_is("pysph"), "python3-pysph is missing")
class PySPH(Codes):
    """PySPH's own schemes, run by the harness and by hand, beside ours."""

    def run_example(self, name, **changes):
        study = json.loads((FOLDER / "pysph" / name).read_text())
        study.update(changes)
        text = json.dumps(study).replace("{here}", str(FOLDER / "pysph"))
        (self.folder / "study.json").write_text(text)
        done = self.run_program("study", self.folder / "study.json", "-o", self.folder / "results.json", timeout=280)
        self.assertEqual(done.returncode, 0, done.stderr)
        document = strict_json((self.folder / "results.json").read_text())
        self.assert_valid("sphverify-results-1", document)
        return document

    def test_heat_between_walls_by_the_harness_and_by_hand(self):
        document = self.run_example("heat.json", resolution=[16, 32, 64])
        theirs = [run for run in document["runs"] if run["formulation"] == "external/pysph"]
        ours = [run for run in document["runs"] if run["formulation"] == "conduction/brookshaw"]
        self.assertEqual([run["status"] for run in theirs], ["ok"] * 3, [run["reason"] for run in theirs])
        # The same equation with another wall: both end at its floor on a lattice, h/dx 1.2.
        for a, b in zip(theirs, ours):
            self.assertAlmostEqual(a["errors"]["temperature"]["interior"]["l2"] / b["errors"]["temperature"]["interior"]["l2"], 1.0,
                                   delta=0.5)  # fmt: skip
        path, _ = self.particles("conduction/slab-dirichlet", "-n", "32", "--format", "pysph", name="initial.hdf5")
        subprocess.run([PYTHON, str(FOLDER / "pysph" / "run_case.py"), str(path), "final.hdf5", f"{path}.case.json"],
                       cwd=self.folder, check=True, capture_output=True)  # fmt: skip
        by_hand = self.assess([{"file": "final.hdf5", "resolution": 32}], case="conduction/slab-dirichlet", name="pysph")
        self.assertEqual(by_hand["runs"][0]["errors"], theirs[1]["errors"])

    def test_gas_in_one_study_one_page_and_one_gate_file(self):
        document = self.run_example("gas.json", resolution=[50, 100], repeat=1)
        self.assertEqual({run["status"] for run in document["runs"]}, {"ok"}, [run["reason"] for run in document["runs"]])
        self.assertEqual({run["formulation"] for run in document["runs"]},
                         {"momentum/p-rho2", "external/pysph-gsph", "external/pysph-mpm"})  # fmt: skip
        sod = {run["formulation"]: run["errors"]["density"]["all"]["l1"] for run in document["runs"]
               if run["case"] == "hydro/riemann" and run["resolution"] == 100}  # fmt: skip
        for error in sod.values():  # of a density from 0.125 to 1
            self.assertLess(error, 0.05)
        gates = {"schema": "sphverify-gates/1", "gates": [
            {"name": "all of them run", "select": {"case": "hydro/riemann"}, "measure": "status", "equals": "ok", "runs": 6},
            {"name": "Sod", "select": {"case": "hydro/riemann", "formulation": ["external/pysph-gsph", "momentum/p-rho2"]},
             "measure": "error", "field": "density", "norm": "l1", "region": "all", "maximum": 0.05}]}  # fmt: skip
        (self.folder / "gates.json").write_text(json.dumps(gates))
        self.succeed("gate", self.folder / "results.json", self.folder / "gates.json")
        self.succeed("report", self.folder / "results.json", "-o", self.folder / "page.html")
        page = (self.folder / "page.html").read_text()
        self.assertIn("external/pysph-gsph", page)


if __name__ == "__main__":
    unittest.main()
