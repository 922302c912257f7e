# SPDX-License-Identifier: GPL-3.0-or-later
"""The example project of examples/ci, copied as its README says and put through its own pipelines."""

import sys

sys.dont_write_bytecode = True

import json
import re
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

from pipelines import GitHub, GitLab
from program import GATE_FAILED, PROGRAM, SOURCE_DIR, ProgramTest, strict_json

EXAMPLE = SOURCE_DIR / "examples" / "ci"
BUILT = "cmake --build --preset release --target sphverify"


def readme_commands():
    """The README's blocks of commands."""
    return re.findall(r"^```sh\n(.*?)^```", (EXAMPLE / "README.md").read_text(), re.MULTILINE | re.DOTALL)


class Example(ProgramTest):
    Service = GitHub

    def setUp(self):
        super().setUp()
        self.service = self.Service(self.folder)
        self.project = self.service.project
        self.run_in_project(readme_commands()[0].replace("../sphverify", str(SOURCE_DIR)))

    def run_in_project(self, commands):
        options = {"cwd": self.project, "env": self.service.environment, "timeout": 60, "capture_output": True}
        subprocess.run(["sh", "-eu", "-c", commands], check=True, **options)

    def replace(self, name, old, new):
        """Changes the only place of a text in a file of the project."""
        path = self.project / name
        text = path.read_text()
        self.assertEqual(text.count(old), 1, f"{name}: {old}")
        path.write_text(text.replace(old, new))

    def gates(self):
        return strict_json((self.project / "verification" / "gates.json").read_text())["gates"]

    def make_a_gate_fail(self):
        self.replace("verification/gates.json", '"maximum": 3e-4', '"maximum": 1e-4')

    def assert_kept(self, *names):
        """What the service would keep is there, and holds what was asked for."""
        for name in self.service.kept:
            self.assertTrue((self.project / name).is_file(), name)
        for name in names:
            self.assertIn(name, self.service.kept)

    def junit(self):
        suites = ElementTree.parse(self.project / "gates.xml").getroot()
        cases = suites.findall(".//testcase")
        self.assertEqual([case.get("name") for case in cases], [gate["name"] for gate in self.gates()])
        return {case.get("name"): [child.tag for child in case] for case in cases}

    def assert_passed(self, job):
        self.assertIsNone(job.failed, job.log)
        self.assertIn("passed conduction/brookshaw heating", job.log)
        self.assertRegex(job.log, r"\n7 gates: 6 passed, 1 expected-failure")
        self.assertEqual(sum("failure" in tags for tags in self.junit().values()), 0)

    def assert_failed_on_the_gate(self, job, where):
        self.assertEqual((job.failed, job.status), (where, GATE_FAILED), job.log)
        failed = [name for name, tags in self.junit().items() if "failure" in tags]
        self.assertEqual(failed, ["error"])

    def assert_built_once(self):
        called = self.service.called()
        self.assertIn(BUILT, called)
        self.assertTrue(any("install" in call and "libsundials-dev" in call for call in called), called)
        self.assert_passed(self.service.run())
        called = self.service.called()
        self.assertNotIn(BUILT, called)
        self.assertTrue(any("install" in call and "python3" in call for call in called), called)


class OnGitHub(Example):
    def setUp(self):
        super().setUp()
        text = (self.project / ".github" / "workflows" / "sphverify.yml").read_text()
        self.service.publish_sphverify(re.search(r"SPHVERIFY_VERSION: (\S+)", text)[1])

    def test_it_passes_as_it_stands_and_builds_sphverify_once(self):
        job = self.service.run()
        self.assert_passed(job)
        self.assert_kept("own-rates.json", "rates.json", "solution.json", "solution.xml", "solution.html", "results.json", "gates.xml")
        self.assertEqual(re.findall(r"^::(\w+)", job.log, re.MULTILINE), ["notice"])
        self.assertIn("2 gates: 2 passed", job.log)
        summary = self.service.summary.read_text()
        for gate in self.gates():
            self.assertIn(gate["name"], summary)
        self.assert_built_once()

    def test_a_gate_that_fails_ends_the_job_with_an_annotation_and_a_summary(self):
        self.make_a_gate_fail()
        job = self.service.run()
        self.assert_failed_on_the_gate(job, "Judge it")
        self.assertEqual(re.findall(r"^::error .*title=(.*?)::", job.log, re.MULTILINE), ["error"])
        self.assertRegex(self.service.summary.read_text(), r"failed.*error")
        self.assert_kept("results.json", "gates.xml")

    def test_a_build_is_kept_though_a_gate_fails(self):
        self.make_a_gate_fail()
        self.service.run()
        self.replace("verification/gates.json", '"maximum": 1e-4', '"maximum": 3e-4')
        self.assert_built_once()

    def test_a_solution_that_is_wrong_ends_the_job(self):
        """Right rates, and steps that are half as long as the code believes."""
        self.replace("own-code/heat.py", "t + dt * rate for", "t + 0.5 * dt * rate for")
        job = self.service.run()
        self.assertEqual((job.failed, job.status), ("Judge its solutions", GATE_FAILED), job.log)
        self.assertIn("our code's error", job.log)

    def test_rates_that_are_not_sphverify_s_end_the_job(self):
        self.replace("own-code/heat.py", "* kernel_slope(r, h) / r", "* kernel_slope(r, h) / r / 2")
        job = self.service.run()
        self.assertEqual((job.failed, job.status), ("Compare its rates", 1), job.log)
        self.assertIn("failed conduction/brookshaw heating: off by", job.log)


class OnGitLab(Example):
    Service = GitLab

    def setUp(self):
        super().setUp()
        text = (self.project / ".gitlab-ci.yml").read_text()
        self.service.publish_sphverify(re.search(r"SPHVERIFY_VERSION: (\S+)", text)[1])
        self.replace(".gitlab-ci.yml", re.search(r"SPHVERIFY_URL: (\S+)", text)[1], f"file://{self.service.sphverify}")

    def test_it_passes_as_it_stands_and_builds_sphverify_once(self):
        self.assert_passed(self.service.run())
        self.assertEqual(self.service.junit, ["solution.xml", "gates.xml"])
        self.assert_kept("own-rates.json", "rates.json", "solution.json", "solution.html", "results.json", "gates.xml", "gates.md")
        self.assert_built_once()

    def test_a_version_may_be_a_commit(self):
        commit = self.service.git(self.service.sphverify, "rev-parse", "HEAD").strip()
        self.replace(".gitlab-ci.yml", "SPHVERIFY_VERSION: v0.1.0", f"SPHVERIFY_VERSION: {commit}")
        self.assert_passed(self.service.run())

    def test_a_gate_that_fails_ends_the_job_and_its_report_is_kept(self):
        self.make_a_gate_fail()
        self.assert_failed_on_the_gate(self.service.run(), "gates")
        self.assert_kept("results.json", "gates.xml", "gates.md")
        self.assertIn(BUILT, self.service.called())
        self.service.run()
        self.assertNotIn(BUILT, self.service.called())

    def test_rates_that_are_not_sphverify_s_end_the_job(self):
        self.replace("own-code/heat.py", "* kernel(d, h) / d", "* kernel(d, h)")
        job = self.service.run()
        self.assertEqual((job.failed, job.status), ("gates", 1), job.log)
        self.assertIn("failed conduction/brookshaw heating: off by", job.log)
        self.assertFalse((self.project / "results.json").exists())


class Documents(Example):
    def test_its_documents_are_valid(self):
        self.run_in_project("python3 own-code/heat.py rates state.json own-rates.json")
        for schema, name in (
            ("study", "verification/study"), ("gates", "verification/gates"), ("state", "state"),
            ("study", "verification/solution"), ("gates", "verification/solution-gates"),
        ):
            self.assert_valid(f"sphverify-{schema}-1", strict_json((self.project / f"{name}.json").read_text()))

    def test_a_baseline_is_made_and_kept_to_as_the_readme_says(self):
        gate = strict_json(re.search(r"^```json\n(.*?)^```", (EXAMPLE / "README.md").read_text(), re.M | re.S)[1])
        document = {"schema": "sphverify-gates/1", "baseline": "baseline.json", "gates": [gate]}
        (self.project / "verification" / "gates.json").write_text(json.dumps(document))
        self.assert_valid("sphverify-gates-1", document)
        self.succeed("study", self.project / "verification" / "study.json", "-o", self.project / "results.json")
        (self.folder / "stand-ins" / "sphverify").symlink_to(PROGRAM)
        self.run_in_project(readme_commands()[1])
        self.assertIn("verification/baseline.json", self.service.git(self.project, "diff", "--cached", "--name-only"))
        judged = self.succeed("gate", self.project / "results.json", self.project / "verification" / "gates.json")
        self.assertIn("1 gate: 1 passed", judged)


if __name__ == "__main__":
    unittest.main()
