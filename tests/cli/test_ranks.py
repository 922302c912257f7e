# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies that ranks share, under mpirun: the document of one process, whatever dies on the way."""

import sys

sys.dont_write_bytecode = True

import json
import os
import pathlib
import signal
import socket
import subprocess
import time
import unittest

from program import DONE, PROGRAM, PROGRAM_ERROR, SOURCE_DIR, ProgramTest, environment, small_study, strict_json, timeless

STUDY = small_study(
    name="ranks",
    cases=["conduction/slab-dirichlet", "conduction/manufactured"],
    formulations=["conduction/brookshaw", "conduction/campbell-flux"],
    discretisation={"layout": ["lattice", {"id": "jittered", "amplitude": 0.2, "seeds": [1, 2]}]},
    resolution=[20, 40, 60],
    measure=["error", "conservation", "cost"],
)

# Dies where there are particles of a number, if a file is there; with each death the file loses a byte.
DEADLY = """
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <sys/stat.h>
#include "sphverify/plugin.h"
int sphverify_plugin_abi(void) { return SPHVERIFY_PLUGIN_ABI; }
void sphverify_plugin_describe(sphverify_description* d) {
  strcpy(d->name, "deadly");
  d->rate = SPHVERIFY_CONDUCTION_HEATING;
  d->reads = SPHVERIFY_TEMPERATURE;
}
int sphverify_plugin_rates(sphverify_state const* s, sphverify_rates* r) {
  char const* lives = getenv("LIVES");
  struct stat status;
  if (lives && s->count == 12 && stat(lives, &status) == 0 && status.st_size > 0) {
    truncate(lives, status.st_size - 1);
    raise(strcmp(getenv("BY"), "KILL") == 0 ? SIGKILL : SIGSEGV);
  }
  for (size_t i = 0; i < s->count; ++i) r->pairs[0][i] = 0.0;
  return 0;
}
"""


class Ranks(ProgramTest):
    def setUp(self):
        super().setUp()
        self.results = self.folder / "results.json"
        self.document = self.write("study.json", STUDY)

    def command(self, ranks, *arguments, launcher=()):
        user = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        return ["mpirun", *user, "--oversubscribe", "--bind-to", "none", *launcher, "-np", str(ranks), PROGRAM, *map(str, arguments)]

    def ranks(self, ranks, *arguments, launcher=(), **changes):
        return subprocess.run(self.command(ranks, *arguments, launcher=launcher), capture_output=True, text=True,
                              cwd=self.folder, timeout=120, env=environment(**changes))  # fmt: skip

    def assert_complete(self, whole, document=None):
        results = strict_json(self.results.read_text())
        self.assert_valid("sphverify-results-1", results)
        self.assertEqual(timeless(results), timeless(whole))
        self.assertEqual(sorted(path.name for path in self.folder.glob("results.json*")), ["results.json"])

    def test_ranks_write_the_document_of_one_process(self):
        whole = self.study(STUDY, "whole.json")
        for count, jobs in ((2, 1), (3, 2)):
            with self.subTest(ranks=count, jobs=jobs):
                done = self.ranks(count, "study", self.document, "-o", self.results, "--jobs", jobs)
                self.assertEqual(done.returncode, DONE, done.stderr)
                self.assert_complete(whole)
                self.results.unlink()

    def test_envelopes_and_runs_in_turn_and_parts(self):
        envelopes = STUDY | {
            "cases": ["conduction/slab-dirichlet", "conduction/slab-insulated"],
            "discretisation": {"layout": "lattice"},
            "envelope": {"parameter": "smoothing_ratio", "from": 1.2, "to": 0.5, "bisections": 4},
            "resolution": 40,
        }
        for name, study in (("envelopes", envelopes), ("turns", STUDY | {"repeat": 2})):
            with self.subTest(study=name):
                whole = self.study(study, "whole.json")
                done = self.ranks(2, "study", self.write("other.json", study), "-o", self.results)
                self.assertEqual(done.returncode, DONE, done.stderr)
                self.assert_complete(whole)
        done = self.ranks(2, "study", self.document, "--part", "1/2", "-o", self.results)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.succeed("study", self.document, "--part", "2/2", "-o", self.folder / "second.json")
        self.succeed("merge", self.results, self.folder / "second.json", "-o", self.folder / "merged.json")
        merged = strict_json((self.folder / "merged.json").read_text())
        self.assertEqual(timeless(merged), timeless(self.study(STUDY, "whole.json")))

    def deadly_study(self, **changes):
        source = self.write("deadly.c", DEADLY)
        library = self.folder / "libdeadly.so"
        subprocess.run(["cc", "-O1", "-fPIC", "-shared", source, "-I", SOURCE_DIR / "include", "-o", library], check=True)
        study = small_study(formulations=["conduction/brookshaw", {"id": "plugin/deadly", "library": str(library)}], **changes)
        return self.write("deadly.json", study)

    def test_a_run_that_kills_its_process_is_tried_once_more_and_then_crashed(self):
        study = self.deadly_study()
        lives = self.folder / "lives"
        # None, one and two deaths: the first is forgiven.
        statuses = []
        for deaths, by in ((0, "KILL"), (1, "KILL"), (2, "SEGV"), (3, "KILL")):
            lives.write_text("x" * deaths)
            done = self.ranks(2, "study", study, "-o", self.results, LIVES=str(lives), BY=by)
            self.assertEqual(done.returncode, DONE, done.stderr)
            runs = strict_json(self.results.read_text())["runs"]
            self.assertEqual(len(runs), 6)
            deadly = [run for run in runs if "deadly" in run["formulation"]]
            self.assertEqual([run["status"] for run in runs if run not in deadly], ["ok"] * 3)
            statuses.append(deadly[1]["status"])
            if statuses[-1] == "crashed":
                self.assertIn(f"SIG{by}", deadly[1]["reason"])
                self.assertIn("2 times", deadly[1]["reason"])
            self.assertEqual([line for line in done.stderr.splitlines() if line.startswith("sphverify: ")], [])
            self.assertEqual({deadly[0]["status"], deadly[2]["status"]}, {"ok"})
        self.assertEqual(statuses, ["ok", "ok", "crashed", "crashed"])
        self.assertEqual(lives.stat().st_size, 1, "no third try")
        self.assertIn("crashed: 1 of 6 runs", done.stderr)

    def start_ranks(self, *arguments, launcher=()):
        process = subprocess.Popen(self.command(2, *arguments, launcher=launcher), cwd=self.folder, env=environment(),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)  # fmt: skip

        def end():
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
            process.communicate()

        self.addCleanup(end)
        return process

    def wait_for_runs(self, process, count):
        journal = pathlib.Path(f"{self.results}.journal")
        deadline = time.monotonic() + 60
        while not (journal.exists() and journal.read_bytes().count(b"\n") > count):
            self.assertIsNone(process.poll(), "the study ended too soon")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.002)

    def pid_of_rank(self, rank):
        """Of the process that mpirun started: its children have its environment, too."""
        found = []
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                words = (folder / "cmdline").read_bytes().split(b"\0")
                told = (folder / "environ").read_bytes().split(b"\0")
                parent = int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1])
            except (OSError, ValueError):
                continue
            if str(self.results).encode() in words and f"OMPI_COMM_WORLD_RANK={rank}".encode() in told and b"mpirun" not in words[0]:
                found.append((int(folder.name), parent))
        pids = {pid for pid, _ in found}
        return [pid for pid, parent in found if parent not in pids]

    def long_study(self):
        study = STUDY | {"resolution": [100, 150, 200, 300], "measure": ["error", "conservation"]}
        self.document.write_text(json.dumps(study))
        return study

    def test_a_rank_that_dies_costs_no_more_than_what_it_was_at(self):
        study = self.long_study()
        whole = self.study(study, "whole.json")
        process = self.start_ranks("study", self.document, "-o", self.results, launcher=["--enable-recovery"])
        self.wait_for_runs(process, 3)
        (rank,) = self.pid_of_rank(1)
        os.kill(rank, signal.SIGKILL)
        process.wait(timeout=120)
        self.assert_complete(whole)

    def test_an_orderly_stop_and_a_kill_leave_a_journal_that_is_gone_on_with(self):
        study = self.long_study()
        whole = self.study(study, "whole.json")
        for sent in (signal.SIGTERM, signal.SIGKILL):
            with self.subTest(signal=sent):
                process = self.start_ranks("study", self.document, "-o", self.results)
                self.wait_for_runs(process, 4)
                (rank,) = self.pid_of_rank(0)
                os.kill(rank, sent)
                error = process.communicate(timeout=60)[1]
                if sent == signal.SIGTERM:
                    self.assertEqual(process.returncode, PROGRAM_ERROR, error)
                    self.assertEqual(error.count("sphverify: interrupted"), 1, error)
                self.assertFalse(self.results.exists())
                text = pathlib.Path(f"{self.results}.journal").read_text()
                before = text[: text.rfind("\n") + 1].count("\n") - 1
                self.assertGreaterEqual(before, 4)
                # Whoever worked for it is gone, and the journal free.
                done = self.run_program("study", self.document, "-o", self.results, "--resume")
                self.assertEqual(done.returncode, DONE, done.stderr)
                self.assertIn(f"{before} of them done before", done.stderr)
                self.assertEqual(timeless(strict_json(self.results.read_text())), timeless(whole))
                self.results.unlink()
                pathlib.Path(f"{self.results}.ranks").unlink(missing_ok=True)

    def test_who_speaks_another_language_ends_nothing(self):
        study = self.long_study()
        whole = self.study(study, "whole.json")
        process = self.start_ranks("study", self.document, "-o", self.results)
        self.wait_for_runs(process, 1)
        place = json.loads(pathlib.Path(f"{self.results}.ranks").read_text())
        for words in (b'{"key":5}\n', b'[]\n', b'\xff\n', b'{"key":"' + b"x" * 2000000, b'{"key":"no","job":"no"}\n', b""):
            with socket.create_connection(("127.0.0.1", place["port"])) as stranger:
                try:
                    stranger.sendall(words)
                except OSError:
                    pass  # it was shown the door
        error = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, DONE, error)
        self.assert_complete(whole)

    def test_ranks_can_be_told_that_they_are_none(self):
        done = self.ranks(1, "study", self.document, "-o", self.results, SPHVERIFY_RANKS="off")
        self.assertEqual(done.returncode, DONE, done.stderr)
        script = 'exec "$0" study study.json --part $((OMPI_COMM_WORLD_RANK+1))/2 -o part-$OMPI_COMM_WORLD_RANK.json'
        words = self.command(2)
        words = words[: words.index(PROGRAM)] + ["sh", "-c", script, PROGRAM]
        done = subprocess.run(words, capture_output=True, text=True, cwd=self.folder, timeout=120, env=environment(SPHVERIFY_RANKS="off"))
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.succeed("merge", "part-0.json", "part-1.json", "-o", "merged.json")
        merged = strict_json((self.folder / "merged.json").read_text())
        self.assertEqual(timeless(merged), timeless(strict_json(self.results.read_text())))

    def test_a_meeting_place_that_somebody_left_misleads_nobody(self):
        stranger = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(stranger.close)
        place = {"addresses": ["127.0.0.1"], "port": stranger.getsockname()[1], "key": "old"}
        pathlib.Path(f"{self.results}.ranks").write_text(json.dumps(place))
        whole = self.study(STUDY, "whole.json")
        done = self.ranks(2, "study", self.document, "-o", self.results)
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assert_complete(whole)

    def test_rank_0_is_heard_though_another_fails_first(self):
        """mpirun ends all ranks as soon as one has failed."""
        late = 'if [ "$OMPI_COMM_WORLD_RANK" = 0 ]; then sleep 2; fi; exec "$0" study study.json --part 5/4 -o results.json'
        words = self.command(2)
        words = words[: words.index(PROGRAM)] + ["sh", "-c", late, PROGRAM]
        done = subprocess.run(words, capture_output=True, text=True, cwd=self.folder, timeout=60, env=environment())
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("sphverify: study: --part: found 5/4"), 1, done.stderr)

    def test_bad_input_is_refused_in_one_line(self):
        for study, arguments, words in [
            (small_study(), ["-o", self.results], ("ranks", "4", "at most 3")),
            (STUDY, [], ("4 ranks", "-o RESULTS.json")),
            (small_study(resolution=[3, 2]), ["-o", self.results], ("resolution",)),
            (STUDY, ["--part", "5/4", "-o", self.results], ("--part", "5/4")),
        ]:
            with self.subTest(words=words):
                done = self.ranks(4, "study", self.write("bad.json", study), *arguments)
                said = [line for line in done.stderr.splitlines() if line.startswith("sphverify: ")]
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertEqual(len(said), 1, done.stderr)
                for word in words:
                    self.assertIn(str(word), said[0])
                self.assertEqual(done.stdout.strip(), "")
                self.assertFalse(self.results.exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
