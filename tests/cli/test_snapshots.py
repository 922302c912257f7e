# SPDX-License-Identifier: GPL-3.0-or-later
"""HDF5 snapshots as SWIFT, Gadget, GIZMO and PySPH write them, and ours: written by h5py with the names, types and attributes
of those codes, and read by `assess`; and what `particles` writes, read back by h5py."""

import sys

sys.dont_write_bytecode = True

import json
import math
import os
import struct
import unittest

from program import USER_ERROR
from test_codes import Codes, read_csv, write_csv

try:
    import h5py
    import numpy
except ImportError:
    h5py = None

GRESHO = {"id": "hydro/gresho", "parameters": {"final_time": 0.1}}
SWIFT_GAMMA = 1.778002  # support over 2 sigma, cubic spline in 2D (swiftsim, kernel_hydro.h)


@unittest.skipUnless(h5py, "python3-h5py is missing")
class Snapshots(Codes):
    def setUp(self):
        super().setUp()
        path, self.sheet = self.particles("hydro/gresho", "-n", "24", "-p", "final_time=0.1")
        _, columns = read_csv(path)
        self.start = {name: numpy.array(values) for name, values in columns.items()}
        self.plain = self.assessed_plain()

    def assessed_plain(self):
        write_csv(self.folder / "plain.csv", {k: list(map(float, v)) for k, v in self.start.items()}, 0.1)
        return self.assess([{"file": "plain.csv", "resolution": 24}], case=GRESHO)["runs"][0]

    def vectors(self, names, shift=0.0):
        return numpy.stack([self.start[name] + shift for name in names] + [numpy.zeros(576)], axis=1)

    def write_swift(self, name="snap_0001.hdf5", **changes):
        """As swiftsim's common_io.c and hydro_io.h do: doubles for coordinates, else floats; a box that begins at 0."""
        order = numpy.random.default_rng(1).permutation(576)  # which is not kept
        with h5py.File(self.folder / name, "w") as file:
            header = file.create_group("Header")
            header.attrs["Time"] = numpy.array([changes.get("time", 0.1)])
            header.attrs["BoxSize"] = numpy.array([1.0, 1.0, 1.0])
            header.attrs["Dimension"] = numpy.array([2], dtype="i4")
            header.attrs["Redshift"] = numpy.array([0.0])
            header.attrs["Scale-factor"] = numpy.array([changes.get("scale_factor", 1.0)])
            header.attrs["NumPart_ThisFile"] = numpy.array([576, 0, 0, 0, 0, 0, 0], dtype="i8")
            header.attrs["NumPart_Total"] = numpy.array([576, 0, 0, 0, 0, 0, 0], dtype="u4")
            header.attrs["MassTable"] = numpy.zeros(7)
            header.attrs["Code"] = numpy.bytes_("SWIFT")
            scheme = file.create_group("HydroScheme")
            scheme.attrs["Adiabatic index"] = changes.get("gamma", 1.4)
            scheme.attrs["Kernel function"] = numpy.bytes_("Cubic spline (M4)")
            if changes.get("kernel_gamma", True):
                scheme.attrs["Kernel gamma"] = numpy.array([SWIFT_GAMMA], dtype="f4")
            gas = file.create_group("PartType0")
            gas["Coordinates"] = numpy.mod(self.vectors("xy", 0.5), 1.0)[order]
            gas["Velocities"] = self.vectors(["vx", "vy"])[order].astype("f4")
            for set_name, column in (("Masses", "m"), ("InternalEnergies", "e"), ("Densities", "rho"), ("Pressures", "P")):
                gas[set_name] = self.start[column][order].astype("f4")
            gas["SmoothingLengths"] = (2 * self.start["h"] / SWIFT_GAMMA)[order].astype("f4")
            gas["ParticleIDs"] = order.astype("u8") + 1
            file["GasParticles"] = h5py.SoftLink("/PartType0")
        return name

    def write_gadget(self, name, part=slice(None), **changes):
        """As GIZMO's io.c does: floats, h the support, one mass in the header's table, walls as another type."""
        with h5py.File(self.folder / name, "w") as file:
            header = file.create_group("Header")
            header.attrs["Time"] = changes.get("time", 0.1)
            header.attrs["Redshift"] = 0.0
            header.attrs["BoxSize"] = 1.0
            header.attrs["MassTable"] = numpy.array([1 / 576, 0, 0, 0, 0, 0])
            header.attrs["NumFilesPerSnapshot"] = 1
            header.attrs["ComovingIntegrationOn"] = changes.get("comoving", 0)
            gas = file.create_group("PartType0")
            gas["Coordinates"] = self.vectors("xy")[part].astype("f4")
            gas["Velocities"] = self.vectors(["vx", "vy"])[part].astype("f4")
            gas["InternalEnergy"] = self.start["e"][part].astype("f4")
            gas["Density"] = self.start["rho"][part].astype("f4")
            gas["SmoothingLength"] = (2 * self.start["h"])[part].astype("f4")
            file.create_group("PartType3")["Coordinates"] = numpy.zeros((4, 3), dtype="f4")
        return name

    def write_pysph(self, name="run_00010.hdf5", arrays=("fluid", "solid"), ghosts=0):
        """As pysph.solver.output does: an array for each property, those that are not stored left empty."""
        with h5py.File(self.folder / name, "w") as file:
            data = file.create_group("solver_data")
            data.attrs["t"], data.attrs["dt"], data.attrs["count"] = 0.1, 1e-3, 100
            for array in arrays:
                place = file.create_group(f"particles/{array}/arrays")
                file.create_group(f"particles/{array}/constants")
                for prop, column in {"x": "x", "y": "y", "z": None, "u": "vx", "v": "vy", "m": "m", "rho": "rho", "h": "h",
                                     "p": "P", "e": "e"}.items():  # fmt: skip
                    values = numpy.zeros(0) if column is None else self.start[column]
                    if ghosts and column:
                        values = numpy.concatenate([values, values[:ghosts]])
                    place[prop] = values
                    place[prop].attrs["stored"] = column is not None
                place["tag"] = numpy.array([0] * 576 + [2] * ghosts, dtype="i4")
        return name

    def assert_same(self, run, tolerance):
        """The errors of the same particles in CSV, as far as the numbers' precision goes."""
        self.assertEqual(run["status"], "ok")
        self.assertEqual(run["particles"], 576)
        for field in ("density", "velocity", "pressure", "internal_energy"):
            self.assertEqual(set(run["errors"][field]), set(self.plain["errors"][field]), field)
            for norm in ("l1", "l2", "linf"):
                for region, error in self.plain["errors"][field].items():
                    self.assertAlmostEqual(run["errors"][field][region][norm], error[norm], delta=tolerance, msg=f"{field} {norm}")

    def test_swift(self):
        run = self.assess([{"file": self.write_swift(), "resolution": 24}], case=GRESHO)["runs"][0]
        self.assert_same(run, 1e-6)
        said = " | ".join(run["remarks"])
        self.assertIn("taken for the format swift", said)
        self.assertIn("positions moved by -0.5, -0.5", said)
        # Numbers of single precision are right to 6e-8 of themselves, and errors below that are none.
        error = run["errors"]["pressure"]["all"]
        self.assertLess(error["linf"], error["round_off"])
        self.assertAlmostEqual(error["round_off"], 2.0**-24 * max(self.start["P"]), delta=0.02 * 2.0**-24 * 6)
        self.assertGreater(run["errors"]["pressure"]["all"]["round_off"], 1000 * self.plain["errors"]["pressure"]["all"]["round_off"])

    def test_smoothing_lengths_are_ours_whatever_a_code_calls_so(self):
        """Regions of walls are told by h: those of a box with walls are the same."""
        box = {"id": "hydro/gresho", "parameters": {"final_time": 0.1, "boundary": "velocity"}}
        plain = self.assess([{"file": "plain.csv", "resolution": 24}], case=box)["runs"][0]
        self.assertIn("wall", plain["errors"]["velocity"])
        self.assertIn("interior", plain["errors"]["velocity"])
        for name in (self.write_swift(), self.write_gadget("g.hdf5"), self.write_pysph()):
            run = self.assess([{"file": name, "resolution": 24}], case=box)["runs"][0]
            self.assertEqual(set(run["errors"]["velocity"]), set(plain["errors"]["velocity"]))
            for region, error in plain["errors"]["velocity"].items():
                self.assertAlmostEqual(run["errors"]["velocity"][region]["scale"]["l2"], error["scale"]["l2"], delta=1e-6, msg=name)

    def test_gadget_in_parts(self):
        parts = [self.write_gadget("snap.0.hdf5", slice(0, 300)), self.write_gadget("snap.1.hdf5", slice(300, None))]
        run = self.assess([{"file": parts, "resolution": 24}], case=GRESHO)["runs"][0]
        self.assert_same(run, 1e-6)
        said = " | ".join(run["remarks"])
        for words in ("taken for the format gadget", "masses from the header's table", "left out: PartType3",
                      "2 files of one snapshot", "P from e and rho by gamma", "its kernel's support is 1 of it"):  # fmt: skip
            self.assertIn(words, said)
        self.assertEqual(set(run["errors"]["velocity"]), set(self.plain["errors"]["velocity"]))

    def test_pysph(self):
        run = self.assess([{"file": self.write_pysph(ghosts=7), "resolution": 24}], case=GRESHO)["runs"][0]
        self.assert_same(run, 1e-14)
        self.assertIn("7 ghosts left out (tag not 0)", run["remarks"])
        self.write_pysph("two.hdf5", arrays=("gas", "wall"))
        self.refused([{"file": "two.hdf5", "resolution": 24}], "arrays gas, wall", "`array`", case=GRESHO)
        run = self.assess([{"file": "two.hdf5", "resolution": 24}], case=GRESHO, array="gas")["runs"][0]
        self.assert_same(run, 1e-14)

    def test_what_we_write_comes_back(self):
        options = ["-n", "24", "-p", "final_time=0.1"]
        for format_, tolerance in (("hdf5", 0.0), ("swift", 1e-15), ("pysph", 0.0)):
            path, _ = self.particles("hydro/gresho", *options, "--format", format_, name=f"{format_}.hdf5")
            with h5py.File(path, "r+") as file:
                place, name = {"hdf5": ("/", "time"), "swift": ("Header", "Time"), "pysph": ("solver_data", "t")}[format_]
                file[place].attrs[name] = 0.1
                if format_ == "swift":
                    self.assertAlmostEqual(file["PartType0/SmoothingLength"][0], 2 * self.start["h"][0] / SWIFT_GAMMA, delta=1e-7)
                    self.assertEqual(list(file["Header"].attrs["NumPart_ThisFile"]), [576, 0, 0, 0, 0, 0])
                    self.assertGreaterEqual(file["PartType0/Coordinates"][:].min(), 0.0)
            extra = {"smoothing_length": "two-sigma", "format": "swift"} if format_ == "swift" else {}
            run = self.assess([{"file": path.name, "resolution": 24}], case=GRESHO, **extra)["runs"][0]
            self.assert_same(run, tolerance)

    def test_dead_particles_are_left_out_and_said(self):
        name = self.write_gadget("dead.hdf5")
        with h5py.File(self.folder / name, "r+") as file:
            gas = file["PartType0"]
            for set_name in list(gas):
                values = gas[set_name][:]
                del gas[set_name]
                dead = numpy.zeros_like(values[:3])
                gas[set_name] = numpy.concatenate([values, dead])
        run = self.assess([{"file": name, "resolution": 24}], case=GRESHO)["runs"][0]
        self.assert_same(run, 1e-6)
        self.assertIn("3 dead particles left out (h not positive)", run["remarks"])

    def test_bad_files_are_refused_in_one_line(self):
        def entry(name):
            return [{"file": name, "resolution": 24}]

        self.refused(entry(self.write_swift("a.hdf5", scale_factor=0.5)), "scale factor of 0.5", case=GRESHO)
        self.refused(entry(self.write_gadget("b.hdf5", comoving=1)), "comoving", case=GRESHO)
        self.refused(entry(self.write_swift("c.hdf5", gamma=5 / 3)), "gamma", "1.6666", "1.4", case=GRESHO)
        self.refused(entry(self.write_swift("d.hdf5", kernel_gamma=False)), "Kernel gamma", case=GRESHO)
        self.refused(entry(self.write_gadget("e.hdf5", time=0.2)), "time", "0.2", "0.1", case=GRESHO)
        self.refused([{"file": [self.write_gadget("f.hdf5"), self.write_gadget("g.hdf5", time=0.05)], "resolution": 24}],
                     "g.hdf5: time", case=GRESHO)  # fmt: skip
        whole = (self.folder / "f.hdf5").read_bytes()
        (self.folder / "torn.hdf5").write_bytes(whole[: len(whole) // 2])
        self.refused(entry("torn.hdf5"), "torn.hdf5", "cut short", case=GRESHO)
        (self.folder / "mark.hdf5").write_bytes(b"\x89HDF\r\n\x1a\n" + b"\0" * 100)
        self.refused(entry("mark.hdf5"), "mark.hdf5", case=GRESHO)
        with h5py.File(self.folder / "other.hdf5", "w") as file:
            file["weather"] = [1.0]
        self.refused(entry("other.hdf5"), "another kind", "PartType0", case=GRESHO)
        self.refused(entry("other.hdf5"), "PartType0", case=GRESHO, format="swift")
        with h5py.File(self.folder / "many.hdf5", "w") as file:
            file.create_group("solver_data")
            inside = file.create_group("particles")
            for k in range(5000):
                inside.create_group(str(k))
        self.refused(entry("many.hdf5"), "5000 groups", "4096", case=GRESHO)
        name = self.write_gadget("uneven.hdf5")
        with h5py.File(self.folder / name, "r+") as file:
            del file["PartType0/Density"]
            file["PartType0/Density"] = numpy.ones(5)
        self.refused(entry(name), "Density", "5 particles", "576", case=GRESHO)
        with h5py.File(self.folder / name, "r+") as file:
            del file["PartType0/Density"]
            file["PartType0/Density"] = numpy.array(["a", "b"], dtype=h5py.string_dtype())
        self.refused(entry(name), "Density", "a list of numbers", case=GRESHO)
        self.refused(entry(self.write_pysph("h.hdf5")), "no array 'gass'", case=GRESHO, array="gass")
        self.refused(entry("h.hdf5"), "map.T", "temp", case=GRESHO, map={"temperature": "temp"})
        self.refused(entry("h.hdf5"), "csv", case=GRESHO, format="csv")

    def ours(self, name="ours.hdf5", **changes):
        """A slab in our own format, as a file open for more."""
        file = h5py.File(self.folder / name, "w")
        file.attrs["schema"] = changes.get("schema", "sphverify-snapshot/1")
        file.attrs["time"] = 0.01
        file["x"] = (numpy.arange(16) + 0.5) / 16
        file["m"] = numpy.full(16, 1 / 16)
        return file

    def test_hostile_files_are_refused_too(self):
        """What a damaged or an unfriendly file may hold, each of which has ended a reader by a signal, or never."""
        entry = [{"file": "ours.hdf5", "resolution": 16}]
        texts = numpy.array(["sphverify-snapshot/1"] * 500, dtype=h5py.string_dtype())
        for schema in (texts, numpy.array([b"sphverify-snapshot/1"] * 2000, dtype="S20")):
            with self.ours(schema=schema) as file:
                file["T"] = numpy.ones(16)
            self.refused(entry, "another kind")
        with self.ours() as file:
            file.create_dataset("T", shape=(10**12,), chunks=(1024,), dtype="f8")
        self.refused(entry, "1000000000000 rows", "fits into")
        with self.ours() as file:
            file.create_dataset("T", shape=(2**60,), chunks=(1024,), dtype="f8")
        self.refused(entry, "rows")
        with self.ours() as file:
            layout = h5py.VirtualLayout((16,), "f8")
            layout[:] = h5py.VirtualSource("ours.hdf5", "T", shape=(16,))
            file.create_virtual_dataset("T", layout)
        self.refused(entry, "a virtual data set of virtual ones")
        for name in ("ours.hdf5", "other.hdf5"):  # parts of each other
            with self.ours() as file, h5py.File(self.folder / "other.hdf5", "w") as other:
                for one, of, part, of_part in ((file, "T", "other", name), (file if name == "ours.hdf5" else other, "other", "T", "ours.hdf5")):
                    layout = h5py.VirtualLayout((16,), "f8")
                    layout[:] = h5py.VirtualSource(of_part, part, shape=(16,))
                    one.create_virtual_dataset(of, layout)
            self.refused(entry, "a virtual data set of virtual ones")
        with self.ours() as file:
            file.create_dataset("T", (16,), "f8", external=[("/dev/urandom", 0, 128)])
        self.refused(entry, "T", "in another file")
        with self.ours() as file:
            file["T"] = h5py.ExternalLink("elsewhere.hdf5", "T")
        self.refused(entry, "T")
        for tag in (numpy.zeros((576, 0)), numpy.ones(5)):
            name = self.write_pysph("tags.hdf5", arrays=("fluid",))
            with h5py.File(self.folder / name, "r+") as file:
                del file["particles/fluid/arrays/tag"]
                file["particles/fluid/arrays/tag"] = tag
            self.refused([{"file": name, "resolution": 24}], "tag", case=GRESHO)

    def test_parts_are_as_rough_as_the_roughest_and_may_be_empty(self):
        parts = []
        for k, kind in enumerate(("f8", "f4", "f2")):
            name = f"part{k}.hdf5"
            x = (numpy.arange(16) + 0.5) / 16
            mine = slice(0, 8) if k == 0 else slice(8, 16)
            with h5py.File(self.folder / name, "w") as file:
                file.attrs["schema"], file.attrs["time"] = "sphverify-snapshot/1", 0.01
                file["x"], file["m"], file["T"] = x[mine], numpy.full(8, 1 / 16), (1 + x[mine]).astype(kind)
            parts.append(name)
        with h5py.File(self.folder / "empty.hdf5", "w") as file:
            file.attrs["schema"], file.attrs["time"] = "sphverify-snapshot/1", 0.01
            for name in ("x", "m", "T"):
                file[name] = numpy.zeros(0)
        for files, rounding in ((parts[:2], 2.0**-24), (parts[1::-1], 2.0**-24), ([parts[0], "empty.hdf5", parts[2]], 2.0**-11)):
            run = self.assess([{"file": files, "resolution": 16}])["runs"][0]
            error = run["errors"]["temperature"]["all"]
            self.assertAlmostEqual(error["round_off"] / error["scale"]["linf"], rounding, delta=1e-3 * rounding)

    def test_formats_of_single_precision_end_in_a_floor(self):
        """A code that is right to the last bit of single precision converges no further, and the verdict says so."""
        entries = []
        for n in (16, 32, 64, 128):
            path, _ = self.particles("conduction/slab-dirichlet", "-n", str(n), "-p", "final_time=0.01", "--format", "hdf5",
                                     name=f"n{n}.hdf5")  # fmt: skip
            x = [(i + 0.5) / n for i in range(n)]
            T = self.exact("conduction/slab-dirichlet", 0.01, [repr(one) for one in x])["temperature"]
            with h5py.File(path, "r+") as file:
                del file["T"]
                file["T"] = numpy.array(T, dtype="f4")
                file.attrs["time"] = 0.01
            entries.append({"file": path.name, "resolution": n})
        document = self.assess(entries)
        order = next(one for one in document["series"][0]["orders"] if one["norm"] == "l2" and one["region"] == "all")
        self.assertEqual(order["verdict"], "floored")
        self.assertIsNone(order["order"])


if __name__ == "__main__":
    unittest.main()
