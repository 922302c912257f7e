# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies in parts: together they are the study that one process runs, and nothing is lost, doubled or divided by mistake."""

import sys

sys.dont_write_bytecode = True

import json
import signal
import time
import unittest

from program import DONE, GATE_FAILED, ProgramTest, complaints, mutated, small_study, strict_json, timeless

STUDY = small_study(
    name="parts",
    cases=["conduction/slab-dirichlet", "operator/sine"],
    formulations=["conduction/brookshaw", "conduction/campbell-flux", "momentum/p-rho2"],
    discretisation={"layout": ["lattice", {"id": "jittered", "amplitude": 0.2, "seeds": [1, 2]}]},
    resolution=[20, 30, 40],
    measure=["error", "conservation", "cost"],
)

# Of resolutions and h/dx, which gives surfaces.
GRID = STUDY | {"cases": "conduction/slab-dirichlet", "formulations": ["conduction/brookshaw", "conduction/campbell-flux"],
                "discretisation": {"layout": "lattice", "smoothing_ratio": [1.2, 1.4, 1.6]}}  # fmt: skip


class Parts(ProgramTest):
    def parts(self, study, count, *options):
        """Results of all parts, with their paths."""
        document = self.write("study.json", study)
        paths = [self.folder / f"part-{k}.json" for k in range(1, count + 1)]
        for k, path in enumerate(paths, 1):
            result = self.run_program("study", document, "--part", f"{k}/{count}", "-o", path, *options)
            self.assertEqual(result.returncode, DONE, result.stderr)
        return paths

    def merged(self, paths, *options):
        self.succeed("merge", *paths, "-o", self.folder / "merged.json", *options)
        return strict_json((self.folder / "merged.json").read_text())

    def test_parts_together_are_the_whole_study_bit_for_bit(self):
        for study, count in ((STUDY, 1), (STUDY, 3), (GRID, 2)):
            whole = self.study(study)
            paths = self.parts(study, count)
            documents = [strict_json(path.read_text()) for path in paths]
            for document in documents:
                self.assert_valid("sphverify-results-1", document)
                self.assertEqual(document["study"], whole["study"])
                self.assertEqual((document["series"], document["skipped"]), ([], whole["skipped"]))
                self.assertEqual(len(document["runs"]), len(document["part"]["runs"]))
            numbers = sorted(run for document in documents for run in document["part"]["runs"])
            self.assertEqual(numbers, list(range(len(whole["runs"]))))
            merged = self.merged(reversed(paths))
            self.assert_valid("sphverify-results-1", merged)
            self.assertEqual(timeless(merged), timeless(whole))
            self.assertEqual("surfaces" in merged, study is GRID)
            self.assertEqual([share["runs"] for share in merged["shares"]], [len(d["runs"]) for d in reversed(documents)])
            self.assertEqual(merged["context"]["machine"], whole["context"]["machine"])
            self.assertTrue(any(target["seconds"] for series in merged["series"] for target in series["time_to_error"]))

    def test_searches_of_envelopes_stay_whole(self):
        study = STUDY | {
            "cases": ["conduction/slab-dirichlet", "conduction/slab-insulated"],
            "formulations": ["conduction/brookshaw", "conduction/campbell-flux"],
            "discretisation": {"layout": "lattice"},
            "envelope": {"parameter": "smoothing_ratio", "from": 1.2, "to": 0.5, "bisections": 4},
            "resolution": 40,
        }
        whole = self.study(study)
        paths = self.parts(study, 3)
        self.assertEqual(timeless(self.merged(paths)), timeless(whole))

    def test_runs_that_take_turns_are_in_one_part(self):
        study = STUDY | {"cases": "conduction/slab-dirichlet", "formulations": ["conduction/brookshaw", "conduction/lucy-flux"], "repeat": 2}
        merged = self.merged(self.parts(study, 4))
        by_setting = {}
        for run in merged["runs"]:
            setting = json.dumps([run["discretisation"], run["resolution"]])
            by_setting.setdefault(setting, set()).add(run["cost"]["occasion"])
        self.assertTrue(all(len(occasions) == 1 and None not in occasions for occasions in by_setting.values()))
        self.assertEqual(len(set.union(*by_setting.values())), len(by_setting))

    def test_what_is_missing_is_named_and_can_be_run(self):
        whole = self.study(STUDY)
        paths = self.parts(STUDY, 4)
        missing = strict_json(paths[1].read_text())["part"]["runs"] + strict_json(paths[3].read_text())["part"]["runs"]
        first = whole["runs"][min(missing)]
        name = f"{min(missing)} ({first['label']} on {first['case']} at resolution {first['resolution']})"
        output, rest = self.folder / "merged.json", self.folder / "rest.json"
        result = self.run_program("merge", paths[0], paths[2], "-o", output)
        self.assert_user_error(result, name, f"and {len(missing) - 5} more", "--missing")
        self.assertFalse(output.exists())
        result = self.run_program("merge", paths[0], paths[2], "-o", output, "--missing", rest)
        self.assert_user_error(result, name, rest)
        self.assertFalse(output.exists())
        study = strict_json(rest.read_text())
        self.assert_valid("sphverify-study-1", study)
        self.assertEqual(study["runs"], sorted(missing))
        # The rest in parts of its own: as with any study.
        rests = [self.folder / f"rest-{k}.json" for k in (1, 2)]
        for k, path in enumerate(rests, 1):
            self.succeed("study", rest, "--part", f"{k}/2", "-o", path)
        self.assertEqual(timeless(self.merged([paths[0], paths[2], *rests])), timeless(whole))
        rest.unlink()
        self.merged(paths, "--missing", rest)
        self.assertFalse(rest.exists(), "nothing was missing")

    def test_more_parts_than_runs_leave_some_empty(self):
        study = small_study()
        whole = self.study(study)
        paths = self.parts(study, 5)
        sizes = [len(strict_json(path.read_text())["runs"]) for path in paths]
        self.assertEqual(sorted(sizes), [0, 0, 1, 1, 1])
        self.assertEqual(timeless(self.merged(paths)), timeless(whole))

    def test_a_killed_part_resumes_and_no_other_part_takes_its_journal(self):
        study = STUDY | {"resolution": [40, 60, 80]}
        document = self.write("study.json", study)
        part = self.folder / "part.json"
        journal = self.folder / "part.json.journal"
        process = self.start("study", document, "--part", "2/2", "-o", part, "--jobs", 1)
        deadline = time.monotonic() + 60
        while not (journal.exists() and journal.read_bytes().count(b"\n") > 3):
            self.assertIsNone(process.poll(), "the part ended before it could be killed")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        process.wait()
        for other in (["--part", "1/2"], ["--part", "2/3"], []):
            result = self.run_program("study", document, *other, "-o", part, "--resume")
            self.assert_user_error(result, journal, "another study")
        result = self.run_program("study", document, "--part", "2/2", "-o", part, "--resume")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertIn("done before", result.stderr)
        self.assertFalse(journal.exists())
        self.succeed("study", document, "--part", "1/2", "-o", self.folder / "first.json")
        self.assertEqual(timeless(self.merged([part, self.folder / "first.json"])), timeless(self.study(study)))

    def test_times_of_two_machines_are_kept_and_never_divided(self):
        paths = self.parts(GRID, 2)
        elsewhere = strict_json(paths[1].read_text())
        elsewhere["context"] |= {"machine": "elsewhere", "processor": "another"}
        for run in elsewhere["runs"]:
            if run["cost"]:
                run["cost"]["machine"] = "elsewhere"
        paths[1].write_text(json.dumps(elsewhere))
        merged = self.merged(paths)
        self.assert_valid("sphverify-results-1", merged)
        self.assertNotIn("machine", merged["context"])
        self.assertIn(" and another", merged["context"]["processor"])
        self.assertEqual([share["context"]["machine"] for share in merged["shares"]][1], "elsewhere")
        self.assertTrue(all(run["cost"]["seconds"] > 0 for run in merged["runs"] if run["cost"]))
        for series in merged["series"]:
            self.assertTrue(series["is_timed_apart"])
            self.assertEqual(series["time_to_error"], [])
            for order in series["orders"]:
                self.assertTrue(all(level["seconds"] is None for level in order["levels"]))
        for surface in merged["surfaces"]:
            self.assertTrue(all(cell["seconds"] is None for cell in surface["cells"]))
        self.assertEqual(timeless_orders(merged), timeless_orders(self.study(GRID)))
        said = " ".join(self.succeed("compare", self.folder / "merged.json").split())
        self.assertIn("timed on several machines", said)
        page = self.folder / "page.html"
        self.succeed("report", self.folder / "merged.json", "-o", page)
        self.assertIn("timed on several machines", page.read_text())
        of_one = {run["cost"]["machine"] for run in merged["runs"] if run["cost"]}
        self.assertEqual(len(of_one), 2)
        gates = {
            "schema": "sphverify-gates/1",
            "gates": [
                {"name": measure, "select": {"case": "conduction/slab-dirichlet", "formulation": "conduction/brookshaw"},
                 "measure": measure, "relative_to": "conduction/campbell-flux", "maximum": 1e9}
                for measure in ("time_to_error", "cost")
            ],
        }  # fmt: skip
        result = self.run_program("gate", self.folder / "merged.json", self.write("gates.json", gates))
        self.assertEqual(result.returncode, GATE_FAILED, result.stderr)
        self.assertIn("timed on several machines", result.stdout)
        self.assertIn("was timed on another machine", result.stdout)

    def test_a_part_has_no_orders_to_look_at(self):
        part = self.parts(small_study(), 2)[0]
        for command in (["compare", part], ["report", part, "-o", self.folder / "page.html"]):
            self.assert_user_error(self.run_program(*command), part, "part", "merge")
        gates = self.write("gates.json", {"schema": "sphverify-gates/1", "gates": [{"name": "all end well", "select": {}, "measure": "status", "equals": "ok"}]})
        self.assert_user_error(self.run_program("gate", part, gates), part, "part", "merge")
        self.succeed("repeat", part, "0", "-o", self.folder / "run.json")

    def test_bad_parts_are_refused_in_one_line(self):
        study = self.write("study.json", small_study())
        for words in ("0/4", "5/4", "1/0", "1", "1/", "/2", "1/2/3", "-1/2", "1.5/2", "1/2 ", "a/b", "1/99999999999", ""):
            with self.subTest(words=words):
                result = self.run_program("study", study, f"--part={words}", "-o", self.folder / "part.json")
                if words:
                    self.assert_user_error(result, "--part", words, "K/M")
                else:
                    self.assertEqual(result.returncode, 2)
        for runs, words in (([3], "below 3"), ([1, 0], "ascending"), ([0, 0], "ascending"), ([-1], "runs"), (1, "list"), ([0.5], "runs")):
            with self.subTest(runs=runs):
                document = self.write("chosen.json", small_study(runs=runs))
                self.assert_user_error(self.run_program("study", document, "-o", self.folder / "part.json"), document, "runs", words)

    def test_what_does_not_belong_together_is_refused_in_one_line(self):
        paths = self.parts(small_study(), 2)
        other = self.folder / "other.json"
        self.succeed("study", self.write("study.json", small_study(name="other")), "--part", "2/2", "-o", other)
        self.study(small_study(), "whole.json")
        output = ["-o", self.folder / "merged.json"]
        self.assert_user_error(self.run_program("merge", paths[0], other, *output), other, "study", paths[0])
        self.assert_user_error(self.run_program("merge", paths[0], paths[0], *output), paths[0], "twice")
        self.assert_user_error(self.run_program("merge", paths[0], self.folder / "whole.json", *output), "whole.json", "part")
        copied = self.folder / "copy.json"
        copied.write_bytes(paths[0].read_bytes())
        self.assert_user_error(self.run_program("merge", *paths, copied, *output), copied, "found run ", paths[0])
        part = strict_json(paths[1].read_text())
        for place, value, words in [
            (("context", "commit"), "0123456", ("context.commit", "0123456")),
            (("context", "compiler"), "Clang 1", ("context.compiler", "Clang 1")),
            (("context", "flags"), "-O0", ("context.flags", "-O0")),
            (("context", "version"), "0.0.1", ("context.version", "0.0.1")),
            (("context", "program"), "their-verify", ("context.program", "their-verify")),
            (("context", "added"), ["a/b"], ("context.added", "a/b")),
            (("schema",), "sphverify-results/9", ("sphverify-results/9",)),
            (("part", "runs"), [7], ("part.runs", "7 of 3")),
            (("part", "runs"), [], ("part.runs", "0 numbers for")),
            (("part", "runs"), [*part["part"]["runs"], 0], ("part.runs",)),
            (("part", "runs"), strict_json(paths[0].read_text())["part"]["runs"], ("part.runs",)),
        ]:
            with self.subTest(place=place, value=value):
                edited = self.write("edited.json", mutated(part, place, value))
                self.assert_user_error(self.run_program("merge", paths[0], edited, *output), edited, *words)
        self.assertFalse((self.folder / "merged.json").exists())
        self.assert_user_error(self.run_program("merge", *paths, "-o", paths[0]), paths[0])
        self.assertEqual(complaints("sphverify-results-1", strict_json(paths[0].read_text())), [])


def timeless_orders(results):
    """All orders without the times of their levels."""
    all_orders = [series["orders"] for series in timeless(results)["series"]]
    return all_orders


if __name__ == "__main__":
    unittest.main(verbosity=2)
