# SPDX-License-Identifier: GPL-3.0-or-later
"""Which mutants: files by their lines, places in them at random, all from a seed.

The mutant of a number depends on the seed and the sources, not on how many are drawn.
"""

import fnmatch
import hashlib
import json
import multiprocessing
import pathlib
import random
import re
import subprocess

import pieces

HERE = pathlib.Path(__file__).resolve().parent
ROOMS = {"formulations": "formulations", "cases": "cases", "harness": "harness", "reports": "reports",
         "page": "reports/page"}
TRIES = 25  # for a place whose mutant compiles


def code_lines(text):
    return sum(1 for line in text.splitlines() if line.strip() and not re.match(r"\s*(//|\*|/\*)", line))


def files_of(root, patterns):
    """Room -> its files and their lines of code; with patterns only files that fit one."""
    rooms = {}
    for room, folder in ROOMS.items():
        pattern = "*.js" if room == "page" else "*.?pp"
        paths = (root / folder).glob(pattern) if room == "page" else (root / folder).rglob(pattern)
        names = sorted(str(p.relative_to(root)) for p in paths)
        names = [n for n in names if not patterns or any(fnmatch.fnmatch(n, pattern) for pattern in patterns)]
        rooms[room] = {name: code_lines((root / name).read_text()) for name in names}
    return {room: files for room, files in rooms.items() if files}


def draw_files(rooms, count, seed):
    """For each number a room, in proportion to lines, and files in the order in which they are tried."""
    lines = {room: sum(files.values()) for room, files in rooms.items()}
    total = sum(lines.values())
    drawn = dict.fromkeys(rooms, 0)
    order = {}
    for number in range(1, count + 1):
        room = max(rooms, key=lambda r: (lines[r] / total * number - drawn[r], r))
        drawn[room] += 1
        chance = random.Random(f"{seed}/{number}/file")
        names = list(rooms[room])
        order[number] = room, chance.choices(names, [rooms[room][n] for n in names], k=10)
    return order


def choose(places, number, seed, taken, compiles):
    """A mutant for the number among the places of its file, which fits those already taken; none if there is none."""
    chance = random.Random(f"{seed}/{number}/place")
    spans = sorted(places)
    failed = 0
    for _ in range(TRIES):
        if not spans:
            return None, failed
        mutant = chance.choice(places[chance.choice(spans)])
        if mutant.number or any(pieces.conflict(mutant, other) for other in taken):
            continue
        mutant.number = number
        if compiles(mutant):
            return mutant, failed
        mutant.number = 0
        failed += 1
    return None, failed


def guard(mutant):
    return f"::mutation::on{'_or_constant' if mutant.constant else ''}({mutant.number})"


def instrumented(source, mutants):
    """A C++ source with mutants in it; the text before the first line moves no other."""
    head = f'#include "{HERE / "mutants.hpp"}"\n#line 1\n'
    return head + pieces.render(source, mutants, guard)


def read_bytes_as_text(path):
    """One character for each byte, as libclang counts."""
    return path.read_bytes().decode("latin-1")


def draw_in_cpp(task):
    """All mutants of one C++ file."""
    import compiler
    import cpp_rules
    root, build, name, source, numbers, seed = task
    commands = compiler.Commands(build)
    path = root / name
    if source is None:
        return name, [], {}, 0
    text = read_bytes_as_text(path)
    unit = compiler.Unit(path, source, commands.arguments(source))
    places = cpp_rules.Places(name, text).read(unit.unit, str(path))
    left_out = dict(places.left_out)

    def compiles(mutants):
        # As the library wants it: text of the source's own encoding.
        return unit.compiles(pieces.render(text, mutants, guard).encode("latin-1").decode("utf-8"))

    # All at once, and one by one only if that fails.
    taken = []
    for number in numbers:
        mutant, _ = choose(places.found, number, seed, taken, lambda m: True)
        if mutant:
            taken.append(mutant)
    failed = 0
    if taken and not compiles(taken):
        for mutant in taken:
            mutant.number = 0
        taken = []
        for number in numbers:
            mutant, tries = choose(places.found, number, seed, taken, lambda m: compiles([m]))
            failed += tries
            if mutant:
                taken.append(mutant)
        while taken and not compiles(taken):
            taken.pop().number = 0
    return name, taken, left_out, failed


def draw_in_page(root, node, by_file, seed):
    """All mutants of the page's files."""
    names = sorted(by_file)
    if not names:
        return []
    done = subprocess.run(["node", HERE / "page_rules.mjs", node, *[root / n for n in names]], check=True,
                          capture_output=True, text=True)
    results = []
    for name, found in zip(names, json.loads(done.stdout)):
        places = {}
        for one in found["mutants"]:
            one["pieces"] = [p if isinstance(p, str) else tuple(p) for p in one["pieces"]]
            one["mutated"] = [p if isinstance(p, str) else tuple(p) for p in one["mutated"]]
            places.setdefault((one["start"], one["end"]), []).append(pieces.Mutant(file=name, **one))
        taken = []
        for number in by_file[name]:
            mutant, _ = choose(places, number, seed, taken, lambda m: True)
            if mutant:
                taken.append(mutant)
        results.append((name, taken, found["leftOut"], 0))
    return results


def digest_of(root, name, source, numbers, seed):
    rules = b"".join((HERE / f).read_bytes() for f in ("compiler.py", "cpp_rules.py", "draw.py", "pieces.py"))
    key = [(root / name).read_text(), str(source), numbers, seed, rules.decode()]
    return hashlib.sha256(json.dumps(key).encode()).hexdigest()[:20]


def draw(root, build, cache, node, patterns, count, seed, jobs, say):
    """The mutants, what was left out by reason, and how many did not compile."""
    try:
        import compiler
    except ModuleNotFoundError as missing:
        raise SystemExit(f"error: Python's {missing.name} is not there: install what tests/mutation/packages.txt names, and start "
                         "this with /usr/bin/python3") from missing
    rooms = files_of(root, patterns)
    order = draw_files(rooms, count, seed)
    commands = compiler.Commands(build)
    including = compiler.includers(root, ["formulations", "cases", "harness", "reports", "tests"])
    mutants, left_out, failed = [], {}, 0
    open_numbers = {number: 0 for number in order}  # -> which of its files is tried
    done_files = {}
    cache.mkdir(parents=True, exist_ok=True)
    while open_numbers:
        by_file = {}
        for number, attempt in open_numbers.items():
            by_file.setdefault(order[number][1][attempt], []).append(number)
        results, tasks = [], []
        for name, numbers in sorted(by_file.items()):
            if name.endswith(".js"):
                continue
            source = compiler.source_of(root / name, including, commands)
            kept = cache / f"{digest_of(root, name, source, numbers, seed)}.json"
            if kept.exists():
                results.append(restored(json.loads(kept.read_text())))
            else:
                tasks.append(((root, build, name, source, numbers, seed), kept))
        with multiprocessing.Pool(jobs, maxtasksperchild=4) as pool:
            for k, result in enumerate(pool.imap(draw_in_cpp, [t for t, _ in tasks]), 1):
                tasks[k - 1][1].write_text(json.dumps([result[0], [vars(m) for m in result[1]], *result[2:]]))
                results.append(result)
                say(f"drawn in {k} of {len(tasks)} files: {result[0]}")
        results += draw_in_page(root, node, {n: k for n, k in by_file.items() if n.endswith(".js")}, seed)
        placed = set()
        for name, taken, reasons, tries in results:
            failed += tries
            if name not in done_files:
                done_files[name] = True
                for reason, times in reasons.items():
                    left_out[reason] = left_out.get(reason, 0) + times
            for mutant in taken:
                # A second visit to a file may cut what the first has taken.
                if any(m.file == name and pieces.conflict(m, mutant) for m in mutants):
                    continue
                mutant.room = order[mutant.number][0]
                mutants.append(mutant)
                placed.add(mutant.number)
        open_numbers = {n: a + 1 for n, a in open_numbers.items() if n not in placed and a + 1 < 10}
    return sorted(mutants, key=lambda m: m.number), left_out, failed


def restored(record):
    name, taken, *rest = record
    mutants = []
    for one in taken:
        for key in ("pieces", "mutated"):
            one[key] = [p if isinstance(p, str) else tuple(p) for p in one[key]]
        mutants.append(pieces.Mutant(**one))
    return (name, mutants, *rest)
