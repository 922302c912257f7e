# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of a case that make no sense: one line with file, path, what was found and what is expected; and no number
that is none in any message or table."""

import sys

sys.dont_write_bytecode = True

import itertools
import json
import re
import unittest

from program import DONE, SOURCE_DIR, USER_ERROR, ProgramTest, small_study, strict_json

NO_NUMBER = re.compile(r"(?<![\w-])-?(nan|inf)(?![\w-])", re.IGNORECASE)


class Values(ProgramTest):
    def refuse_parameter(self, case, name, value, place, *words):
        study = small_study(cases=[{"id": case, "parameters": {name: value} if name else value}])
        path = self.write("study.json", study)
        result = self.run_program("study", path)
        self.assert_user_error(result, f"{path}: cases[0].parameters{place}: found ", ", expected ", *words)

    def test_a_parameter_that_makes_no_sense_is_named_with_its_path(self):
        for case, name, value, place, words in (
            ("conduction/slab-dirichlet", "final_time", -1, ".final_time", ["found -1", "positive"]),
            ("conduction/slab-dirichlet", "conductivity", 0, ".conductivity", ["found 0", "positive"]),
            ("conduction/slab-dirichlet", "modes", [[1, 1], [1, 2, 3]], ".modes[1]", ["a list of 3", "[number, amplitude]"]),
            ("conduction/slab-dirichlet", "modes", [[1.5, 1]], ".modes[0][0]", ["found 1.5", "whole number"]),
            ("conduction/slab-dirichlet", "turn", 0.3, ".turn", ["found 0.3", "0 in one dimension"]),
            ("conduction/square", "modes", [[1, 0, 1]], ".modes[0][1]", ["found 0", "from 1"]),
            ("conduction/square", "walls", "open", ".walls", ["found 'open'", "one of dirichlet, mixed"]),
            ("conduction/half-space-step", "density", 0, ".density", ["found 0"]),
            ("conduction/barenblatt", "exponent", 1, ".exponent", ["found 1", "above 1"]),
            ("conduction/barenblatt", "start_time", 0, ".start_time", ["found 0"]),
            ("conduction/barenblatt", "half_width", 1, ".half_width", ["found 1", "front"]),
            ("conduction/marshak", "exponent", 1e-5, ".exponent", ["0.001 or more"]),
            ("conduction/marshak", "final_time", 100, ".final_time", ["found 100", "front"]),
            ("operator/sine", "dimension", 4, ".dimension", ["found 4", "1, 2 or 3"]),
            ("operator/polynomial", "degree", -1, ".degree", ["found -1"]),
            ("hydro/acoustic", "amplitude", 2, ".amplitude", ["found 2", "below"]),
            ("hydro/acoustic", "final_time", 1e5, ".final_time", ["found 100000", "breaks"]),
            ("hydro/gresho", "mach", 10, ".mach", ["found 10"]),
            ("hydro/noh", "gamma", 0.5, ".gamma", ["found 0.5", "above 1"]),
            ("hydro/noh", "final_time", 2, ".final_time", ["found 2"]),
            ("hydro/piston-velocity", "initial_pressure", 2, ".pressure", ["found 1", "initial_pressure, 2"]),
            ("hydro/sedov", "pressure", 1, ".pressure", ["found 1", "strong"]),
            ("hydro/simple-wave", "rise_time", 0, ".rise_time", ["found 0"]),
            ("hydro/riemann", "interface", 2, ".interface", ["found 2", "between 0 and 1"]),
            ("hydro/riemann", "preset", "sodd", ".preset", ["found 'sodd'", "toro-5"]),
            ("hydro/riemann", "preset", "custom", ".preset", ["custom without them"]),
            ("hydro/riemann", "left", [1, 0], ".left", ["a list of 2", "[density, velocity, pressure]"]),
            ("hydro/riemann", "left", [1, 0, 1], ".right", ["nothing", "[density, velocity, pressure]"]),
            ("hydro/riemann", None, {"left": [1, 0, -1], "right": [1, 0, 1]}, ".left[2]", ["found -1"]),
            ("hydro/riemann", None, {"left": [1, 0, 1], "right": [-1, 0, 1]}, ".right[0]", ["found -1"]),
            ("hydro/riemann", None, {"gamma": 1.2}, ".gamma", ["found 1.2", "no effect"]),
            ("coupled/conducting-shock", "pressure", 100, ".pressure", ["found 100"]),
            ("coupled/conducting-shock", "centre", 0.01, ".centre", ["found 0.01 with a tail", "walls"]),
            ("coupled/hot-wall", "wall", 0, ".wall", ["found 0"]),
            ("coupled/manufactured", "conductivity", -1, ".conductivity", ["found -1"]),
            ("extreme/radiative-cooling", "start", 0, ".start", ["found 0"]),
            ("extreme/radiative-cooling", "exponent", 9, ".exponent", ["found 9", "from 1 to 8"]),
            ("extreme/cold-front", "exponent", 40, ".exponent", ["found 40", "at most"]),
            ("extreme/radiative-wall", "start", 1, ".start", ["found 1", "above 1"]),
        ):  # fmt: skip
            with self.subTest(case=case, parameter=name, value=value):
                self.refuse_parameter(case, name, value, place, *words)

    def test_what_follows_from_several_parameters_is_told_of_them_all(self):
        still = {"left": [0, 0, 0], "right": [0, 0, 0]}
        self.refuse_parameter("hydro/riemann", None, still, "", "density of one side")

    def test_numbers_beyond_all_sense_are_refused_where_they_stand(self):
        for value in (1e300, -1e300, 1e-300, 1e101):
            with self.subTest(value=value):
                self.refuse_parameter("hydro/riemann", None, {"left": [1, 0, value], "right": [1, 0, 1]}, ".left[2]",
                                      "a size from 1e-100 to 1e100")  # fmt: skip
                self.refuse_parameter("conduction/slab-dirichlet", "modes", [[1, value]], ".modes[0][1]")
                self.refuse_parameter("conduction/slab-dirichlet", "left", value, ".left")
        path = self.write("wide.json", small_study(discretisation={"smoothing_ratio": 1e308}))
        self.assert_user_error(self.run_program("study", path), "discretisation.smoothing_ratio: found 1e+308", "1e+06")
        driven = {"parameter": "left", "from": 1, "to": 1e300}
        path = self.write("driven.json", small_study(envelope=driven, resolution=[8]))
        self.assert_user_error(self.run_program("study", path), "envelope.to: found 1e+300")
        for to, words in ((-1, ["found -1", "positive"]), (0, ["found 0"])):
            path = self.write("driven.json", small_study(envelope={"parameter": "conductivity", "from": 1, "to": to}))
            self.assert_user_error(self.run_program("study", path), "envelope.to", *words)

    def test_extreme_values_give_no_number_that_is_none_in_any_message(self):
        states = ([1e100, 0, 1e-100], [1e-100, 1e100, 1e100], [1e-100, -1e100, 1e-100], [1, 0, 1e100])
        for left, right in itertools.product(states, repeat=2):
            for gamma in (1.0000001, 1.4, 1e100):
                parameters = {"left": left, "right": right, "gamma": gamma}
                case = {"id": "hydro/riemann", "parameters": parameters}
                study = small_study(cases=[case], formulations=["momentum/p-rho2"], discretisation=None, resolution=[8],
                                    time_budget=0.5)  # fmt: skip
                with self.subTest(parameters=parameters):
                    result = self.run_program("study", self.write("study.json", study))
                    self.assertIn(result.returncode, (DONE, USER_ERROR))
                    self.assertNotRegex(result.stderr, NO_NUMBER)
                    self.assertNotRegex(result.stdout, NO_NUMBER)

    def test_places_beyond_all_sense_are_refused_in_a_state(self):
        whole = strict_json((SOURCE_DIR / "examples" / "state.json").read_text())
        for change, place in (("smoothing_length", "particles.smoothing_length"), ("position", "particles.position[0][0]")):
            state = json.loads(json.dumps(whole))
            if change == "position":
                state["particles"]["position"][0][0] = 1e308
            else:
                state["particles"][change] = 1e308
            with self.subTest(place=place):
                path = self.write("state.json", state)
                self.assert_user_error(self.run_program("evaluate", path), f"{path}: {place}: found 1e+308", "1e+100")


class Tables(ProgramTest):
    def test_runs_that_never_began_have_no_spacing_in_any_table(self):
        results = self.study(small_study())
        results["runs"][0] |= {"status": "invalid", "reason": "edited", "errors": {}, "spacing": None, "smoothing_length": None}
        self.write("results.json", results)
        for section, form in itertools.product(("summary", "series", "levels"), ("table", "markdown", "csv", "json")):
            result = self.run_program("compare", "results.json", "--section", section, "--format", form)
            with self.subTest(section=section, format=form):
                self.assertIn(result.returncode, (DONE, USER_ERROR))  # not every section has every format
                self.assertNotRegex(result.stdout, NO_NUMBER)


if __name__ == "__main__":
    unittest.main(verbosity=2)
