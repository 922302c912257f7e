# SPDX-License-Identifier: GPL-3.0-or-later
"""Carries out CI jobs as GitHub Actions and GitLab CI do, as far as the examples in examples/ci need it.

Commands run as they stand, in the shell that the service would use. What comes from outside is a stand-in: programs
that install and compile (STAND_INS) are noted and do nothing, but `cmake --build` leaves the program that is tested.
"""

import os
import re
import shutil
import subprocess

import yaml
from program import PROGRAM, SOURCE_DIR

STAND_INS = ("apt-get", "npm", "dpkg-query", "sudo", "cmake")
STAND_IN = """#!/bin/sh
echo "{name} $*" >> "{calls}"
case "{name} $*" in
  "sudo "*) exec "$@" ;;
  "cmake --build "*) mkdir -p build/release && ln -s "{program}" build/release/sphverify ;;
esac
"""


class Job:
    """What a job left: `log` of its steps, `failed` (name of the step that ended it, or None) and its `status`."""

    def __init__(self):
        self.log = ""
        self.failed = None
        self.status = 0


class Pipelines:
    """A place where jobs of one project run: project, a repository of sphverify, and a cache."""

    def __init__(self, folder):
        self.project = folder / "project"
        self.sphverify = folder / "sphverify-repository"
        self.cache = folder / "cache"
        self.calls = folder / "calls"
        self.summary = folder / "summary.md"
        self.outputs = folder / "outputs"
        programs = folder / "stand-ins"
        for place in (self.project, self.sphverify, self.cache, programs):
            place.mkdir()
        for name in STAND_INS:
            path = programs / name
            path.write_text(STAND_IN.format(name=name, calls=self.calls, program=PROGRAM))
            path.chmod(0o755)
        clean = {key: value for key, value in os.environ.items() if not key.startswith(("GITHUB_", "GIT_"))}
        self.environment = {
            **clean,
            "HOME": str(folder),  # for `git config --global`
            "PATH": f"{programs}:{os.environ['PATH']}",
            "PYTHONDONTWRITEBYTECODE": "1",
        }
        self.git(self.project, "init", "--quiet")

    def git(self, repository, *arguments):
        identity = ("-c", "user.name=test", "-c", "user.email=test@example.org")
        command = ["git", *identity, "-C", str(repository), *arguments]
        return subprocess.run(command, check=True, capture_output=True, text=True, env=self.environment).stdout

    def publish_sphverify(self, tag):
        """The parts of sphverify that a pipeline touches before there is a program, under a tag."""
        shutil.copytree(SOURCE_DIR / "tools", self.sphverify / "tools")
        page = self.sphverify / "reports" / "page"
        page.mkdir(parents=True)
        shutil.copy(SOURCE_DIR / "reports" / "page" / "package-lock.json", page)
        self.git(self.sphverify, "init", "--quiet")
        self.git(self.sphverify, "add", "--all")
        self.git(self.sphverify, "commit", "--quiet", "--message", "a version")
        self.git(self.sphverify, "tag", tag)

    def called(self):
        """What was asked of the stand-ins since the last look, one line each."""
        lines = self.calls.read_text().splitlines() if self.calls.exists() else []
        self.calls.unlink(missing_ok=True)
        return lines

    def shell(self, command, job, name, **variables):
        """Runs a command line in the project; a status other than 0 ends the job."""
        result = subprocess.run(
            command,
            cwd=self.project,
            env={**self.environment, **variables},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
            timeout=200,
        )
        job.log += result.stdout
        if result.returncode != 0 and job.failed is None:
            job.failed, job.status = name, result.returncode

    def fetch_from_cache(self, key, path):
        if not (self.cache / key).exists():
            return False
        (self.project / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(self.cache / key, self.project / path, follow_symlinks=False)
        return True

    def put_into_cache(self, key, path):
        if (self.project / path).exists() and not (self.cache / key).exists():
            shutil.copy(self.project / path, self.cache / key, follow_symlinks=False)

    def start(self):
        """A fresh checkout, as every job has."""
        self.git(self.project, "add", "--all", ":!sphverify")
        self.git(self.project, "commit", "--quiet", "--allow-empty", "--message", "a change")
        self.git(self.project, "clean", "-ffdx", "--quiet")


class GitHub(Pipelines):
    """Runs the only job of .github/workflows/sphverify.yml, whose container has `sh -e` for commands."""

    def run(self):
        workflow = yaml.safe_load((self.project / ".github" / "workflows" / "sphverify.yml").read_text())
        [definition] = workflow["jobs"].values()
        if definition["container"] != "debian:12" or "shell" in definition.get("defaults", {}):
            raise AssertionError("another container may have another shell")
        self.start()
        self.summary.unlink(missing_ok=True)
        self.context = {f"env.{key}": value for key, value in workflow["env"].items()} | {"runner.arch": "X64"}
        self.kept = []
        job = Job()
        for number, step in enumerate(definition["steps"]):
            if self.wanted(step.get("if", "success()"), job):
                self.step(step, step.get("name", f"step {number}"), job)
        return job

    def wanted(self, condition, job):
        if condition == "always()":
            return True
        if job.failed is not None:
            return False
        if condition == "success()":
            return True
        name, text = re.fullmatch(r"(\S+) != '(.*)'", condition).groups()
        return self.context[name] != text

    def fill(self, text):
        """Expressions replaced by what the context holds."""
        return re.sub(r"\$\{\{ (\S+) \}\}", lambda found: self.context[found[1]], text)

    def step(self, step, name, job):
        given = {key: self.fill(value) for key, value in step.get("with", {}).items()}
        action = step.get("uses", "").partition("@")[0]
        if "run" in step:
            self.outputs.write_text("")
            variables = {
                "GITHUB_ACTIONS": "true",
                "GITHUB_STEP_SUMMARY": str(self.summary),
                "GITHUB_OUTPUT": str(self.outputs),
                "GIT_TEST_ASSUME_DIFFERENT_OWNER": "1",  # in a container files are the runner's, commands root's
            }
            self.shell(["sh", "-e", "-c", self.fill(step["run"])], job, name, **variables)
            self.note(step, dict(line.split("=", 1) for line in self.outputs.read_text().splitlines()))
        elif action == "actions/checkout":
            if "path" in given:
                arguments = ("--quiet", "--branch", given["ref"], str(self.sphverify), given["path"])
                self.git(self.project, "clone", *arguments)
        elif action == "actions/cache/restore":
            hit = self.fetch_from_cache(given["key"], given["path"])
            # Where nothing is found the output is empty.
            self.note(step, {"cache-hit": "true" if hit else "", "cache-primary-key": given["key"]})
        elif action == "actions/cache/save":
            self.put_into_cache(given["key"], given["path"])
        elif action == "actions/upload-artifact":
            self.kept = given["path"].split()
        else:
            raise AssertionError(f"nothing stands in for {action}")

    def note(self, step, outputs):
        for key, value in outputs.items():
            self.context[f"steps.{step.get('id')}.outputs.{key}"] = value


class GitLab(Pipelines):
    """Runs the only job of .gitlab-ci.yml; both of its scripts are one, in Bash, which debian:12 has."""

    def run(self):
        [(name, job_definition)] = yaml.safe_load((self.project / ".gitlab-ci.yml").read_text()).items()
        self.start()
        variables = job_definition["variables"]
        cache = job_definition["cache"]
        [cached] = cache["paths"]
        key = cache["key"].replace("$SPHVERIFY_VERSION", variables["SPHVERIFY_VERSION"])
        self.fetch_from_cache(key, cached)
        job = Job()
        script = "\n".join(job_definition["before_script"] + job_definition["script"])
        self.shell(["bash", "-e", "-o", "pipefail", "-c", script], job, name, **variables)
        if job.failed is None or cache["when"] == "always":
            self.put_into_cache(key, cached)
        artifacts = job_definition["artifacts"]
        self.kept = artifacts["paths"] if job.failed is None or artifacts["when"] == "always" else []
        self.junit = artifacts["reports"]["junit"]
        return job
