# SPDX-License-Identifier: GPL-3.0-or-later
"""The site that tools/docs builds, where mkdocs is installed."""

import os
import re
import shutil
import subprocess
import unittest

from program import PROGRAM, PROGRAM_ERROR, SCHEMAS, SOURCE_DIR, ProgramTest, strict_json


@unittest.skipUnless(shutil.which("mkdocs"), "mkdocs is not installed: tools/docs-packages.txt")
class Site(ProgramTest):
    def build(self, source):
        return subprocess.run([source / "tools/docs", self.folder / "site"], env=os.environ | {"SPHVERIFY": PROGRAM},
                              capture_output=True, text=True)

    def text_of(self, page):
        return (self.folder / "site" / page).read_text()

    def test_it_is_whole_and_needs_no_network(self):
        built = self.build(SOURCE_DIR)
        self.assertEqual(built.returncode, 0, built.stderr)
        self.assertEqual(built.stderr, "")
        there = strict_json(self.succeed("list", "--json"))
        pages = {"formulations": "formulations", "cases": "cases", "measures": "measures"}
        for kind, entries in there.items():
            text = self.text_of(f"reference/{pages.get(kind, 'choices')}.html") if kind != "schema" else ""
            for entry in entries if text else []:
                self.assertIn(f">{entry['id']}</h2>", text)
        for name, schema in SCHEMAS.items():
            text = self.text_of(f"reference/{name}.html")
            for key in keys_of(schema):
                self.assertRegex(text, rf"<code>[^<]*\b{re.escape(key)}</code>", f"{name}: {key}")
        help_text = self.succeed("--help")
        for command in re.findall(r"^  ([\w-]+)", help_text.split("Subcommands:\n")[1].split("\n\n")[0], re.MULTILINE):
            self.assertIn(f'<h2 id="{command}">', self.text_of("reference/commands.html"))
        for page in (self.folder / "site").rglob("*.html"):
            fetched = re.findall(r'<(?:script|img|iframe)[^>]+src="(https?:[^"]*)|<link[^>]+href="(https?:[^"]*)', page.read_text())
            self.assertEqual(fetched, [], page)
        # Rows of tables that stay text are tables that were not understood.
        for page in (self.folder / "site").glob("*.html"):
            self.assertNotRegex(page.read_text(), r"<p>\|", page)

    def test_a_dead_link_stops_it(self):
        source = self.folder / "source"
        for name in ("docs", "tools", "examples", "include", "reports/schema"):
            shutil.copytree(SOURCE_DIR / name, source / name)
        for name in ("CONTRIBUTING.md", "LICENSE", "README.md"):
            shutil.copy(SOURCE_DIR / name, source)
        with open(source / "docs/start.md", "a") as page:
            page.write("\n[gone](gone.md)\n")
        built = self.build(source)
        self.assertNotEqual(built.returncode, 0)
        self.assertIn("docs/start.md: links to gone.md, which is not there", built.stderr)

    def test_what_is_no_site_is_not_written_over(self):
        (self.folder / "site").mkdir()
        (self.folder / "site/mine.txt").write_text("mine")
        built = self.build(SOURCE_DIR)
        self.assertEqual(built.returncode, PROGRAM_ERROR)
        self.assertIn("found other files", built.stderr)
        self.assertEqual((self.folder / "site/mine.txt").read_text(), "mine")


def keys_of(schema):
    """Every key that a schema names, wherever."""
    if isinstance(schema, dict):
        for key, value in schema.items():
            if key == "properties":
                yield from value
            if key not in ("if", "not", "allOf", "anyOf"):
                yield from keys_of(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from keys_of(value)


if __name__ == "__main__":
    unittest.main()
