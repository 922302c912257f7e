# SPDX-License-Identifier: GPL-3.0-or-later
"""What the packages hold that cpack makes of a finished build: BUILD is its folder, SPHVERIFY_SOURCE_DIR the sources."""

import gzip
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["BUILD"])
SOURCE = pathlib.Path(os.environ["SPHVERIFY_SOURCE_DIR"])
VERSION = re.search(r"VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text().split("project(")[1])[1]
DOCUMENTS = "usr/share/doc/sphverify/"


def run(*command, **options):
    return subprocess.run(list(map(str, command)), check=True, capture_output=True, **options).stdout


def names_below(folder, pattern="*"):
    return {str(path.relative_to(folder)) for path in folder.rglob(pattern) if path.is_file()}


@unittest.skipUnless(all(map(shutil.which, ("cpack", "dpkg-deb", "dpkg-shlibdeps", "file"))), "dpkg-dev or file is not installed")
class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="sphverify-packages-")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        run("cpack", "-B", cls.folder, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=none", cwd=BUILD)
        cls.package = {}
        for name in ("sphverify", "sphverify-dev"):
            (deb,) = pathlib.Path(cls.folder).glob(f"{name}_{VERSION}-*.deb")
            cls.package[name] = tarfile.open(fileobj=io.BytesIO(run("dpkg-deb", "--fsys-tarfile", deb)))
        cls.depends = {name: run("dpkg-deb", "-f", next(pathlib.Path(cls.folder).glob(f"{name}_*.deb")), "Depends").decode()
                       for name in cls.package}

    def files(self, name):
        return {member.name.removeprefix("./") for member in self.package[name].getmembers() if not member.isdir()}

    def text(self, path):
        return self.package["sphverify"].extractfile("./" + path).read()

    def test_nothing_stands_outside_of_usr_or_may_be_written_by_others(self):
        for package in self.package.values():
            for member in package.getmembers():
                self.assertRegex(member.name, r"^\.(/usr(/.*)?)?/?$")
                self.assertEqual((member.uid, member.gid), (0, 0), member.name)
                if not member.issym():
                    self.assertEqual(member.mode & 0o022, 0, member.name)
                self.assertNotRegex(member.name, r"node_modules|__pycache__|\.pyc$")

    def test_the_program_comes_with_what_its_users_read(self):
        files = self.files("sphverify")
        self.assertIn("usr/bin/sphverify", files)
        self.assertIn("usr/include/sphverify/plugin.h", files)
        for below, source in (("usr/share/sphverify/schema/", SOURCE / "reports" / "schema"),
                              ("usr/share/sphverify/studies/", SOURCE / "cases" / "studies"),
                              (DOCUMENTS + "docs/", SOURCE / "docs")):
            expected = names_below(source)
            self.assertGreater(len(expected), 10)
            self.assertEqual({below + name for name in expected} - files, set())
        for name in ("README.md", "CITATION.cff", "copyright", "changelog.gz", "changelog.Debian.gz", "examples/state.json",
                     "examples/own-parts/CMakeLists.txt", "examples/plugin-c/p_rho2.c"):
            self.assertIn(DOCUMENTS + name, files)
        self.assertEqual([name for name in files if re.search(r"\.(a|hpp|cmake)$", name) and "/examples/" not in name], [])

    def test_the_other_package_is_what_a_program_of_ones_own_is_built_against(self):
        files = self.files("sphverify-dev")
        for room in ("formulations", "cases", "reports", "harness", "program"):
            self.assertTrue(any(name.endswith(f"/libsphverify_{room}.a") for name in files), room)
        for name in ("sphverify-config.cmake", "SphverifyAddProgram.cmake", "program_main.cpp.in"):
            self.assertTrue(any(file.endswith("/cmake/sphverify/" + name) for file in files), name)
        headers = {f"usr/include/sphverify/{room}/{name}" for room in ("formulations", "cases", "reports", "harness")
                   for name in names_below(SOURCE / room, "*.hpp")}
        self.assertGreater(len(headers), 200)
        self.assertEqual(headers - files, set())
        self.assertEqual(files & self.files("sphverify"), set())

    def test_whatever_is_installed_is_in_a_package(self):
        scripts = [*BUILD.rglob("cmake_install.cmake")]
        found = {component for script in scripts if "own-parts" not in str(script)
                 for component in re.findall(r'CMAKE_INSTALL_COMPONENT STREQUAL "([^"]*)"', script.read_text())}
        self.assertEqual(found, {"program", "dev", "plain"}, "a component that no package takes")

    def test_running_it_needs_no_petsc(self):
        depends = self.depends["sphverify"]
        self.assertIn("libsundials-cvodes6", depends)  # or else dpkg-shlibdeps was not asked
        self.assertNotRegex(depends, r"petsc|mpi|sunlinsol|-dev\b")  # Debian's libsundials-sunlinsol3 draws in PETSc

    def test_the_other_package_fits_the_program_to_the_build(self):
        self.assertRegex(self.depends["sphverify-dev"], rf"sphverify \(= {re.escape(VERSION)}-1\)")
        for package in ("libsundials-dev", "libeigen3-dev", "nlohmann-json3-dev", "libcli11-dev", "libtbb-dev", "libgsl-dev"):
            self.assertIn(package, self.depends["sphverify-dev"])

    def test_licences_and_changes_are_said_as_debian_wants(self):
        copyright_file = self.text(DOCUMENTS + "copyright").decode()
        self.assertTrue(copyright_file.startswith("Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/"))
        used = set(re.findall(r"^License: (.+)$", copyright_file, re.MULTILINE))
        self.assertEqual(used, set(re.findall(r"^License: (.+)\n ", copyright_file, re.MULTILINE)), "a licence without its text")
        self.assertIn("GPL-3+", used)
        described = re.findall(r"^Files: (.+)$", copyright_file, re.MULTILINE)
        for library in ("d3", "@observablehq/plot"):
            self.assertIn(f"reports/page/node_modules/{library}/*", described)
        self.assertEqual(gzip.decompress(self.text(DOCUMENTS + "changelog.gz")), (SOURCE / "CHANGELOG.md").read_bytes())
        self.assertRegex(gzip.decompress(self.text(DOCUMENTS + "changelog.Debian.gz")).decode(),
                         rf"\Asphverify \({re.escape(VERSION)}-1\) bookworm; urgency=medium\n\n  \* Made of commit [0-9a-f]{{12}}")


class Release(unittest.TestCase):
    @unittest.skipUnless((SOURCE / "reports" / "page" / "node_modules").exists(), "npm installed nothing in reports/page")
    def test_the_list_of_licences_is_up_to_date(self):
        check = subprocess.run([sys.executable, SOURCE / "tools" / "copyright", "--check"], capture_output=True, text=True)
        self.assertEqual(check.returncode, 0, check.stderr)

    def test_the_citation_names_the_version(self):
        lines = (SOURCE / "CITATION.cff").read_text().splitlines()
        self.assertEqual(lines[0], "cff-version: 1.2.0")
        self.assertIn(f"version: {VERSION}", lines)

    @unittest.skipUnless((SOURCE / ".git").exists() and shutil.which("git") and shutil.which("cpack"), "no git repository")
    def test_the_source_archive_holds_what_is_committed(self):
        with tempfile.TemporaryDirectory(prefix="sphverify-source-") as folder:
            run("cpack", "--config", "CPackSourceConfig.cmake", "-G", "TGZ", "-B", folder, cwd=BUILD)
            with tarfile.open(f"{folder}/sphverify-{VERSION}.tar.gz") as archive:
                found = {member.name for member in archive.getmembers() if not member.isdir()}
                commit = archive.extractfile(f"sphverify-{VERSION}/cmake/archived_commit.txt").read().decode()
        committed = run("git", "-C", SOURCE, "ls-tree", "-r", "-z", "--name-only", "HEAD").decode().split("\0")
        self.assertEqual(found, {f"sphverify-{VERSION}/{name}" for name in committed if name})
        self.assertEqual(commit.split()[0], run("git", "-C", SOURCE, "rev-parse", "HEAD").decode().strip())


if __name__ == "__main__":
    unittest.main()
