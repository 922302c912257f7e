# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs sphverify for the tests of the command line, in a folder that is removed afterwards."""

import copy
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import jsonschema

PROGRAM = os.path.abspath(os.environ["SPHVERIFY"])  # build/release/sphverify
SOURCE_DIR = pathlib.Path(os.environ["SPHVERIFY_SOURCE_DIR"]).resolve()  # root of this repository
SCHEMA_DIR = SOURCE_DIR / "reports" / "schema"

DONE, GATE_FAILED, USER_ERROR, PROGRAM_ERROR = 0, 1, 2, 3

TIMES = ("seconds", "median_seconds", "low_seconds", "high_seconds")

PLACE = re.compile(r"(\.json):\d+:\d+(?=: )")

SECONDS_FOR_AN_ANSWER = 10  # what no refusal of bad input may take, even on a busy machine


def strict_json(text):
    """Parses JSON and refuses NaN and Infinity, which Python alone would take."""

    def refuse(constant):
        raise ValueError(f"{constant} is not JSON")

    return json.loads(text, parse_constant=refuse)


def load_schemas():
    schemas = {}
    for path in sorted(SCHEMA_DIR.glob("*.schema.json")):
        schema = strict_json(path.read_text())
        schemas[path.name.removesuffix(".schema.json")] = schema
    return schemas


SCHEMAS = load_schemas()


def validator(name):
    """For a schema such as `sphverify-results-1`; references between schemas are found without a network."""
    schema = SCHEMAS[name]
    store = {one["$id"]: one for one in SCHEMAS.values()}
    resolver = jsonschema.RefResolver.from_schema(schema, store=store)
    return jsonschema.Draft202012Validator(schema, resolver=resolver)


def complaints(name, document):
    """What a schema finds wrong, as text; of a choice between schemas, what the likeliest finds."""
    errors = validator(name).iter_errors(document)
    likeliest = (jsonschema.exceptions.best_match([error]) for error in errors)
    return [f"{error.json_path}: {error.message[-300:]}" for error in likeliest]


def small_study(**changes):
    """A study of a few milliseconds, with keys replaced (or removed, where the value is None)."""
    study = {
        "schema": "sphverify-study/1",
        "name": "small",
        "cases": [{"id": "conduction/slab-dirichlet", "parameters": {"final_time": 0.01}}],
        "formulations": ["conduction/brookshaw"],
        "discretisation": {"density": "given", "layout": "lattice"},
        "resolution": [8, 12, 16],
    }
    study.update(changes)
    return {key: value for key, value in study.items() if value is not None}


def timeless(results):
    """Results without what differs from one execution to the next: context and times."""
    results = copy.deepcopy(results)
    del results["context"]
    results.pop("shares", None)
    for run in results["runs"]:
        if run["cost"]:
            for key in ("cpu_seconds", "setup_seconds", "busy", "batch", "machine", "occasion", "round_seconds", *TIMES):
                del run["cost"][key]
    for series in results["series"]:
        for order in series["orders"]:
            for level in order["levels"]:
                for key in TIMES:
                    del level[key]
        for target in series["time_to_error"]:
            for key in TIMES:
                target[key] = target[key] is not None
    for surface in results.get("surfaces", []):
        for cell in surface["cells"]:
            del cell["seconds"]
        surface["paths"] = [path for path in surface["paths"] if path["unit"] != "seconds"]
    return results


def mutated(document, path, value):
    """A copy in which the value at a path, such as ("runs", 0, "status"), is another."""
    changed = copy.deepcopy(document)
    place = changed
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = value
    return changed


def without(document, path):
    changed = copy.deepcopy(document)
    place = changed
    for step in path[:-1]:
        place = place[step]
    del place[path[-1]]
    return changed


def environment(**changes):
    """Of a program that nobody tells how wide or how coloured its text is, with changes."""
    told = ("COLUMNS", "NO_COLOR", "TERM")
    return {name: value for name, value in os.environ.items() if name not in told} | changes


class ProgramTest(unittest.TestCase):
    maxDiff = 2000

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sphverify-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def start(self, *arguments, **options):
        """The program under way."""
        options = {
            "stdin": subprocess.DEVNULL,
            "stdout": subprocess.PIPE,
            "stderr": subprocess.PIPE,
            "cwd": self.folder,
            "env": environment(),
            **options,
        }
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], **options)

        def end():
            if process.poll() is None:
                process.kill()
            process.communicate()

        self.addCleanup(end)
        return process

    def run_program(self, *arguments, text=None, timeout=120, env=None):
        """A finished process with its output as text."""
        return subprocess.run(
            [PROGRAM, *map(str, arguments)],
            input="" if text is None else text,
            capture_output=True,
            cwd=self.folder,
            timeout=timeout,
            env=env or environment(),
            encoding="utf-8",
            errors="replace",
        )

    def succeed(self, *arguments, text=None, env=None):
        """Standard output of a command that must succeed."""
        result = self.run_program(*arguments, text=text, env=env)
        self.assertEqual(result.returncode, DONE, result.stderr)
        return result.stdout

    def write(self, name, document):
        """Writes text, bytes or a document, and gives the path."""
        path = self.folder / name
        if isinstance(document, bytes):
            path.write_bytes(document)
        else:
            path.write_text(document if isinstance(document, str) else json.dumps(document))
        return path

    def study(self, document, name="results.json", *options):
        """Runs a study into a file and gives the results document."""
        study = self.write(f"study-of-{name}", document)
        self.succeed("study", study, "-o", self.folder / name, *options)
        return strict_json((self.folder / name).read_text())

    def assert_valid(self, schema, document):
        self.assertEqual(complaints(schema, document)[:5], [])

    def assert_user_error(self, result, *words):
        """Exit status 2, nothing on standard output, and one line that holds all words. They may leave out where in a file
        something stands, FILE:LINE:COLUMN: test_places.py looks at that."""
        self.assertEqual(result.returncode, USER_ERROR, f"stderr: {result.stderr[:500]}")
        self.assertEqual(result.stdout, "")
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr[:500])
        self.assertTrue(result.stderr.endswith("\n"), result.stderr[:500])
        placeless = PLACE.sub(r"\1", result.stderr)
        for word in words:
            if str(word) not in placeless:
                self.assertIn(str(word), result.stderr)
