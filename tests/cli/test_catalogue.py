# SPDX-License-Identifier: GPL-3.0-or-later
"""`list` and `describe` know every identifier of the contract, and every command explains itself."""

import sys

sys.dont_write_bytecode = True

import re
import time
import unittest

from program import ProgramTest, environment, strict_json

FORMULATIONS = {
    "momentum/p-rho2", "momentum/sqrt-p", "momentum/direct-gradient", "work/total-energy", "work/internal-energy",
    "work/sqrt-p", "momentum/gdsph", "work/gdsph", "momentum/pressure-energy", "work/pressure-energy", "momentum/rkgc",
    "work/rkgc", "conduction/brookshaw", "conduction/lucy-flux", "conduction/campbell-flux",
    "momentum/p-rho2-grad-h", "work/p-rho2-grad-h",
}  # fmt: skip
FIVE_THIRDS = "1.6666666666666667"
PISTON = {
    "dimension": "1", "initial_pressure": "0.5", "pressure": "1", "density": "1", "gamma": FIVE_THIRDS,
    "final_time": "0.5",
}  # fmt: skip
CASES = {  # with the parameters and defaults of the contract
    "operator/polynomial": {"degree": "0", "dimension": "1"},
    "operator/sine": {"wavenumber": "3", "phase": "0.3", "offset": "2", "dimension": "1"},
    "conduction/slab-dirichlet": {
        "dimension": "1", "turn": "0", "left": "1", "right": "2", "modes": "[[1,1],[3,0.5]]", "conductivity": "1",
        "density": "1", "final_time": "0.05",
    },
    "conduction/slab-insulated": {
        "dimension": "1", "mean": "1", "modes": "[[1,0.5]]", "conductivity": "1", "density": "1", "final_time": "0.05",
    },
    "conduction/slab-flux": {
        "dimension": "1", "flux": "1", "conductivity": "1", "density": "1", "final_time": "0.05",
    },
    "conduction/square": {
        "walls": '"dirichlet"', "left": "1", "right": "2", "modes": "[[1,1,1],[3,2,0.5]]", "conductivity": "1",
        "density": "1", "final_time": "0.05",
    },
    "conduction/cube": {
        "walls": '"dirichlet"', "left": "1", "right": "2", "modes": "[[1,1,1,1],[2,1,3,0.5]]", "conductivity": "1",
        "density": "1", "final_time": "0.05",
    },
    "conduction/half-space-step": {"dimension": "1", "wall": "1", "initial": "0", "final_time": None},
    "conduction/manufactured": {"dimension": "1"},
    "conduction/barenblatt": {"exponent": "2", "constant": "1", "start_time": "1"},
    "conduction/marshak": {"exponent": "3"},
    "hydro/uniform": {"dimension": "1", "pressure": "1", "density": "1"},
    "hydro/manufactured": {"dimension": "1"},
    "hydro/acoustic": {"amplitude": "0.0001"},
    "hydro/riemann": {"preset": '"sod"', "left": None, "right": None, "gamma": "1.4", "interface": "0.5"},
    "hydro/piston-velocity": PISTON,
    "hydro/piston-pressure": PISTON,
    "hydro/noh": {"dimension": "1", "gamma": FIVE_THIRDS, "final_time": "0.6"},
    "coupled/hot-wall": {},
    "coupled/manufactured": {},
}  # fmt: skip
IDENTIFIERS = {
    "formulations": FORMULATIONS,
    "cases": set(CASES),
    "kernels": {"cubic-spline", "quintic-spline", "wendland-c2", "wendland-c4", "wendland-c6"},
    "walls": {"mirror", "dummy"},
    "viscosities": {"monaghan", "riemann"},
    "layouts": {"lattice", "jittered"},
    "measures": {"error", "conservation", "cost", "stability", "profile", "history", "spectrum"},
}
COMMANDS = ("list", "describe", "study", "compare", "evaluate", "exact")


class Lists(ProgramTest):
    def test_every_identifier_of_the_contract_is_listed_under_its_kind(self):
        lists = strict_json(self.succeed("list", "--json"))
        for kind, identifiers in IDENTIFIERS.items():
            with self.subTest(kind=kind):
                entries = lists[kind]
                ids = [entry["id"] for entry in entries]
                self.assertTrue(identifiers <= set(ids), identifiers - set(ids))
                self.assertEqual(len(ids), len(set(ids)))
                self.assertTrue(all(entry["title"] for entry in entries))
                self.assertEqual(strict_json(self.succeed("list", kind, "--json"))[kind], entries)

    def test_every_formulation_and_case_names_its_source(self):
        lists = strict_json(self.succeed("list", "--json"))
        for kind in ("formulations", "cases"):
            for entry in lists[kind]:
                self.assertTrue(entry["source"], entry["id"])

    def test_the_plain_list_has_one_line_per_entry_with_identifier_title_and_source(self):
        lists = strict_json(self.succeed("list", "--json"))
        everything = self.succeed("list")
        for kind in IDENTIFIERS:
            lines = self.succeed("list", kind).splitlines()
            self.assertEqual(len(lines), len(lists[kind]))
            for line, entry in zip(lines, lists[kind]):
                self.assertEqual(line.split()[0], entry["id"])
                self.assertIn(entry["title"], line)
                self.assertIn(entry["source"], line)
                self.assertIn(line, everything)

    def test_no_list_has_escape_codes_off_a_terminal(self):
        self.assertNotIn("\x1b", self.succeed("list"))

    def test_start_up_takes_less_than_a_second(self):
        self.succeed("list")
        times = []
        for _ in range(11):
            start = time.perf_counter()
            self.succeed("list")
            times.append(time.perf_counter() - start)
        times.sort()
        print(f"\nsphverify list: {1e3 * times[0]:.1f} ms at best, {1e3 * times[5]:.1f} ms in the median of 11")
        self.assertLess(times[5], 1.0)


class Descriptions(ProgramTest):
    def described(self, identifier):
        return strict_json(self.succeed("describe", identifier, "--json"))

    def test_every_listed_identifier_is_described_in_text_and_json(self):
        lists = strict_json(self.succeed("list", "--json"))
        for kind in IDENTIFIERS:
            for entry in lists[kind]:
                with self.subTest(id=entry["id"]):
                    document = self.described(entry["id"])
                    self.assertEqual((document["kind"], document["id"]), (kind, entry["id"]))
                    text = self.succeed("describe", entry["id"])
                    self.assertTrue(text.startswith(entry["id"] + "\n"))
                    self.assertIn(entry["title"], text)
                    self.assertNotIn("\x1b", text)

    def test_every_formulation_states_equation_citation_fields_passes_and_conservation(self):
        for identifier in FORMULATIONS:
            with self.subTest(id=identifier):
                document = self.described(identifier)
                text = self.succeed("describe", identifier)
                for key in ("equation", "source", "fields", "passes", "parameters"):
                    self.assertTrue(document[key], key)
                self.assertIsInstance(document["conserves"], list)
                self.assertIn(document["source"], text)
                self.assertTrue(all(re.search(r" \[.*\]$", field) for field in document["fields"]), document["fields"])
        self.assertIn("flux", self.described("conduction/lucy-flux")["passes"])
        self.assertNotIn("flux", self.described("conduction/brookshaw")["passes"])
        self.assertEqual(self.described("momentum/direct-gradient")["conserves"], [])
        self.assertEqual(self.described("momentum/sqrt-p")["work_partner"], "work/sqrt-p")

    def test_the_partner_that_the_report_does_not_hold_is_said_to_be_ours(self):
        self.assertIn("ours", self.described("work/sqrt-p")["source"])

    def test_every_case_states_domain_walls_initial_state_and_reference(self):
        for identifier in CASES:
            with self.subTest(id=identifier):
                document = self.described(identifier)
                for key in ("equation", "source", "domain", "walls", "initial", "parameters"):
                    self.assertTrue(document[key], key)

    def test_every_parameter_of_the_contract_is_described_with_its_default(self):
        for identifier, parameters in CASES.items():
            lines = self.described(identifier)["parameters"]
            text = self.succeed("describe", identifier)
            for name, default in parameters.items():
                with self.subTest(id=identifier, parameter=name):
                    found = [line for line in lines if line.startswith(f"{name} [")]
                    self.assertEqual(len(found), 1, lines)
                    self.assertIn(found[0], text)
                    shown = re.fullmatch(r"\S+ \[(.*)\](?: in [^:]+)?: .+", found[0])
                    self.assertTrue(shown, found[0])
                    if default is not None:
                        self.assertEqual(strict_json(shown[1]), strict_json(default))

    def test_what_gates_and_surfaces_measure_is_described(self):
        for word, said in (("skill", "doing nothing"), ("time_error", "time_error_share"), ("surface", "h/dx of least")):
            self.assertIn(said, " ".join(self.succeed("describe", word).split()))

    def test_the_rules_of_the_verdicts_are_described(self):
        text = self.succeed("describe", "order")
        for verdict in ("asymptotic", "pre-asymptotic", "floored", "diverging", "not-refined", "95%"):
            self.assertIn(verdict, text)


class Help(ProgramTest):
    def test_the_program_s_help_lists_all_commands_with_examples(self):
        text = self.succeed("--help")
        for command in COMMANDS:
            self.assertRegex(text, rf"(?m)^\s+{command}\b")
        self.assertIn("sphverify study ", text)
        self.assertRegex(text, "(?i)exit status")

    def test_every_command_s_help_has_an_example_that_names_it(self):
        for command in COMMANDS:
            with self.subTest(command=command):
                text = self.succeed(command, "--help")
                self.assertRegex(text, rf"Example: sphverify {command}\b")

    def test_every_help_fits_into_80_columns_or_as_many_as_columns_says(self):
        text = self.succeed("--help")
        commands = re.findall(r"(?m)^  (\w+) {2,}", text.split("Subcommands:")[1])
        self.assertTrue(set(COMMANDS) < set(commands), commands)
        for columns in (80, 65, 120):
            told = environment() if columns == 80 else environment(COLUMNS=str(columns))
            widest = 0
            for arguments in (("--help",), *((command, "--help") for command in commands)):
                with self.subTest(arguments=arguments, columns=columns):
                    width = max(map(len, self.succeed(*arguments, env=told).splitlines()))
                    self.assertLessEqual(width, columns)
                    widest = max(widest, width)
            self.assertGreater(widest, 0.8 * columns)

    def test_help_says_the_same_at_any_width(self):
        for command in (*COMMANDS, "order", "gate"):
            narrow, wide = (
                self.succeed(command, "--help", env=environment(COLUMNS=columns)).replace("\\\n", "").split()
                for columns in ("50", "500")
            )
            self.assertEqual(narrow, wide, command)

    def test_examples_of_commands_that_need_no_file_work_also_where_their_line_is_broken(self):
        for command in ("list", "describe", "exact"):
            with self.subTest(command=command):
                example = re.search(r"Example: sphverify ((?:.*\\\n)*.*)", self.succeed(command, "--help"))[1]
                self.assertTrue(self.succeed(*example.replace("\\\n", "").split()))

    def test_version_begins_with_one_line_with_the_version(self):
        text = self.succeed("--version")
        self.assertRegex(text, r"\Asphverify \d+\.\d+\.\d+ \(\S+\)\n")


if __name__ == "__main__":
    unittest.main(verbosity=2)
