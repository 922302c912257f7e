# SPDX-License-Identifier: GPL-3.0-or-later
"""What python/sphverify makes of documents in pieces, of parts, and of what is no results document."""

import sys

sys.dont_write_bytecode = True

import json
import os
import subprocess
import unittest

from program import DONE, SOURCE_DIR, ProgramTest, mutated, small_study, strict_json, without
from python_module import document_of, pandas, path_of, sphverify


def light(name):
    """One of the documents without what makes it long."""
    document = document_of(name)
    for run in document["runs"]:
        for key in ("profile", "history", "spectrum"):
            run.pop(key, None)
    return document


FRAMES = ("runs", "levels", "series", "ladders", "targets", "time_to_error", "envelopes", "skipped")


class Documents(ProgramTest):
    def assert_same(self, one, other):
        for name in FRAMES:
            pandas.testing.assert_frame_equal(getattr(one, name), getattr(other, name))
        self.assertEqual(one.document, other.document)

    def assert_refused(self, document, *words):
        path = document if isinstance(document, os.PathLike) else self.write("wrong.json", document)
        with self.assertRaises(sphverify.Error) as caught:
            sphverify.load(path)
        message = str(caught.exception)
        self.assertNotIn("\n", message)
        for word in (path.name, *words):
            self.assertIn(word, message)
        self.assertIsNone(caught.exception.status)

    def test_pieces_are_the_whole_wherever_they_are_cut(self):
        document = {f"number {k}": 1234567890 * 10 ** (k % 7) for k in range(50)} | light("gas")
        document["skipped"][0]["reason"] = 'π "quoted" \\ and } ] , \u2028'
        layouts = {"indented": json.dumps(document, indent=2), "compact": json.dumps(document, ensure_ascii=False)}
        usual = sphverify.pieces.CHUNK
        self.addCleanup(setattr, sphverify.pieces, "CHUNK", usual)
        whole = sphverify.load(self.write("whole.json", document))
        self.assertEqual(whole.skipped["reason"][0], document["skipped"][0]["reason"])
        for name, text in layouts.items():
            path = self.folder / f"{name}.json"
            path.write_text(text, encoding="utf-8")
            for size in (1, 7, 100, 4096):
                with self.subTest(layout=name, size=size):
                    sphverify.pieces.CHUNK = size
                    self.assert_same(sphverify.load(path), whole)

    def test_no_more_than_a_piece_of_the_text_is_held(self):
        document = light("heat")
        document["runs"] *= 20
        document["series"] = []
        path = self.write("long.json", json.dumps(document))
        sphverify.pieces.CHUNK, usual = 4096, sphverify.pieces.CHUNK
        self.addCleanup(setattr, sphverify.pieces, "CHUNK", usual)
        longest = 0
        real = sphverify.pieces._Text.more

        def watched(text):
            nonlocal longest
            real(text)
            longest = max(longest, len(text.text))

        sphverify.pieces._Text.more = watched
        self.addCleanup(setattr, sphverify.pieces._Text, "more", real)
        self.assertEqual(len(sphverify.load(path).runs), len(document["runs"]))
        largest = max(len(json.dumps(run)) for run in document["runs"])
        self.assertLess(longest, 4 * largest + 4 * 4096)
        self.assertLess(10 * longest, path.stat().st_size)

    def test_what_is_no_results_document(self):
        self.assert_refused(small_study(), "schema: found 'sphverify-study/1', expected 'sphverify-results/1'")
        self.assert_refused(light("heat") | {"schema": "sphverify-results/2"}, "found 'sphverify-results/2'")
        self.assert_refused(without(light("heat"), ("schema",)), "found no key 'schema'")
        self.assert_refused("{}", "found no key 'schema'")
        self.assert_refused("[1]", "line 1, column 1: found '[', expected '{'")
        self.assert_refused("", "found the end of the file, expected '{'")
        self.assert_refused(b'{"schema": "\xff"}', "not UTF-8")
        self.assert_refused(self.folder, "Is a directory")
        self.assert_refused(self.folder / "nowhere.json", "No such file")

    def test_json_that_is_wrong(self):
        text = json.dumps(light("heat"), indent=1)
        cut = text.index('"spacing"')
        line = text.count("\n", 0, cut) + 1
        self.assert_refused(text[:cut] + "~" + text[cut:], f"line {line}, column ", "not JSON: expecting property name")
        usual = sphverify.pieces.CHUNK
        for sphverify.pieces.CHUNK in (50, usual):  # where it stands is known though the text before it is gone
            after = text.index('"series": [')
            before = text.rindex("\n", 0, after)
            self.assert_refused(text[:after] + "~" + text[after:],
                                f"line {text.count(chr(10), 0, after) + 1}, column {after - before}: found '~'")  # fmt: skip
        self.assert_refused(text + "{", "found more text")
        self.assert_refused('{"schema": "sphverify-results/1", "runs": {}}', "found '{', expected '['")
        self.assert_refused('{"schema": "sphverify-results/1", "study": NaN}', "found NaN")
        self.assert_refused('{"schema": "sphverify-results/1", "study": 1, "study": 2}', "the key 'study' twice")
        self.assert_refused('{"schema": "sphverify-results/1", "study": ' + "[" * 100000 + "]" * 100000 + "}", "not JSON")

    def test_a_document_that_was_cut_off(self):
        text = path_of("modes").read_text()
        self.assertEqual(text.rstrip()[-1], "}")
        for size in range(1, len(text.rstrip()), max(1, len(text) // 200)):
            with self.subTest(size=size):
                self.assert_refused(text[:size], "line ")

    def test_keys_that_are_missing_or_wrong(self):
        document = light("heat")
        self.assert_refused(without(document, ("runs", 1, "status")), "runs[1]: found no key 'status'")
        self.assert_refused(without(document, ("series", 0, "orders")), "series[0]: found no key 'orders'")
        self.assert_refused(without(document, ("context",)), "found no key 'context'")
        self.assert_refused(mutated(document, ("runs", 2), 7), "runs[2]: not as in sphverify-results/1")
        self.assert_refused(mutated(document, ("runs", 2, "errors"), []), "runs[2]: not as in")
        self.assert_refused(mutated(document, ("runs", 2, "resolution"), "ten"), "resolution: found 'ten', expected a whole number")
        self.assert_refused(mutated(document, ("runs", 2, "resolution"), 8.5), "resolution: found 8.5, expected a whole number")
        self.assert_refused(mutated(document, ("runs", 2, "spacing"), "0.1"), "spacing: found '0.1', expected a number")
        self.assert_refused(mutated(document, ("runs", 2, "case"), 1), "case: found 1, expected a text")
        self.assert_refused(mutated(document, ("skipped",), [1]), "not as in sphverify-results/1")
        self.assert_refused(mutated(document, ("series", 1, "runs"), [0]), "series[1]", "run 0 is in series[0] too")
        self.assert_refused(mutated(document, ("series", 0, "runs", 0), 10**6), "found run 1000000, expected less than")

    def test_a_schema_that_stands_last_is_looked_at_too(self):
        document = light("heat")
        first = sphverify.load(self.write("first.json", document))
        schema = document.pop("schema")
        self.assert_same(sphverify.load(self.write("last.json", document | {"schema": schema})), first)
        self.assert_refused(document | {"schema": "sphverify-results/2"}, "found 'sphverify-results/2'")

    def test_parts_and_machines(self):
        study = self.write("study.json", small_study(resolution=[8, 12, 16, 20], measure=["error", "cost"]))
        for part in (1, 2):
            self.succeed("study", study, "--part", f"{part}/2", "-o", f"part-{part}.json")
        part = sphverify.load(self.folder / "part-2.json")
        document = strict_json((self.folder / "part-2.json").read_text())
        self.assertEqual(part.document["part"], document["part"])
        self.assertEqual(len(part.runs), len(document["part"]["runs"]))
        self.assertTrue(part.runs["series"].isna().all())
        self.assertEqual(len(part.series), 0)
        self.assertIn("order", part.series)
        self.assertIn("part", repr(part))

        document["context"]["machine"] = "elsewhere"
        for run in document["runs"]:
            run["cost"]["machine"] = "elsewhere"
        self.write("part-2.json", document)
        self.succeed("merge", "part-1.json", "part-2.json", "-o", "whole.json")
        whole = sphverify.load(self.folder / "whole.json")
        self.assertTrue(whole.series["is_timed_apart"].all())
        self.assertTrue(whole.ladders["is_timed_apart"].all())
        self.assertEqual(whole.runs["cost.machine"].nunique(), 2)
        self.assertTrue(whole.ladders["seconds"].isna().all())
        self.assertEqual(len(whole.time_to_error), 0)
        self.assertEqual(len(whole.document["shares"]), 2)

    def test_without_pandas_one_line_says_so(self):
        text = "import sys; sys.modules['pandas'] = None; import sphverify"
        done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True,
                              env=os.environ | {"PYTHONPATH": str(SOURCE_DIR / "python")})  # fmt: skip
        self.assertNotEqual(done.returncode, DONE)
        self.assertEqual(done.stderr.splitlines()[-1],
                         "ImportError: sphverify needs pandas, which is not installed (Debian: apt install python3-pandas)")  # fmt: skip


if __name__ == "__main__":
    unittest.main()
