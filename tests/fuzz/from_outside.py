#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program from outside, on documents that were right and are not any more: values of another kind or beyond all sense, keys
gone, renamed or moved, nesting without end, bytes that are no text, ends cut off. Whatever it is given, it is done (0 or 1) or
refuses it in one line (2); it never fails itself (3), crashes or waits.

Usage: tests/fuzz/from_outside.py [--count 100] [--seed 1] [--keep FOLDER] PROGRAM
"""

import argparse
import collections
import copy
import json
import pathlib
import random
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
BESIDE = HERE / "beside"
PATIENCE = 60  # [s], on a busy machine
SIGNS = ("json.exception", "std::", "terminate called", "what():", "basic_", "vector::", "Traceback")
NOTHING = "--part=1000000/1000000"  # of a study: all is read, and no run is in the part

# Target of the corpus: commands, in which FILE is the mutated document.
COMMANDS = {
    "study": [["study", "FILE", NOTHING, "-o", "out.json"]],
    "results": [["compare", "FILE"], ["compare", "results.json", "FILE", "--section", "changes"], ["report", "FILE", "-o", "out.html"],
                ["compare", "FILE", "--format", "json"], ["gate", "FILE", "gates.json"], ["repeat", "FILE", "0", "-o", "out.json"],
                ["merge", "FILE", "-o", "out.json"]],
    "part": [["merge", "FILE", "part-2.json", "-o", "out.json"]],
    "gates": [["gate", "results.json", "FILE", "--junit", "out.xml", "--markdown", "out.md"]],
    "snapshots": [["assess", "FILE", "-o", "out.json"]],
    "state": [["evaluate", "FILE"]],
    "rates": [["evaluate", "state.json", "--against", "FILE"]],
    "order": [["order", "FILE"], ["order", "FILE", "--format", "json", "--allowed", "2"]],
    "csv": [["exact", "conduction/slab-dirichlet", "--time", "0.01", "--points-file", "FILE"]],
    "hdf5": [["exact", "conduction/slab-dirichlet", "--time", "0.01", "--points-file", "FILE"]],
}  # fmt: skip

VALUES = [None, True, 0, -1, 0.5, -0.0, 1e-320, 1e308, -1e308, 2**31, 2**53 + 1, 2**63, 2**64, "", "x", "\u2028\x1b[31m\n", "a" * 20000,
          "conduction/brookshaw", "../..", "/dev/null", [], {}, [[]], [1, "a"], {"id": 5}, {"": None}]  # fmt: skip


def places(value, path=()):
    """Paths of all values inside."""
    found = [path] if path else []
    inside = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in inside:
        found += places(one, (*path, key))
    return found


def at(document, path):
    for step in path:
        document = document[step]
    return document


def changed(document, draw):
    """One change of structure."""
    if not places(document):
        return draw.choice(VALUES)
    document = copy.deepcopy(document)
    path = draw.choice(places(document))
    parent, key = at(document, path[:-1]), path[-1]
    how = draw.randrange(7)
    if how == 0:
        del parent[key]
    elif how == 1 and isinstance(parent, dict):
        parent[draw.choice(("idd", "", "schema", key.upper(), key + "s", "\x00"))] = parent.pop(key)
    elif how == 2:
        parent[key] = copy.deepcopy(at(document, draw.choice(places(document))))
    elif how == 3 and isinstance(parent[key], list) and parent[key]:
        parent[key] = parent[key] * draw.choice((2, 50))
    elif how == 4 and isinstance(parent[key], (int, float)) and not isinstance(parent[key], bool):
        parent[key] *= draw.choice((-1, 0, 1e-9, 1e9, 1e200, 0.5))
    elif how == 5:
        for _ in range(draw.choice((1, 40, 80))):
            parent[key] = [parent[key]]
    else:
        parent[key] = draw.choice(VALUES)
    return document


def damaged(text, draw):
    """One change of bytes."""
    place = draw.randrange(len(text) + 1)
    how = draw.randrange(7)
    if how == 0:
        return text[:place]
    if how == 1:
        return text[:place] + bytes(draw.randrange(256) for _ in range(draw.choice((1, 3, 30)))) + text[place:]
    if how == 2:
        return text[:place] + draw.choice((b"\xff", b"\xc3", b"\xed\xa0\x80", b"\x00", b"NaN", b"1e999", b"//", b",,", b"-", b"'"))
    if how == 3:
        return text[:place] + draw.choice((b"[", b'{"a":')) * 100_000
    if how == 4:
        end = min(len(text), place + draw.choice((1, 10, 200)))
        return text[:place] + text[end:]
    if how == 5:
        return draw.choice((b"", b" \n", b"\xef\xbb\xbf", b"\xff\xfe{\x00", b"null", b"\x89HDF\r\n\x1a\n"))
    return text[:place] + text[place:].replace(b"0", draw.choice((b"00", b"-", b"1e400", b"nan", b"")), draw.choice((1, 5)))


def mutated(original, draw):
    try:
        document = json.loads(original)
    except ValueError:
        document = None
    if document is None or draw.random() < 0.3:
        return damaged(original, draw)
    for _ in range(draw.choice((1, 1, 1, 2, 5))):
        document = changed(document, draw)
    return json.dumps(document, ensure_ascii=draw.random() < 0.5).encode("utf-8", "surrogatepass")


def amiss(command, status, out, err):
    """What is wrong with an answer; empty if nothing is."""
    text = err.decode("utf-8", "replace")
    if status == 3 and "the HDF5 library (FILE) crashed" in text:
        return ""  # which is not ours, and said in a line
    if status not in (0, 1, 2):
        return f"status {status}"
    if any(sign in text for sign in SIGNS):
        return "words of the inside"
    if status != 2:
        return ""
    if out:
        return "refused, with something on standard output"
    if text.count("\n") != 1 or not text.endswith("\n") or "\ufffd" in text:
        return "refused, but not in one line"
    return "refused in a line without end" if len(text) > 4000 and command[0] != "order" else ""


def ask(program, folder, command):
    try:
        done = subprocess.run([program, *command], cwd=folder, capture_output=True, stdin=subprocess.DEVNULL, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        # A run that is asked for may be long.
        return None if command[0] == "repeat" else "no answer"
    return done.returncode, amiss(command, done.returncode, done.stdout, done.stderr), done.stderr


def questions(count, draw):
    """What was found from outside before, as it was; then mutated files of the corpus."""
    for path in sorted((HERE / "outside").glob("*/*")):
        yield from ((path, path.read_bytes(), command) for command in COMMANDS[path.parent.name])
    originals = [path for target in COMMANDS for path in sorted((HERE / "corpus" / target).iterdir())]
    for _ in range(count):
        path = draw.choice(originals)
        yield path, mutated(path.read_bytes(), draw), draw.choice(COMMANDS[path.parent.name])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=100, help="documents [100]")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, help="where documents go that were not answered as they should be")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    draw = random.Random(arguments.seed)
    statuses, wrong = collections.Counter(), 0
    with tempfile.TemporaryDirectory(prefix="sphverify-outside-") as name:
        folder = pathlib.Path(name)
        for file in BESIDE.iterdir():
            (folder / file.name).write_bytes(file.read_bytes())
        for n, (original, document, command) in enumerate(questions(arguments.count, draw)):
            (folder / "FILE").write_bytes(document)
            answer = ask(program, folder, command)
            status, complaint, said = answer if isinstance(answer, tuple) else (answer, answer, b"")
            statuses[status] += 1
            if not complaint:
                continue
            wrong += 1
            print(f"{n}: {original.parent.name}/{original.name}: {' '.join(command)}: {complaint}")
            print(f"  {said[:300]!r}")
            if arguments.keep:
                arguments.keep.mkdir(parents=True, exist_ok=True)
                (arguments.keep / f"{arguments.seed}-{n}-{original.parent.name}").write_bytes(document)
    print(f"{statuses.total()} documents: " + ", ".join(f"{count} ended with {status}" for status, count in statuses.items()))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
