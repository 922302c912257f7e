# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/verify-your-code.md as a reader follows it: its commands, in their order, and what it says that they show."""

import os
import re
import subprocess
import unittest

from program import PROGRAM, SOURCE_DIR, ProgramTest, strict_json

PAGE = (SOURCE_DIR / "docs/verify-your-code.md").read_text()


def blocks(language):
    fenced = re.findall(r"^```(\w*)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    return [text for name, text in fenced if name == language]


class Tutorial(ProgramTest):
    def test_its_documents_are_those_of_the_example(self):
        for name, text in zip(("study", "gates", "snapshots"), blocks("json"), strict=True):
            example = (SOURCE_DIR / "examples/codes/first" / f"{name}.json").read_text()
            self.assertEqual(strict_json(text), strict_json(example), name)

    def test_its_commands_show_what_it_says(self):
        commands = blocks("sh")
        self.assertEqual(len(commands), 5, "copy, study, break, gate, by hand")
        home = self.folder / "home"
        (home / "bin").mkdir(parents=True)
        (home / "bin/sphverify").symlink_to(PROGRAM)
        environment = os.environ | {"HOME": str(home), "PATH": f"{home / 'bin'}:{os.environ['PATH']}"}
        script = f"set -eu\ncd '{SOURCE_DIR}'\n" + "\n".join(f"echo '## {place}'\n{text}" for place, text in enumerate(commands))
        done = subprocess.run(["sh", "-c", script], env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        shown = dict(enumerate(re.split(r"^## \d\n", done.stdout, flags=re.MULTILINE)[1:]))
        for quoted in blocks(""):
            self.assertIn(quoted, shown[1])
        changes = re.findall(r"^worse +error .* x([\d.]+) .*\n.*first lattice, h/dx 1.2( \(N/16\)\^0.5)?$", shown[2], re.MULTILINE)
        self.assertEqual([bool(grows) for _, grows in changes], [True, False])
        self.assertAlmostEqual(float(changes[0][0]), 45, delta=1)
        self.assertAlmostEqual(float(changes[1][0]), 2, delta=0.2)
        self.assertIn("3 gates: 3 passed", shown[3])
        self.assertIn("3 gates: 1 passed, 2 failed", shown[3])
        self.assertIn("the mistake is caught", shown[3])
        self.assertRegex(shown[4], r"by-hand +by-hand +2\.5e-3")


if __name__ == "__main__":
    unittest.main()
