# SPDX-License-Identifier: GPL-3.0-or-later
"""Complaints about a file begin with FILE:LINE:COLUMN, which editors and terminals turn into links."""

import sys

sys.dont_write_bytecode = True

import json
import os
import random
import unittest

from program import ProgramTest, small_study


class Places(ProgramTest):
    def refused_at(self, text, mark, *words, command=("study",), name="bad.json"):
        """The complaint is of the place in the text at which `mark` begins."""
        path = self.write(name, text)
        at = text.index(mark)
        line = 1 + text.count("\n", 0, at)
        column = at - text.rfind("\n", 0, at)
        done = self.run_program(*command, path)
        self.assert_user_error(done, *words)
        self.assertTrue(done.stderr.startswith(f"sphverify: {path}:{line}:{column}: "), (line, column, done.stderr))

    def test_a_wrong_value_is_found_by_its_key(self):
        for indent in (None, 1, 4):
            for change, mark, key in (
                ({"name": 3}, '"name"', "name: found 3"),
                ({"cases": ["nonsense"]}, '"nonsense"', "cases[0]: found"),
                ({"cases": ["hydro/noh", {"id": "noh", "parameters": {}}]}, '"id": "noh"', "cases[1].id: found"),
                ({"resolution": [8, 16, 2.5]}, "2.5", "resolution[2]: found"),
                ({"discretisation": {"layout": ["lattice", {"id": "jittered", "amplitude": "much"}]}}, '"amplitude"',
                 "discretisation.layout[1].amplitude: found"),
                ({"unknown": 1}, '"unknown"', "unknown: found an unknown key"),
            ):  # fmt: skip
                with self.subTest(key=key, indent=indent):
                    self.refused_at(json.dumps(small_study(**change), indent=indent), mark, key)

    def test_of_a_missing_key_the_place_is_that_of_the_object(self):
        text = json.dumps(small_study(cases=[{"parameters": {}}]), indent=1)
        self.refused_at(text, '{\n   "parameters"', "cases[0].id: found nothing")
        text = json.dumps(small_study(name=None), indent=1)
        self.refused_at(text, "{", "name: found nothing")

    def test_names_that_look_like_keys_or_are_written_otherwise_are_found(self):
        text = json.dumps(small_study() | {"cases[0]": 1}, indent=1)
        self.refused_at(text, '"cases[0]"', "cases[0]: found an unknown key")
        text = json.dumps(small_study() | {"name.of": 1}, indent=1)
        self.refused_at(text, '"name.of"', "name.of: found an unknown key")
        text = json.dumps(small_study(), indent=1).replace('"name": "small"', '"n\\u0061me": ["]", {"}": "\\""}]')
        self.refused_at(text, '"n\\u', "name: found a list")

    def test_columns_are_characters_and_a_byte_order_mark_is_none(self):
        text = '{"schema": "sphverify-study/1", "name": "äöü€", "cases": 1}'
        self.refused_at(text, '"cases"', "cases")
        path = self.write("marked.json", b"\xef\xbb\xbf" + text.encode())
        done = self.run_program("study", path)
        self.assertIn(f"{path}:1:{1 + text.index(chr(34) + 'cases')}: cases", done.stderr)

    def test_syntax_gates_and_states_are_found_alike(self):
        self.refused_at('{\n "a": 1,\n}', ",\n}", "a trailing comma")
        gates = '{"schema": "sphverify-gates/1", "gates": [\n  {"name": "x", "measure": "eror", "select": {}}]}'
        self.study(small_study())
        self.refused_at(gates, '"measure"', "gates[0].measure", command=("gate", "results.json"), name="gates.json")
        state = '{"schema": "sphverify-state/1",\n "dimension": 4}'
        self.refused_at(state, '"dimension"', "dimension", command=("evaluate",))

    def test_tables_and_snapshots_have_line_and_column(self):
        table = "N,l2\n10,0.1\n20, none\n"
        self.refused_at(table, "none", "l2: found 'none'", command=("order",), name="table.csv")
        self.refused_at("N,l2,l1\n10,,0.1\n20,0.1,-3\n", "-3", "l1: found '-3'", command=("order",), name="table.csv")
        self.refused_at("N,ä,l1\n10,,0.1\n", "ä", "names", command=("order",), name="table.csv")
        points = "# a comment\nx,T\n0.25,1\n0.5 , what\n"
        exact = ("exact", "conduction/slab-dirichlet", "--time", "0", "--points-file")
        self.refused_at(points.replace("x,T", "T,x"), "what", "x: found 'what'", command=exact, name="points.csv")
        self.refused_at("x,T\n0.25,1,3\n", "0.25", "3 values", command=exact, name="points.csv")

    def test_standard_input_and_pipes_are_named_without_waiting_for_more(self):
        done = self.run_program("study", "-", text='{"schema": "sphverify-study/1", "name": 3}')
        self.assert_user_error(done, "sphverify: -: name: found 3")
        done = self.run_program("study", "-", text="{,}")
        self.assert_user_error(done, "sphverify: -:1:2: found a comma")
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        process = self.start("study", pipe)
        pipe.write_text('{"schema": "sphverify-study/1", "name": 3}')
        _, said = process.communicate(timeout=60)
        self.assertEqual(said.decode(), f"sphverify: {pipe}: name: found 3, expected a string\n")

    def test_whatever_is_wrong_is_said_with_a_place_that_the_file_has(self):
        lots = random.Random(3)
        whole = json.dumps(small_study(), indent=1)
        seen = 0
        for _ in range(40):
            start = lots.randrange(len(whole))
            text = whole[:start] + lots.choice(["7", "}", '"', "null", ""]) + whole[start + lots.randrange(6) :]
            path = self.write("bad.json", text)
            done = self.run_program("study", path, "-o", "r.json")
            if done.returncode == 0 or not done.stderr.startswith(f"sphverify: {path}:"):
                continue
            place = done.stderr[len(f"sphverify: {path}:") :].split(": ")[0].split(":")
            if len(place) != 2:
                continue
            line, column = map(int, place)
            lines = (text + " ").split("\n")
            self.assertLessEqual(line, len(lines))
            self.assertLessEqual(column, len(lines[line - 1]) + 1)
            seen += 1
        self.assertGreater(seen, 20)


if __name__ == "__main__":
    unittest.main(verbosity=2)
