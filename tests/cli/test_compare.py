# SPDX-License-Identifier: GPL-3.0-or-later
"""`sphverify compare` in all its formats."""

import sys

sys.dont_write_bytecode = True

import csv
import io
import itertools
import math
import re
import unittest

from program import SOURCE_DIR, ProgramTest, environment, small_study, strict_json

SCHEMES = ["conduction/brookshaw", "conduction/lucy-flux", "conduction/campbell-flux"]
STANDARD_STUDY = small_study(  # of the kind that the contract shows, with fewer particles
    cases=["conduction/slab-dirichlet", "conduction/manufactured"],
    formulations=SCHEMES + [{"id": scheme, "walls": "off"} for scheme in SCHEMES],
    discretisation={
        "density": ["given", "summation"],
        "layout": ["lattice", {"id": "jittered", "amplitude": 0.1, "seeds": [1, 2]}],
    },
    resolution=[10, 15, 20, 30],
    smoothing_exponent=[0, 0.5],
)
SERIES = 2 * 6 * 2 * 2 * 2
WIDEST = 80  # where neither a terminal nor COLUMNS says how wide


class Compare(ProgramTest):
    @classmethod
    def setUpClass(cls):
        helper = cls()
        helper.setUp()
        try:
            helper.study(STANDARD_STUDY)
            cls.document = (helper.folder / "results.json").read_text()
        finally:
            helper.doCleanups()

    def runTest(self):
        """Lets `setUpClass` make an instance."""

    def setUp(self):
        super().setUp()
        self.results = getattr(self, "document", None) and self.write("results.json", self.document)

    def compare(self, *arguments, env=None):
        return self.succeed("compare", self.results, *arguments, env=env)

    def assert_within(self, columns, text):
        widest = max(text.splitlines(), key=len)
        self.assertLessEqual(len(widest), columns, widest)

    def test_lines_stay_within_80_columns_where_nobody_says_how_many_there_are(self):
        for options in ((), ("--region", "wall"), ("--norm", "linf"), ("--region", "interior"), ("--legend",),
                        ("--section", "levels")):  # fmt: skip
            with self.subTest(options=options):
                self.assert_within(WIDEST, self.compare(*options))

    def test_lines_are_as_long_as_columns_says(self):
        for columns in (60, 120, 200):
            with self.subTest(columns=columns):
                text = self.compare("--legend", env=environment(COLUMNS=str(columns)))
                self.assert_within(columns, text)
                self.assertGreater(max(map(len, text.splitlines())), 0.8 * columns)
        narrow, wide = (self.compare(env=environment(COLUMNS=columns)).count("\n") for columns in ("80", "160"))
        self.assertLess(wide, narrow, "fewer blocks and broken lines")
        unasked = self.compare()
        for nonsense in ("", "wide", "0", "-5", "80x"):
            self.assertEqual(self.compare(env=environment(COLUMNS=nonsense)), unasked, nonsense)

    def test_the_answer_comes_first_and_fits_on_the_first_screen(self):
        text = self.compare()
        answer = text[: text.index("Below: case by case")].splitlines() + [""]
        self.assertTrue(answer[0].startswith("Which formulation? 2 cases on 2 layouts"), answer[0])
        self.assertRegex(answer[2], r"^brookshaw: smallest error on \d+ of 4 scenes: ")
        self.assertLessEqual(len(answer), 24, text)
        for scheme in SCHEMES:
            name = scheme.split("/")[1]
            self.assertTrue(any(line.startswith(f"{name}: ") for line in answer), name)
            self.assertTrue(any(line.startswith(f"{name} (walls off) ") for line in answer), name)
            self.assertFalse(any(line.startswith(f"{name} (walls off):") for line in answer), "controls have no verdict")
        controls = next(k for k, line in enumerate(answer) if line.startswith("control "))
        for line in answer[controls + 2 :]:
            if line and not line.startswith(" "):
                self.assertIn("(walls off)", line)
        self.assertIn("h/dx 1.2 (N/10)^0.5", text)

    def test_each_formulation_stands_at_its_best_setting_over_all_scenes(self):
        table = strict_json(self.compare("--format", "json"))
        self.assert_valid("sphverify-comparison-1", table)
        (group,) = table["summary"]
        scenes = [(scene["case"], scene["layout"]) for scene in group["scenes"]]
        self.assertEqual(len(scenes), 4)
        choices = ("density", "smoothing_exponent")
        for row in group["formulations"]:
            scores = {}
            for setting in itertools.product(("given", "summation"), ("0", "0.5")):
                ladders = [
                    one
                    for one in table["series"]
                    if one["formulation"] == row["formulation"] and tuple(one[c] for c in choices) == setting
                ]
                self.assertEqual(sorted((one["case"], one["layout"]) for one in ladders), sorted(scenes))
                sound = [one for one in ladders if not one["failures"]]
                logs = [math.log(one["relative_error"]) for one in sound]
                scores[setting] = (
                    len(ladders) - len(sound),
                    sum(one["verdict"] == "diverging" for one in sound),
                    sum(logs) / len(logs) if logs else math.inf,
                )
            best = min(scores.values())
            said = scores[tuple(row[c] for c in choices)]
            self.assertEqual((row["failed"], row["diverging"]), said[:2], row["formulation"])
            self.assertEqual(said[:2], best[:2])
            self.assertAlmostEqual(said[2], best[2], places=12)
            self.assertAlmostEqual(math.log(row["error"]), said[2], places=12)
            self.assertEqual(row["settings_tried"], 4)
            self.assertEqual(row["control"], "(walls off)" in row["formulation"])
        ranks = [(row["control"], row["failed"], row["diverging"], row["error"]) for row in group["formulations"]]
        self.assertEqual(ranks, sorted(ranks))

    def test_the_answer_on_a_moving_gas_fits_on_the_first_screen_too(self):
        forms = [{"id": "momentum/p-rho2", "conduction": "conduction/brookshaw"}, "momentum/sqrt-p",
                 {"id": "momentum/p-rho2", "work": "work/total-energy"}, "momentum/direct-gradient",
                 "momentum/p-rho2"]  # fmt: skip
        cases = [{"id": "hydro/manufactured", "parameters": {"drive": drive}} for drive in ("velocity", "pressure")]
        study = small_study(
            cases=["hydro/piston-velocity", "hydro/piston-pressure", "hydro/noh", "coupled/hot-wall", *cases],
            formulations=forms,
            discretisation={"density": ["continuity", "normalised"], "closure": ["interpolated", "one-sided"]},
            resolution=[8, 12],
        )
        self.study(study, "gas.json")
        text = self.succeed("compare", "gas.json", "--section", "summary")
        self.assert_within(80, text)
        self.assertLessEqual(text.count("\n"), 24, text)
        self.assertIn("manufactured (2)", text)
        self.assertIn("Also hot-wall on lattice", text)
        compared = strict_json(self.succeed("compare", "gas.json", "--format", "json"))
        groups = compared["summary"]
        self.assertEqual([len(group["scenes"]) for group in groups], [5, 1])
        viscosities = {row["viscosity"] for row in compared["series"]}
        self.assertGreater(len(viscosities), 1, "cases choose their own, which is no setting")
        self.assertEqual({row["settings_tried"] for row in groups[0]["formulations"]}, {4})

    def test_the_direct_gradient_is_a_control(self):
        forms = ["momentum/p-rho2", "momentum/sqrt-p", "momentum/direct-gradient"]
        self.study(small_study(cases=["operator/sine"], formulations=forms), "momentum.json")
        (group,) = strict_json(self.succeed("compare", "momentum.json", "--format", "json"))["summary"]
        controls = [row["formulation"] for row in group["formulations"] if row["control"]]
        self.assertEqual(controls, ["momentum/direct-gradient"])
        self.assertEqual(group["formulations"][-1]["formulation"], "momentum/direct-gradient")
        self.assertFalse(any("direct-gradient" in sentence for sentence in group["sentences"]))

    def test_what_cannot_be_compared_is_ranked_apart(self):
        study = small_study(cases=["operator/sine"], formulations=["conduction/brookshaw", "momentum/p-rho2"])
        self.study(study, "operator.json")
        groups = strict_json(self.succeed("compare", "operator.json", "--format", "json"))["summary"]
        self.assertEqual([len(group["formulations"]) for group in groups], [1, 1])
        self.assertEqual({scene["field"] for group in groups for scene in group["scenes"]},
                         {"conduction heating", "acceleration"})  # fmt: skip

    def test_the_summary_can_be_asked_for_alone_in_every_format(self):
        text = self.compare("--section", "summary")
        self.assertNotIn("order or verdict", text)
        self.assertIn("--section series", text)
        rows = list(csv.DictReader(io.StringIO(self.compare("--section", "summary", "--format", "csv"))))
        (group,) = strict_json(self.compare("--format", "json"))["summary"]
        for row, entry in zip(rows, group["formulations"], strict=True):
            self.assertEqual(row["formulation"], entry["formulation"])
            self.assertEqual(float(row["error"]), entry["error"])
            self.assertEqual(row["control"], str(entry["control"]).lower())
        markdown = self.compare("--section", "summary", "--format", "markdown")
        self.assertTrue(markdown.startswith("### Which formulation?"), markdown[:80])
        self.assertIn("- brookshaw: smallest error", markdown)

    def test_the_legend_is_shown_only_when_asked_for(self):
        self.assertIn("What the marks mean: --legend.", self.compare())
        self.assertNotIn("worse than any number", self.compare())
        legend = self.compare("--legend")
        self.assertIn("worse than any number", legend)
        self.assertNotIn("What the marks mean: --legend.", legend)

    def test_levels_hold_every_error_of_every_run_in_long_format(self):
        text = self.compare("--section", "levels", "--format", "csv")
        self.assertNotRegex(text, r'["#;\t]')
        lines = [line.split(",") for line in text.splitlines()]
        self.assertEqual({len(line) for line in lines}, {len(lines[0])}, "no cell holds a comma")
        rows = [dict(zip(lines[0], line)) for line in lines[1:]]
        runs = strict_json(self.document)["runs"]
        expected = []
        for run in runs:
            errors = [(field, region, numbers) for field, regions in run["errors"].items()
                      for region, numbers in regions.items()]  # fmt: skip
            expected += [(run, *error) for error in errors or [("", "", None)]]
        self.assertEqual(len(rows), len(expected))
        for row, (run, field, region, numbers) in zip(rows, expected):
            seed = run["discretisation"]["layout"]["seed"] if isinstance(run["discretisation"]["layout"], dict) else ""
            self.assertEqual((row["case"], row["N"], row["status"], row["field"], row["region"], row["seed"]),
                             (run["case"], str(run["resolution"]), run["status"], field, region, str(seed)))  # fmt: skip
            self.assertEqual(float(row["spacing"]), run["spacing"])
            for norm in ("l1", "l2", "linf"):
                self.assertEqual(row[norm] and float(row[norm]), numbers[norm] if numbers else "")
                self.assertEqual(row[f"scale_{norm}"] and float(row[f"scale_{norm}"]),
                                 numbers["scale"][norm] if numbers else "")  # fmt: skip
        document = strict_json(self.compare("--section", "levels", "--format", "json"))
        self.assert_valid("sphverify-comparison-1", document)
        self.assertEqual(len(document["levels"]), len(rows))
        self.assertNotIn("levels", strict_json(self.compare("--format", "json")))
        self.assertEqual(self.compare("--section", "levels").count("Error of temperature, region wall"), 8)

    def test_the_table_is_the_default_and_names_every_scheme_case_and_choice(self):
        text = self.compare()
        self.assertEqual(text, self.compare("--format", "table"))
        for word in ("brookshaw", "lucy-flux", "campbell-flux", "slab-dirichlet", "manufactured",
                     "given", "summation", "lattice", "jitter", "(walls off)", "All ladders"):  # fmt: skip
            self.assertIn(word, text)

    def test_every_format_is_free_of_escape_codes_off_a_terminal(self):
        for name in ("table", "markdown", "csv", "json"):
            text = self.compare("--format", name)
            self.assertIsNone(re.search(r"[\x00-\x09\x0b-\x1f\x7f]", text), name)

    def test_markdown_holds_tables_whose_rows_have_equal_numbers_of_cells(self):
        lines = self.compare("--format", "markdown").splitlines()
        tables, table = [], []
        for line in [*lines, ""]:
            if line.startswith("|"):
                self.assertTrue(line.endswith("|"), line)
                table.append(line.count("|"))
            elif table:
                tables.append(table)
                table = []
        self.assertGreaterEqual(len(tables), 4, "three cases and a summary")
        for counts in tables:
            self.assertGreater(len(counts), 2)
            self.assertEqual(len(set(counts)), 1, counts)
        self.assertTrue(any(re.fullmatch(r"\|(:?-+:?\|)+", line) for line in lines))
        self.assertTrue(any(line.startswith("#") for line in lines))

    def test_markdown_explains_its_marks_as_a_list(self):
        lines = self.compare("--format", "markdown", "--legend").splitlines()
        legend = lines[max(k for k, line in enumerate(lines) if line.startswith("|")) + 1 :]
        marks = {line.split("`")[1] for line in legend if line.startswith("- `")}
        self.assertLessEqual({"*", "(walls off)", "(N/25)^0.5", "~1.2", "<=", "floored, diverges"}, marks)
        self.assertTrue(all(line.startswith("- ") for line in legend if line), legend)

    def test_csv_has_a_header_and_one_row_per_series(self):
        rows = list(csv.reader(io.StringIO(self.compare("--format", "csv")), strict=True))
        self.assertEqual(len(rows), 1 + SERIES)
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        self.assertEqual(len(set(rows[0])), len(rows[0]), "every column has a name of its own")
        for row in csv.DictReader(io.StringIO(self.compare("--format", "csv"))):
            self.assertIn(row["case"], STANDARD_STUDY["cases"])
            self.assertTrue(float(row["error"]) > 0 if not row["failures"] else row["error"] == "", row)

    def test_json_holds_the_numbers_of_the_results_document(self):
        document = strict_json(self.document)
        table = strict_json(self.compare("--format", "json"))
        self.assertEqual(len(table["series"]), SERIES)
        for row, series in zip(table["series"], document["series"]):
            self.assertEqual((row["case"], row["formulation"]), (series["case"], series["label"]))
            order = next(o for o in series["orders"]
                         if (o["field"], o["region"], o["norm"]) == ("temperature", "all", "l2"))  # fmt: skip
            self.assertEqual(row["verdict"], order["verdict"])
            self.assertEqual(row["order"], order["order"])
            self.assertEqual(row["error"], order["levels"][-1]["error"])

    def test_csv_and_json_hold_the_same_rows(self):
        table = strict_json(self.compare("--format", "json"))["series"]
        rows = list(csv.DictReader(io.StringIO(self.compare("--format", "csv"))))
        for entry, row in zip(table, rows, strict=True):
            self.assertEqual(list(entry), list(row))
            for key, value in entry.items():
                if isinstance(value, str):
                    self.assertEqual(row[key], value)
                elif value is None:
                    self.assertEqual(row[key], "")
                else:
                    self.assertEqual(float(row[key]), value)

    def test_region_and_norm_choose_other_numbers(self):
        document = strict_json(self.document)
        table = strict_json(self.compare("--format", "json", "--region", "wall", "--norm", "linf"))
        self.assertEqual((table["region"], table["norm"]), ("wall", "linf"))
        order = next(o for o in document["series"][0]["orders"] if (o["region"], o["norm"]) == ("wall", "linf"))
        self.assertEqual(table["series"][0]["error"], order["levels"][-1]["error"])

    def test_a_region_that_nothing_has_is_refused(self):
        result = self.run_program("compare", self.results, "--region", "corner")
        self.assert_user_error(result, "--region: found corner, expected one of all")

    def test_options_that_a_section_or_format_would_pass_over_are_refused(self):
        for options, words in (
            (("--section", "surface", "--region", "wall"), ("--region", "wall", "error surface")),
            (("--section", "surface", "--norm", "l1"), ("--norm", "l1")),
            (("--section", "levels", "--region", "wall"), ("--region", "every region and norm")),
            (("--section", "levels", "--norm", "linf", "--format", "csv"), ("--norm",)),
            (("--section", "envelopes", "--region", "wall"), ("--region",)),
            (("--legend", "--format", "csv"), ("--legend", "--format csv")),
            (("--legend", "--format", "json"), ("--legend",)),
            (("--legend", "--section", "changes"), ("--legend", "changes")),
        ):
            with self.subTest(options=options):
                self.assert_user_error(self.run_program("compare", self.results, *options), *words)
        self.compare("--section", "surface", "--region", "all")

    def test_a_region_is_refused_where_there_is_no_ladder(self):
        envelope = {"parameter": "smoothing_ratio", "from": 1.2, "to": 0.5, "bisections": 1}
        self.study(small_study(envelope=envelope, resolution=20, measure="error"), "limits.json")
        self.succeed("compare", "limits.json")
        for option in (("--region", "wall"), ("--norm", "l1")):
            self.assert_user_error(self.run_program("compare", "limits.json", *option), option[0], "no ladder")

    def test_every_section_is_in_the_documentation(self):
        known = re.findall(r"(?m)^ +(\w+): ", self.succeed("compare", "--help", env=environment(COLUMNS="200")))
        self.assertLessEqual({"summary", "surface", "changes"}, set(known))
        table = (SOURCE_DIR / "docs" / "compare.md").read_text()
        for section in known:
            self.assertRegex(table, rf"(?m)^\| `{section}` \|")

    def test_the_best_of_a_column_is_marked_and_has_the_smallest_error(self):
        table = self.compare("--section", "series", env=environment(COLUMNS="160")).split("\n\n")[0].splitlines()
        rule = next(k for k, line in enumerate(table) if set(line.strip()) <= {"-", " "} and "-" in line)
        body = table[rule + 1 :]
        starts = [match.start() for match in re.finditer("-+", table[rule])]
        columns = len(starts) - 2  # formulation and density are labels
        self.assertEqual(columns, 4)
        for column in range(2, 2 + columns):
            end = starts[column + 1] if column + 1 < len(starts) else None
            cells = [line[starts[column] : end].strip() for line in body]
            best = [cell for cell in cells if cell.endswith("*")]
            self.assertTrue(best)
            errors = [float(cell.split()[0]) for cell in cells if cell[0].isdigit()]  # the others failed
            self.assertGreater(len(errors), 6)
            self.assertEqual(float(best[0].split()[0]), min(errors))

    def test_several_documents_stand_side_by_side_under_their_names(self):
        self.study(small_study(), "first.json")
        self.study(small_study(discretisation={"smoothing_ratio": 1.2, "face_weight": "campbell"}), "second.json")
        arguments = ("compare", self.folder / "first.json", self.folder / "second.json")
        table = self.succeed(*arguments)
        self.assertIn("first", table)
        self.assertIn("second", table)
        rows = strict_json(self.succeed(*arguments, "--format", "json"))["series"]
        self.assertEqual([row["results"] for row in rows], ["first", "second"])

    def test_files_of_one_name_are_told_apart_by_their_folders(self):
        for folder in ("old", "new"):
            (self.folder / folder).mkdir()
            self.study(small_study(), "results.json")
            (self.folder / "results.json").rename(self.folder / folder / "results.json")
        text = self.succeed("compare", "old/results.json", "new/results.json")
        self.assertIn("What changed: new/results against old/results", text)

    def test_a_study_run_twice_repeats_exactly_and_times_are_not_compared(self):
        self.study(small_study(repeat=1), "first.json")
        self.study(small_study(repeat=1), "second.json")
        arguments = ("compare", self.folder / "first.json", self.folder / "second.json", "--section", "changes")
        text = self.succeed(*arguments)
        self.assertIn("Nothing changed beyond noise", text)
        self.assertNotIn("seconds", text)
        document = strict_json(self.succeed(*arguments, "--format", "json"))
        self.assert_valid("sphverify-comparison-1", document)
        for count in document["changes"][0]["counts"]:
            self.assertEqual(count["same"], 1, count)

    def test_an_error_three_times_as_large_is_a_change_for_the_worse(self):
        before = self.study(small_study(), "before.json")
        for order in before["series"][0]["orders"]:
            for level in order["levels"]:
                if level["error"] is not None:
                    level["error"] /= 3
        self.write("before.json", before)
        self.study(small_study(), "after.json")
        arguments = ("compare", self.folder / "before.json", self.folder / "after.json", "--section", "changes")
        change = strict_json(self.succeed(*arguments, "--format", "json"))["changes"][0]["changes"][0]
        self.assertEqual((change["measure"], change["direction"]), ("error", "worse"))
        self.assertAlmostEqual(change["after"] / change["before"], 3)
        rows = list(csv.DictReader(io.StringIO(self.succeed(*arguments, "--format", "csv"))))
        self.assertEqual(float(rows[0]["after"]), change["after"])
        for name in ("table", "markdown"):
            self.assertIn("x3", self.succeed(*arguments, "--format", name))

    def test_changes_of_one_document_are_refused(self):
        result = self.run_program("compare", self.results, "--section", "changes")
        self.assert_user_error(result, "--section", "two documents")

    def test_envelopes_are_shown_in_every_format(self):
        envelope = {"parameter": "smoothing_ratio", "from": 1.2, "to": 0.5, "bisections": 3}
        self.study(
            small_study(
                cases="conduction/slab-dirichlet",
                formulations=SCHEMES,
                envelope=envelope,
                resolution=40,
                measure="error",
            ),
            "limits.json",
        )
        limits = self.folder / "limits.json"
        for name in ("table", "markdown"):
            text = self.succeed("compare", limits, "--format", name)
            self.assertIn("smoothing_ratio", text)
            self.assertIn("unstable", text)
            self.assertIn("held to", text)
        document = strict_json(self.succeed("compare", limits, "--format", "json"))
        self.assert_valid("sphverify-comparison-1", document)
        rows = list(csv.DictReader(io.StringIO(self.succeed("compare", limits, "--format", "csv"))))
        self.assertEqual([row["formulation"] for row in rows], SCHEMES)
        self.assertEqual([float(row["held"]) for row in rows], [e["held"] for e in document["envelopes"]])

    def test_stability_and_the_second_law_have_tables_where_they_were_measured(self):
        self.assertNotIn("second law", self.compare())
        study = small_study(measure=["error", "stability", "stable-step", "second-law"], formulations=SCHEMES)
        self.study(study, "stability.json")
        text = self.succeed("compare", self.folder / "stability.json")
        for word in ("modes of the linearised rate", "longest stable step", "explicit-euler", "second law"):
            self.assertIn(word, text)
        self.assertLessEqual(max(map(len, text.splitlines())), WIDEST)
        document = strict_json(self.succeed("compare", self.folder / "stability.json", "--format", "json"))
        self.assert_valid("sphverify-comparison-1", document)

    def test_a_study_without_runs_is_still_a_document_in_every_format(self):
        nothing = self.folder / "nothing.json"
        study = self.write("study-of-nothing.json", small_study(formulations=["momentum/p-rho2"]))
        self.assert_user_error(self.run_program("study", study, "-o", nothing), "nothing to run")
        table = strict_json(self.succeed("compare", nothing, "--format", "json"))
        self.assertEqual(table["series"], [])
        rows = list(csv.reader(io.StringIO(self.succeed("compare", nothing, "--format", "csv"))))
        self.assertLessEqual(len(rows), 1)
        self.assertTrue(not rows or "case" in rows[0], rows)
        self.assertTrue(self.succeed("compare", nothing))

    def test_failed_runs_are_named_and_left_out_of_the_best(self):
        self.study(small_study(time_budget=1e-9), "late.json")
        self.assertIn("timed-out", self.succeed("compare", self.folder / "late.json"))

    def test_results_with_numbers_that_do_not_exist_can_be_compared(self):
        results = self.study(small_study(cases=["operator/sine"]), "overflow.json")
        for run in results["runs"]:
            run["status"] = "non-finite"
            for regions in run["errors"].values():
                regions["all"].update(l1=None, l2=None, linf=None)
        for series in results["series"]:
            for order in series["orders"]:
                for level in order["levels"]:
                    level["error"] = None
        self.write("overflow.json", results)
        for name in ("table", "markdown", "csv", "json"):
            self.succeed("compare", self.folder / "overflow.json", "--format", name)

    def test_a_table_whose_rows_compare_different_fields_says_so(self):
        study = small_study(cases=["operator/sine"], formulations=["conduction/brookshaw", "momentum/p-rho2"])
        self.study(study, "operator.json")
        text = self.succeed("compare", self.folder / "operator.json")
        self.assertIn("heating", text)
        self.assertIn("acceleration", text)


if __name__ == "__main__":
    unittest.main(verbosity=2)
