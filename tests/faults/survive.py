#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study survives: kills, cut journals, full disks, folders that become read-only, clocks that jump.

    tests/faults/survive.py PROGRAM                 # a sample, as the tests take it: less than a minute
    tests/faults/survive.py PROGRAM --full          # 1,000 kills, every byte, every call: docs/cluster.md says what came out

Each fault hits a small study, which is then gone on with by --resume until it is done. Its document must be that of an undisturbed
process, but for times; older results stay whole until then; and who is refused is told so in one line.
"""

import argparse
import errno
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
SOURCE = pathlib.Path(__file__).resolve().parents[2]

STUDY = {
    "schema": "sphverify-study/1",
    "name": "faults",
    "cases": [{"id": "conduction/slab-dirichlet", "parameters": {"final_time": 0.01}}],
    "formulations": ["conduction/brookshaw", "conduction/campbell-flux"],
    "discretisation": {"layout": ["lattice", {"id": "jittered", "amplitude": 0.2, "seeds": [1, 2]}]},
    "resolution": [20, 40, 80, 120],
    "measure": ["error"],
}


class Failure(Exception):
    """The study did not survive."""


class Faults:
    def __init__(self, program, folder, seed):
        self.program, self.folder = program, folder
        self.random = random.Random(seed)
        self.study = folder / "study.json"
        self.study.write_text(json.dumps(STUDY))
        self.place = folder / "results"
        self.place.mkdir()
        self.results = self.place / "results.json"
        self.journal = self.place / "results.json.journal"
        start = time.monotonic()
        self.check(self.run())
        self.seconds = time.monotonic() - start
        self.undisturbed = self.numbers()
        self.results.unlink()

    def command(self, *options):
        return [self.program, "study", self.study, "-o", self.results, "--jobs", "2", *options]

    def run(self, *options, **changes):
        return subprocess.run(self.command(*options), capture_output=True, text=True, env=os.environ | changes, timeout=300)

    def check(self, done):
        if done.returncode != 0:
            raise Failure(f"exit {done.returncode}: {done.stderr[-500:]}")

    def numbers(self):
        document = json.loads(self.results.read_text())
        del document["context"]
        return document

    def check_results(self):
        if self.numbers() != self.undisturbed:
            raise Failure("the results are not those of an undisturbed study")
        left = sorted(path.name for path in self.place.iterdir())
        if left != ["results.json"]:
            raise Failure(f"left over: {left}")
        self.results.unlink()

    def finish(self):
        self.check(self.run("--resume"))
        self.check_results()

    def kills(self, count):
        """SIGKILL at any moment, again and again, until the study is done in spite of it."""
        studies, killed = 0, 0
        while killed < count:
            process = subprocess.Popen(self.command("--resume"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                process.wait(timeout=self.random.uniform(0.0, 1.3 * self.seconds))
            except subprocess.TimeoutExpired:
                process.kill()
                killed += 1
            if process.wait() == 0:
                self.check_results()
                studies += 1
            elif process.returncode != -signal.SIGKILL:
                raise Failure(f"exit {process.returncode} of a study that nobody had killed")
        self.finish()
        return f"{killed} kills of {studies + 1} studies"

    def rank_kills(self, count):
        """SIGKILL of any process that a job of ranks is made of."""
        user = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        words = ["mpirun", *user, "--oversubscribe", "--bind-to", "none", "--enable-recovery", "-np", "2"]
        studies, killed = 0, 0
        while killed < count:
            process = subprocess.Popen([*words, *map(str, self.command("--resume"))], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                       start_new_session=True)  # fmt: skip
            deadline = time.monotonic() + self.random.uniform(0.2, 0.6) + self.seconds
            while process.poll() is None:
                time.sleep(self.random.uniform(0.0, 0.3))
                members = self.processes()
                if members and killed < count and time.monotonic() < deadline:
                    try:
                        os.kill(self.random.choice(members), signal.SIGKILL)
                        killed += 1
                    except ProcessLookupError:
                        pass
            patience = time.monotonic() + 15
            while left := self.processes():
                if time.monotonic() > patience:
                    raise Failure(f"processes are left: {left}")
                time.sleep(0.05)
            if self.results.exists():
                document = self.numbers()
                lost = [run for run in document["runs"] if run["status"] == "crashed"]
                if not lost:
                    self.place.joinpath("results.json.ranks").unlink(missing_ok=True)
                    self.check_results()
                    studies += 1
                    continue
                # Twice killed is crashed, as it is said to be: all others must be right.
                for mine, whole in zip(document["runs"], self.undisturbed["runs"], strict=True):
                    if mine["status"] != "crashed" and mine != whole:
                        raise Failure("a run beside a crashed one is another")
                self.results.unlink()
                studies += 1
        self.place.joinpath("results.json.ranks").unlink(missing_ok=True)
        self.finish()
        return f"{killed} kills of ranks, workers and runs in {studies + 1} jobs"

    def processes(self):
        mine = []
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                words = (folder / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if words and words[0] == str(self.program).encode() and str(self.results).encode() in words:
                mine.append(int(folder.name))
        return mine

    def interrupted(self):
        """A journal with some runs, as a kill leaves it."""
        while True:
            process = subprocess.Popen(self.command("--resume"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while process.poll() is None:
                if self.journal.exists() and self.journal.read_bytes().count(b"\n") > 5:
                    process.kill()
                time.sleep(0.001)
            if not self.results.exists():
                text = self.journal.read_bytes()
                return text[: text.rfind(b"\n") + 1]
            self.results.unlink()

    def cuts(self, step):
        """A journal cut at every byte of its last two records (or every so many)."""
        text = self.interrupted()
        begin = text[:-1].rfind(b"\n", 0, text[:-1].rfind(b"\n")) + 1
        places = range(begin, len(text), step)
        for at in places:
            self.journal.write_bytes(text[:at])
            self.finish()
        return f"{len(places)} cuts of a journal"

    def failing_calls(self, step):
        """Each call that writes fails once, or from then on, for want of space, for a folder that is read-only, for an error of the disk."""
        library = self.shim()
        count = self.folder / "calls"
        loaded = {"LD_PRELOAD": str(library), "FAIL_IN": str(self.place)}
        self.check(self.run(FAIL_AT="0", FAIL_COUNT=str(count), **loaded))
        older = self.results.read_bytes()
        calls = int(count.read_text())
        failed = 0
        for number in range(1, calls + 1, step):
            for error in (errno.ENOSPC, errno.EROFS, errno.EIO):
                for goes_on in ({}, {"FAIL_ON": "1"}):
                    self.results.write_bytes(older)
                    done = self.run(FAIL_AT=str(number), FAIL_WITH=str(error), **loaded, **goes_on)
                    if done.returncode == 0:
                        raise Failure(f"call {number} failed ({errno.errorcode[error]}) and nobody noticed")
                    said = [line for line in done.stderr.splitlines() if line.startswith("sphverify: ")]
                    if done.returncode not in (2, 3) or len(said) != 1:
                        raise Failure(f"call {number} ({errno.errorcode[error]}): exit {done.returncode}: {done.stderr[-500:]}")
                    if self.results.read_bytes() != older:
                        raise Failure(f"call {number} ({errno.errorcode[error]}): older results are not whole")
                    failed += 1
                    self.results.unlink()
                    self.finish()
        return f"{failed} failures at {len(range(1, calls + 1, step))} of {calls} calls"

    def shim(self):
        library = self.folder / "failing.so"
        if not library.exists():
            subprocess.run(["cc", "-shared", "-fPIC", "-O1", pathlib.Path(__file__).with_name("failing.c"), "-o", library, "-ldl"], check=True)
        return library

    def clock(self, count):
        """A wall clock that jumps by days, to and fro."""
        for _ in range(count):
            self.jump()
        return "a clock that jumps"

    def jump(self):
        library = self.shim()
        self.check(self.run(LD_PRELOAD=str(library), CLOCK_JUMPS="1"))
        self.check_results()

    def two_at_once(self, count):
        """Two studies for one output: one is refused in a line, the other is whole."""
        refused = 0
        for _ in range(count):
            both = [subprocess.Popen(self.command("--resume"), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) for _ in range(2)]
            said = [one.communicate()[1] for one in both]
            codes = sorted(one.returncode for one in both)
            if codes not in ([0, 0], [0, 2]):
                raise Failure(f"exits {codes}: {said}")
            refused += codes == [0, 2]
            self.check_results()
        return f"{count} pairs of studies for one output, {refused} of them refused one"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path, metavar="PROGRAM")
    parser.add_argument("--full", action="store_true", help="1,000 kills, every byte, every call")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", metavar="WORD", help="faults whose name holds it: kills, rank_kills, cuts, failing_calls, clock, two_at_once")
    asked = parser.parse_args()
    few = not asked.full
    with tempfile.TemporaryDirectory(prefix="sphverify-faults-") as folder:
        faults = Faults(asked.program.resolve(), pathlib.Path(folder), asked.seed)
        counts = {
            "kills": 15 if few else 1000,
            "rank_kills": 3 if few else 200,
            "cuts": 211 if few else 1,
            "failing_calls": 9 if few else 1,
            "clock": 1,
            "two_at_once": 3 if few else 50,
        }
        for name, count in counts.items():
            if asked.only and asked.only not in name:
                continue
            start = time.monotonic()
            try:
                print(f"survived: {getattr(faults, name)(count)} ({time.monotonic() - start:.0f} s)", flush=True)
            except Failure as failure:
                sys.exit(f"survive: {failure}")


if __name__ == "__main__":
    main()
