# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the fast tests on mutants: each test once without any, to see which mutants it reaches and how long it takes, then
on those of them that no test has noticed yet."""

import heapq
import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import threading
import time

from tree import run_within

HERE = pathlib.Path(__file__).resolve().parent
# Of the fast tests those that say nothing of a mutant.
NOT_RUN = {"mutants": "compares texts of the source with a list",
           "mutant_generator": "tests this suite",
           "install": "installs what is built and compiles against it"}
# Cheap ones first; what a mutant is not noticed by is asked of the next.
CLASSES = (("unit", 0), ("contract", 0), ("cli", 1), ("extremes", 2), ("page", 3), ("gates", 4))
# A mutant may ask for all memory, or write without end.
LIMITS = ["prlimit", "--as=8000000000", "--fsize=1000000000", "--core=0"]


class Test:
    def __init__(self, described):
        self.name = described["name"]
        self.command = described["command"]
        properties = {p["name"]: p["value"] for p in described.get("properties", [])}
        self.environment = dict(e.split("=", 1) for e in properties.get("ENVIRONMENT", []))
        self.folder = properties.get("WORKING_DIRECTORY")
        self.timeout = float(properties.get("TIMEOUT", 600.0))
        path = pathlib.Path(next((w for w in self.command if w.endswith(".py")), self.name))
        self.of_class = next((rank for word, rank in CLASSES if word == self.name or self.name.startswith(word + "/")), 0)
        self.stops_early = path.name.startswith("test_")
        self.seconds = None
        self.reached = set()

    def run(self, chosen, seconds, processor=None):
        """Status, output and how long it took; `processor`: seconds of it that a process may use. Those of the clock
        tell nothing where the machine is busy."""
        environment = dict(os.environ, **self.environment, SPHVERIFY_MUTANT=str(chosen))
        command = list(self.command)
        if self.name == "page":
            environment["PYTHONPATH"] = str(HERE / "browser")
        elif self.stops_early:
            environment.pop("PYTHONPATH", None)
        if self.stops_early and not str(chosen).startswith("record"):
            command.append("--failfast")
        with tempfile.TemporaryDirectory() as place:
            environment["TMPDIR"] = place
            if self.name != "page":  # a browser reserves more than it uses
                command = LIMITS + ([f"--cpu={processor:.0f}"] if processor else []) + command
            start = time.monotonic()
            status, output = run_within(seconds, command, environment, self.folder)
            return status, output, time.monotonic() - start


def tests_of(build, wanted):
    """The fast tests of a configured build, of names that match."""
    listed = subprocess.run(["ctest", "--show-only=json-v1", "-LE", "slow"], cwd=build, check=True, capture_output=True, text=True)
    tests = [Test(d) for d in json.loads(listed.stdout)["tests"] if d.get("command")]
    return [t for t in tests if t.name not in NOT_RUN and re.search(wanted, t.name)]


def targets_of(build, wanted):
    """What the fast tests of such names need built. CTest says what a test runs only once it is there."""
    text = (build / "tests" / "CTestTestfile.cmake").read_text()
    programs = {name: pathlib.Path(program) for name, program in re.findall(r'add_test\(\[=\[(.+?)\]=\] "([^"]+)"', text)}
    return sorted({program.name if program.is_relative_to(build / "tests") else "sphverify"
                   for name, program in programs.items() if name not in NOT_RUN and re.search(wanted, name)})


class Trial:
    """What is known of mutants and tests; kept in a file, so that an interrupted run goes on."""

    def __init__(self, tests, mutants, tried, store, jobs, say):
        """`mutants`: all that are built; `tried`: the numbers of those to try now."""
        self.tests, self.store, self.jobs, self.say = tests, store, jobs, say
        self.mutants = {m.number: m for m in mutants}
        self.tried = set(tried)
        self.alive = {m.number: set() for m in mutants}  # -> the tests that it has passed
        self.caught = {}  # number -> (test, how)
        self.failing = {}  # tests that fail without a mutant
        self.queue, self.order = [], 0
        self.lock = threading.Condition()
        self.busy = 0

    def load(self):
        if not self.store.exists():
            return
        kept = json.loads(self.store.read_text())
        for number, passed in kept["alive"].items():
            if int(number) in self.alive:
                self.alive[int(number)] = set(passed)
        for number, how in kept["caught"].items():
            if int(number) in self.mutants:
                self.caught[int(number)] = how
                self.alive.pop(int(number), None)
        for test in self.tests:
            if test.name in kept["tests"]:
                test.seconds, reached = kept["tests"][test.name]
                test.reached = set(reached)
        self.failing = kept["failing"]

    def save(self):
        text = json.dumps({"alive": {n: sorted(p) for n, p in self.alive.items()}, "caught": self.caught,
                           "tests": {t.name: [t.seconds, sorted(t.reached)] for t in self.tests
                                     if t.seconds is not None},
                           "failing": self.failing})
        beside = self.store.with_suffix(".new")
        beside.write_text(text)
        beside.replace(self.store)

    def push(self, *job):
        self.order += 1
        heapq.heappush(self.queue, (*job[:2], self.order, *job[2:]))

    def run(self, until):
        """Returns whether all is done: false if the time is up before."""
        with self.lock:
            for test in self.tests:
                if test.name in self.failing:
                    continue
                if test.seconds is None:
                    self.push(test.of_class, -1.0, test, None)
                else:
                    self.push_trials(test)
        workers = [threading.Thread(target=self.work, args=(until,)) for _ in range(self.jobs)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        self.save()
        return not self.queue

    def left(self):
        """Those to try that no test has noticed yet."""
        return self.tried & set(self.alive)

    def push_trials(self, test):
        for number in sorted(test.reached & self.left()):
            if test.name not in self.alive[number]:
                self.push(test.of_class, test.seconds, test, number)

    def work(self, until):
        while True:
            with self.lock:
                while not self.queue and self.busy:
                    self.lock.wait()
                if not self.queue or time.monotonic() > until:
                    self.lock.notify_all()
                    return
                _, _, _, test, number = heapq.heappop(self.queue)
                if number is None and not self.left() or number is not None and number not in self.alive:
                    continue
                self.busy += 1
            try:
                self.record(test) if number is None else self.try_one(test, number)
            finally:
                with self.lock:
                    self.busy -= 1
                    self.lock.notify_all()

    def record(self, test):
        most = max(self.mutants)
        with tempfile.NamedTemporaryFile(dir="/dev/shm") as file:
            file.write(bytes(most + 1))
            file.flush()
            status, output, seconds = test.run(f"record:{file.name}", test.timeout * 3)
            file.seek(0)
            marks = file.read()
        with self.lock:
            if status != 0:
                self.failing[test.name] = output[-1500:]
                self.say(f"fails without any mutant, and is left out: {test.name}")
                return
            test.seconds = round(seconds, 3)
            test.reached = {n for n in self.mutants if marks[n]}
            if test.name == "page":
                test.reached |= {n for n, m in self.mutants.items() if m.file.endswith(".js")}
            self.push_trials(test)
            self.save()

    def try_one(self, test, number):
        status, output, seconds = test.run(number, 300.0 + 20.0 * test.seconds, 20.0 + 5.0 * test.seconds)
        with self.lock:
            if number not in self.alive:
                return
            if status == 0:
                self.alive[number].add(test.name)
                return
            how = "time" if status in (None, -signal.SIGXCPU, -signal.SIGKILL) else f"signal {-status}" if status < 0 else "failed"
            self.caught[number] = (test.name, how)
            del self.alive[number]
            self.save()
            m = self.mutants[number]
            self.say(f"{number} {m.file}:{m.line} {m.rule}: caught by {test.name} ({how}), {len(self.left())} left")

    def reached_by(self, number):
        return [t.name for t in self.tests if number in t.reached]

