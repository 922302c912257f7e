# SPDX-License-Identifier: GPL-3.0-or-later
"""The program from Python: studies, comparisons and gates. Exit statuses 2 and 3 are exceptions with its one line."""

import io
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import pandas

from .errors import Error
from .results import load

NAME = "sphverify"
DONE, GATE_FAILED = 0, 1


def find_program(program=None):
    """What is asked for; else what the variable SPHVERIFY names, what was installed with this module, what is on PATH."""
    asked = program or os.environ.get("SPHVERIFY")
    if asked:
        found = shutil.which(asked)
        if not found:
            raise Error(f"found no program '{asked}', expected sphverify")
        return found
    above = pathlib.Path(__file__).resolve().parents  # PREFIX/lib/python3/dist-packages/sphverify, and so on
    beside = str(above[4] / "bin") if len(above) > 4 else os.devnull
    found = shutil.which(NAME, path=beside) or shutil.which(NAME)
    if not found:
        raise Error("found no program sphverify: expected it on PATH, or SPHVERIFY to name it")
    return found


def study(document, output=None, program=None, jobs=None, resume=False):
    """Runs a study and loads its results. Progress goes to sys.stderr.

    `document` is a path or the study itself, as a dict; `output` the path where the results document stays, which
    `resume` needs: it takes up the journal that an interrupted study left there, if there is one.
    """
    if resume and output is None:
        raise Error("resume: found no output, expected the path of the results whose journal is taken up")
    with tempfile.TemporaryDirectory(prefix="sphverify-") as folder:
        path = os.path.join(folder, "results.json") if output is None else os.fspath(output)
        is_text = isinstance(document, dict)
        arguments = ["study", "-" if is_text else os.fspath(document), "-o", path]
        arguments += ["--jobs", str(jobs)] if jobs is not None else []
        arguments += ["--resume"] if resume else []
        _run_with_progress(find_program(program), arguments, json.dumps(document) if is_text else "")
        results = load(path)
    if output is None:
        results.name = results.document["study"]["name"]  # the file is gone
    return results


def compare(*results, section="series", region=None, norm=None, program=None):
    """A section of `sphverify compare --format csv` (docs/compare.md) as a data frame. `results` are paths."""
    arguments = ["compare", *map(os.fspath, results), "--format", "csv", "--section", section]
    arguments += ["--region", region] if region is not None else []
    arguments += ["--norm", norm] if norm is not None else []
    text, _ = _run(program, arguments)
    # All digits of every number; and no word, such as `none`, is taken for a missing value.
    return pandas.read_csv(io.StringIO(text), float_precision="round_trip", keep_default_na=False, na_values=[""])


def gate(results, gates, program=None):
    """The verdicts of `sphverify gate` as a data frame; `holds` says whether the gate lets the results pass."""
    with tempfile.TemporaryDirectory(prefix="sphverify-") as folder:
        junit = os.path.join(folder, "gates.xml")
        text, _ = _run(program, ["gate", os.fspath(results), os.fspath(gates), "--junit", junit], (DONE, GATE_FAILED))
        cases = list(ElementTree.parse(junit).iter("testcase"))
    rows = []
    for line, case in zip(text.splitlines(), cases):  # the XML does not tell `within-noise` from `passed`
        failure = case.find("failure")
        body = (case.find("system-out") if failure is None else failure).text
        numbers, _, remarks = body.partition("\n")
        measured, _, limit = numbers.rpartition(", limit ")
        rows.append((case.get("name"), line.split()[0], failure is None, measured, limit, remarks))
    return pandas.DataFrame(rows, columns=["name", "verdict", "holds", "measured", "limit", "remarks"])


def _run(program, arguments, good=(DONE,)):
    command = [find_program(program), *arguments]
    # In a workflow of GitHub `gate` annotates what fails, among its verdicts.
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GITHUB_")}
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", env=environment)
    if done.returncode not in good:
        raise _error(command, done.returncode, done.stderr.splitlines())
    return done.stdout, done.stderr


def _run_with_progress(program, arguments, text):
    """Shows lines as they come, but for what is said of an error: the exception says it."""
    command = [program, *arguments]
    with tempfile.TemporaryFile("w+", encoding="utf-8") as document:
        document.write(text)
        document.seek(0)
        # In a session of its own, so that Ctrl-C reaches it once: the second signal kills.
        process = subprocess.Popen(command, stdin=document, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   encoding="utf-8", errors="replace", start_new_session=True)  # fmt: skip
    held = []
    try:
        for line in process.stderr:
            if line.startswith(f"{NAME}: "):
                held.append(line.rstrip("\n"))
            else:
                print(line, end="", file=sys.stderr, flush=True)
        status = process.wait()
    except BaseException:
        process.send_signal(signal.SIGINT)  # the runs in flight end, the journal is whole
        try:
            process.communicate()
        except BaseException:
            process.kill()
            process.communicate()
            raise
        raise
    finally:
        process.stderr.close()
    if status != DONE:
        raise _error(command, status, held)
    for line in held:
        print(line, file=sys.stderr, flush=True)


def _error(command, status, lines):
    if lines and status > 0:
        return Error(lines[-1].removeprefix(f"{NAME}: "), status)
    ended = f"was ended by signal {-status}" if status < 0 else f"ended with status {status}"
    return Error(f"{command[0]} {command[1]} {ended}", status)
