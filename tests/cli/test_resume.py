# SPDX-License-Identifier: GPL-3.0-or-later
"""Interrupted and killed studies: the journal is whole, --resume completes it, and the result is the same."""

import sys

sys.dont_write_bytecode = True

import json
import pathlib
import signal
import time
import unittest

from program import DONE, PROGRAM_ERROR, ProgramTest, complaints, small_study, strict_json, timeless

# A second of work in runs of about ten milliseconds, replicates and failing runs among them.
LONG_STUDY = small_study(
    name="long",
    cases=["conduction/slab-dirichlet", "conduction/manufactured"],
    formulations=["conduction/brookshaw", "conduction/campbell-flux", "momentum/p-rho2"],
    discretisation={
        "density": ["given", "summation"],
        "smoothing_ratio": [0.7, 1.2],
        "layout": ["lattice", {"id": "jittered", "amplitude": 0.4, "seeds": [1, 2]}],
    },
    resolution=[40, 60],
    measure=["error", "conservation", "cost", "stability"],
)
RUNS = 2 * 2 * 2 * 2 * 3 * 2
SECONDS_TO_STOP = 5


def whole_lines(text):
    """A journal's text without a last line that a kill cut short: the system may stop a write in its middle."""
    return text[: text.rfind("\n") + 1]


class Interruptions(ProgramTest):
    @classmethod
    def setUpClass(cls):
        """The same study without an interruption."""
        helper = cls()
        helper.setUp()
        try:
            cls.undisturbed = helper.study(LONG_STUDY)
        finally:
            helper.doCleanups()

    def runTest(self):
        """Lets `setUpClass` make an instance."""

    def setUp(self):
        super().setUp()
        self.results = self.folder / "results.json"
        self.journal = pathlib.Path(f"{self.results}.journal")
        self.document = self.write("study.json", LONG_STUDY)

    def start_study(self):
        return self.start("study", self.document, "-o", self.results, "--jobs", 1)

    def stop_study(self, sent, finished_runs=3):
        """Sends a signal as soon as the journal holds some runs; gives exit status and standard error."""
        process = self.start_study()
        deadline = time.monotonic() + 60
        while not (self.journal.exists() and self.journal.read_bytes().count(b"\n") > finished_runs):
            self.assertIsNone(process.poll(), "the study ended before it could be stopped")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.002)
        process.send_signal(sent)
        start = time.monotonic()
        error = process.communicate(timeout=60)[1].decode()
        self.assertLess(time.monotonic() - start, SECONDS_TO_STOP)
        self.assertFalse(self.results.exists(), "no results before the study is complete")
        return process.returncode, error

    def journal_lines(self, is_killed):
        """Header and finished runs of the journal, whose lines must be whole but for the last of a killed study."""
        text = self.journal.read_text()
        if is_killed:
            text = whole_lines(text)
        self.assertTrue(text.endswith("\n"), "the last line is cut")
        header, *runs = [strict_json(line) for line in text.splitlines()]
        self.assertEqual(header["schema"], "sphverify-journal/1")
        for line in (header, *runs):
            self.assertEqual(complaints("sphverify-journal-1", line), [])
        self.assertEqual(len({line["run"] for line in runs}), len(runs), "no run twice")
        return header, runs

    def resume(self, *options):
        """Resumes and checks that the results are those of the undisturbed study, and nothing is left over."""
        result = self.run_program("study", self.document, "-o", self.results, "--resume", *options)
        self.assertEqual(result.returncode, DONE, result.stderr)
        results = strict_json(self.results.read_text())
        self.assertEqual(timeless(results), timeless(self.undisturbed))
        self.assertEqual(sorted(self.folder.iterdir()), sorted([self.document, self.results]), "the journal is gone")
        return results, result.stderr

    def check_resumption(self, sent):
        status, error = self.stop_study(sent)
        before = self.journal_lines(is_killed=sent == signal.SIGKILL)[1]
        self.assertLess(len(before), RUNS)
        results, message = self.resume()
        self.assertIn(f"{len(before)} of them done before", message)
        for line in before:
            self.assertEqual(results["runs"][line["run"]], line["record"], "a finished run is not run again")
        return status, error

    def test_the_undisturbed_study_holds_every_run_and_failures_among_them(self):
        self.assertEqual(len(self.undisturbed["runs"]), RUNS)
        self.assertIn("unstable", {run["status"] for run in self.undisturbed["runs"]})
        self.assertTrue(self.undisturbed["skipped"])

    def test_a_killed_study_resumes_to_the_same_results(self):
        status, _ = self.check_resumption(signal.SIGKILL)
        self.assertEqual(status, -signal.SIGKILL)

    def test_an_interrupted_study_says_so_in_one_line_with_status_3_and_resumes_to_the_same_results(self):
        for sent in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=sent):
                status, error = self.check_resumption(sent)
                self.assertEqual(status, PROGRAM_ERROR)
                messages = [line for line in error.splitlines() if line.startswith("sphverify: ")]
                self.assertEqual(len(messages), 1, error)
                self.assertIn("--resume", messages[0])
                self.assertEqual(error.splitlines()[-1], messages[0])
                self.results.unlink()

    def test_a_study_killed_again_and_again_still_completes(self):
        for finished_runs in (3, 10, 20):
            process = self.start("study", self.document, "-o", self.results, "--resume")
            while not (self.journal.exists() and self.journal.read_bytes().count(b"\n") > finished_runs):
                self.assertIsNone(process.poll())
                time.sleep(0.002)
            process.kill()
            process.wait()
        self.assertGreaterEqual(len(self.journal_lines(is_killed=True)[1]), 20)
        self.resume()

    def test_a_journal_cut_in_mid_line_resumes_without_that_line(self):
        self.stop_study(signal.SIGKILL)
        runs = self.journal_lines(is_killed=True)[1]
        text = whole_lines(self.journal.read_text())
        self.journal.write_text(text[:-40])
        message = self.resume()[1]
        self.assertIn(f"{len(runs) - 1} of them done before", message)

    def test_a_journal_cut_within_its_first_line_starts_afresh(self):
        self.journal.write_bytes(b'{"schema":"sphverify-jour')
        self.resume()

    def test_a_complete_journal_gives_the_results_without_running_anything(self):
        self.stop_study(signal.SIGKILL)
        header = self.journal_lines(is_killed=True)[0]
        lines = [header] + [{"run": i, "record": run} for i, run in enumerate(self.undisturbed["runs"])]
        self.journal.write_text("".join(json.dumps(line) + "\n" for line in lines))
        results, message = self.resume()
        self.assertEqual(results["runs"], self.undisturbed["runs"])
        self.assertIn(f"{RUNS} of them done before", message)

    def test_resume_without_a_journal_starts_afresh(self):
        self.resume()

    def test_the_journal_of_another_study_is_refused_and_kept(self):
        self.stop_study(signal.SIGKILL)
        before = self.journal.read_bytes()
        other = self.write("other.json", LONG_STUDY | {"resolution": [50, 80]})
        result = self.run_program("study", other, "-o", self.results, "--resume")
        self.assert_user_error(result, self.journal, "study", "expected")
        self.assertEqual(self.journal.read_bytes(), before)
        self.assertFalse(self.results.exists())
        other.unlink()
        self.resume()

    def test_a_file_that_is_no_journal_is_refused_and_kept(self):
        for text in ("my notes\n", "{}\n", "[]\n", json.dumps(self.undisturbed) + "\n"):
            with self.subTest(text=text[:20]):
                self.journal.write_text(text)
                result = self.run_program("study", self.document, "-o", self.results, "--resume")
                self.assert_user_error(result, self.journal, "expected")
                self.assertEqual(self.journal.read_text(), text)

    def test_a_damaged_line_inside_the_journal_is_refused_in_one_line(self):
        self.stop_study(signal.SIGKILL)
        lines = whole_lines(self.journal.read_text()).splitlines()
        whole = json.loads(lines[2])
        for damage in ("{", "{}", '{"run": -1, "record": {}}', json.dumps(whole | {"record": {}})):
            with self.subTest(damage=damage[:40]):
                damaged = "\n".join([*lines[:2], damage, *lines[3:]]) + "\n"
                self.journal.write_text(damaged)
                result = self.run_program("study", self.document, "-o", self.results, "--resume")
                self.assert_user_error(result, self.journal, "expected")
                self.assertEqual(self.journal.read_text(), damaged)

    def test_a_leftover_journal_is_kept_under_another_name_without_resume_and_that_is_said(self):
        self.stop_study(signal.SIGKILL)
        before = self.journal.read_bytes()
        small = self.write("small.json", small_study())
        result = self.run_program("study", small, "-o", self.results)
        self.assertEqual(result.returncode, DONE, result.stderr)
        kept = pathlib.Path(f"{self.journal}.old")
        self.assertIn(kept.name, result.stderr)
        self.assertEqual(kept.read_bytes(), before)
        self.assertFalse(self.journal.exists())

    def test_a_second_study_for_the_same_results_is_refused_while_the_first_runs(self):
        process = self.start_study()
        while not (self.journal.exists() and self.journal.read_bytes().count(b"\n") > 1):
            self.assertIsNone(process.poll())
            time.sleep(0.002)
        for options in ((), ("--resume",)):
            result = self.run_program("study", self.document, "-o", self.results, *options)
            self.assert_user_error(result, self.journal, "still running")
        self.assertEqual(process.wait(timeout=60), DONE)
        self.assertEqual(timeless(strict_json(self.results.read_text())), timeless(self.undisturbed))

    def test_older_results_stay_until_the_new_ones_are_whole(self):
        small = self.write("small.json", small_study())
        self.succeed("study", small, "-o", self.results)
        older = self.results.read_bytes()
        process = self.start_study()
        while not (self.journal.exists() and self.journal.read_bytes().count(b"\n") > 3):
            self.assertIsNone(process.poll())
            time.sleep(0.002)
        self.assertEqual(self.results.read_bytes(), older)
        process.kill()
        process.wait()
        self.assertEqual(self.results.read_bytes(), older)

    def test_several_jobs_give_the_same_results_as_one(self):
        self.succeed("study", self.document, "-o", self.results, "--jobs", 1)
        self.assertEqual(timeless(strict_json(self.results.read_text())), timeless(self.undisturbed))


class TimedInTurn(ProgramTest):
    """Runs that are timed together: a kill between their measurement and their timing loses neither."""

    STUDY = small_study(
        formulations=["conduction/brookshaw", "conduction/lucy-flux", "conduction/campbell-flux"],
        resolution=[50, 80],
        measure=["error", "cost"],
        repeat=60,
    )

    def test_what_was_measured_is_not_measured_again_and_what_was_timed_is_not_timed_again(self):
        whole = self.study(self.STUDY)
        results = self.folder / "killed.json"
        journal = self.folder / "killed.json.journal"
        document = self.write("study.json", self.STUDY)
        # Killed while the second group is being timed: three runs are finished, three await their timing.
        process = self.start("study", document, "-o", results, "--jobs", 1)
        deadline = time.monotonic() + 120
        while not (journal.exists() and (text := journal.read_bytes()).count(b"awaits_timing") == 6 and text[-1:] == b"\n"):
            self.assertIsNone(process.poll(), "the study ended before it could be killed")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.001)
        process.kill()
        process.wait()
        header, *lines = [strict_json(line) for line in whole_lines(journal.read_text()).splitlines()]
        for line in (header, *lines):
            self.assertEqual(complaints("sphverify-journal-1", line), [])
        costs = {line["run"]: line["cost"] for line in lines if "cost" in line}
        records = {line["run"]: line["record"] for line in lines if "record" in line}
        self.assertEqual(len(records), 6)
        self.assertEqual(len(costs), 3)
        result = self.run_program("study", document, "-o", results, "--resume")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertIn("3 of them done before", result.stderr)
        resumed = strict_json(results.read_text())
        self.assertEqual(timeless(resumed), timeless(whole))
        for index, run in enumerate(resumed["runs"]):
            self.assertEqual(run["errors"], records[index]["errors"])
            self.assertEqual(run["cost"]["repeats"], 60)
            self.assertEqual(len(run["cost"]["round_seconds"]), 60)
            if index in costs:
                self.assertEqual(run["cost"], costs[index], "it is not timed again")
        occasions = [run["cost"]["occasion"] for run in resumed["runs"]]
        self.assertEqual(len(set(occasions)), 2)
        self.assertFalse(journal.exists())


class Envelopes(ProgramTest):
    """Every envelope's runs have places of their own in the journal."""

    STUDY = small_study(
        cases=["conduction/slab-dirichlet", "conduction/slab-insulated"],
        formulations=["conduction/campbell-flux"],
        discretisation={"layout": "lattice"},
        envelope={"parameter": "smoothing_ratio", "from": 1.2, "to": 0.5, "bisections": 4},
        resolution=2000,
        measure=["error"],
    )

    def test_what_one_envelope_ran_is_not_taken_for_another_s(self):
        whole = self.study(self.STUDY)
        self.assertEqual([len(one["points"]) for one in whole["envelopes"]], [6, 6])
        results = self.folder / "killed.json"
        journal = self.folder / "killed.json.journal"
        document = self.write("study.json", self.STUDY)
        process = self.start("study", document, "-o", results, "--jobs", 1)
        deadline = time.monotonic() + 60
        while not (journal.exists() and journal.read_bytes().count(b"\n") > 8):
            self.assertIsNone(process.poll(), "the study ended before it could be killed")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.001)
        process.kill()
        process.wait()
        lines = [strict_json(line) for line in whole_lines(journal.read_text()).splitlines()][1:]
        self.assertEqual(len({line["run"] for line in lines}), len(lines), "no place twice")
        result = self.run_program("study", document, "-o", results, "--resume")
        self.assertEqual(result.returncode, DONE, result.stderr)
        resumed = strict_json(results.read_text())
        self.assertEqual(timeless(resumed), timeless(whole))


if __name__ == "__main__":
    unittest.main(verbosity=2)
