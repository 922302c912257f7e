# SPDX-License-Identifier: GPL-3.0-or-later
"""The documents as text: links, lengths, navigation, and that what they name is there."""

import functools
import os
import pathlib
import re
import subprocess
import unicodedata
import unittest

PROGRAM = os.environ["SPHVERIFY"]
SOURCE = pathlib.Path(os.environ["SPHVERIFY_SOURCE_DIR"]).resolve()

LONGEST_PAGE, LONGEST_README, WIDEST_LINE = 250, 120, 120
LINK = re.compile(r"(!?)\[[^\]]*\]\(([^)\s]*)\)")
LOGS = {"CHANGELOG.md"}  # grows without end, and is no page


@functools.cache
def tracked():
    """What git knows or would add; without git (a released archive, wherever it lies) all that is there."""
    listed = subprocess.run(["git", "-C", SOURCE, "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True)
    names = listed.stdout.split("\n")
    if "README.md" in names:
        return [name for name in names if name and (SOURCE / name).is_file()]
    return [str(path.relative_to(SOURCE)) for path in SOURCE.rglob("*")
            if path.is_file() and not {"node_modules", "build"} & set(path.parts)]


def documents():
    return [name for name in tracked() if name.endswith(".md")]


@functools.cache
def text_of(name):
    return (SOURCE / name).read_text()


def split_code(text):
    """Lines with their numbers, and whether each stands in a block of code."""
    fence = None
    behind_gap, in_code = True, False
    for number, line in enumerate(text.split("\n"), 1):
        if match := re.match(r"\s*(```+|~~~+)", line):
            fence = None if fence and line.strip().startswith(fence) else fence or match[1]
            yield number, line, True
            continue
        in_code = not fence and line.startswith("    ") and (behind_gap or in_code)
        yield number, line, bool(fence) or in_code
        behind_gap = not line.strip()


def prose(text):
    """Without blocks and spans of code."""
    return re.sub(r"`[^`\n]*`", "", "\n".join("" if code else line for _, line, code in split_code(text)))


def blocks(text):
    """Blocks of code, fenced or indented."""
    found, last = [], None
    for number, line, code in split_code(text):
        if code:
            found = found + [line] if last != number - 1 else found[:-1] + [found[-1] + "\n" + line]
            last = number
    return found


def anchors(text):
    """Those that headings get where the repository is read, and those of the site."""
    found = []
    for _, line, code in split_code(text):
        if not code and (match := re.match(r"#{1,6} +(.*)", line)):
            words = re.sub(r"[`*]|\]\([^)]*\)|\[", "", match[1]).strip()
            here = re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")
            ascii_words = unicodedata.normalize("NFKD", words).encode("ascii", "ignore").decode()
            site = re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", ascii_words).strip().lower())
            found.append((here, site))
    return {here for here, site in found if here == site}


def dead_links(name, text):
    for _, address in LINK.findall(prose(text)):
        if re.match(r"\w+:", address):
            continue
        path, _, anchor = address.partition("#")
        target = os.path.normpath(os.path.join(os.path.dirname(name), path)) if path else name
        if target != name and not (SOURCE / target).exists():
            yield f"{name}: link to {address}: there is no {target}"
        elif anchor and target.endswith(".md") and anchor not in anchors(text if target == name else text_of(target)):
            yield f"{name}: link to {address}: {target} has no such heading, or the site writes its anchor otherwise"


def dead_mentions(name, text):
    """Of docs/NAME in any text, also in what the program prints; docs/decisions/0009 is enough for a decision."""
    for mention in re.findall(r"(?<![\w/.-])docs/(?:[\w-]+/)*[\w-]+(?:\.\w+)?", text):
        if not (SOURCE / mention).exists() and not list(SOURCE.glob(mention + "-*.md")):
            yield f"{name}: names {mention}, which is not there"


def too_long(name, text):
    most = LONGEST_README if name == "README.md" else LONGEST_PAGE
    if (lines := text.count("\n")) > most:
        yield f"{name}: {lines} lines, at most {most}: split it by subject"


def too_wide(name, text):
    for number, line, code in split_code(text):
        if len(line) > WIDEST_LINE and not code and not line.startswith(("|", "   |")) and not LINK.search(line):
            yield f"{name}:{number}: {len(line)} columns, at most {WIDEST_LINE}: tools/wrap-docs {name}"


def missing_studies(name, text):
    for block in blocks(text):
        for study in re.findall(r"(?<![\w/-])(?:cases/studies|tests/gates|examples)/[\w./-]*\.json", block):
            if not (SOURCE / study).exists():
                yield f"{name}: a block of commands names {study}, which is not there"


def not_in_navigation(pages, navigation):
    listed = set(re.findall(r"([\w/-]+\.md)\s*$", navigation, re.MULTILINE))
    for page in pages:
        if page.startswith("docs/decisions/"):
            continue  # a series, which tools/docs adds
        if page.removeprefix("docs/") not in listed:
            yield f"{page} is not in the navigation: add it under `nav` in tools/docs_site/mkdocs.yml, where a reader looks for it"
    for page in listed - {page.removeprefix("docs/") for page in pages}:
        yield f"tools/docs_site/mkdocs.yml: `nav` names {page}, and there is no docs/{page}"


def unnamed_commands(commands, start):
    named = set(re.findall(r"^\| `([\w-]+)` \|", start, re.MULTILINE))
    for command in commands:
        if command not in named:
            yield f"docs/start.md: its table of commands has no line for `{command}`"
    for command in named - set(commands):
        yield f"docs/start.md: its table has `{command}`, which `sphverify --help` has not"


class Docs(unittest.TestCase):
    def none(self, complaints):
        found = list(complaints)
        self.assertEqual(found, [], "\n" + "\n".join(found))

    def pages(self):
        return [name for name in documents() if name not in LOGS]

    def test_links_and_anchors_lead_somewhere(self):
        self.none(one for name in documents() for one in dead_links(name, text_of(name)))

    def test_documents_that_sources_and_messages_name_are_there(self):
        texts = [name for name in tracked() if name.endswith((".hpp", ".cpp", ".h", ".py", ".json", ".js", ".cmake", ".txt"))
                 or name.startswith("tools/") and "." not in name]
        self.none(one for name in texts + self.pages() if name != "tests/cli/test_docs.py"
                  for one in dead_mentions(name, text_of(name)))

    def test_no_page_is_long(self):
        self.none(one for name in self.pages() for one in too_long(name, text_of(name)))

    def test_lines_are_wrapped(self):
        self.none(one for name in self.pages() for one in too_wide(name, text_of(name)))

    def test_studies_that_commands_name_are_there(self):
        self.none(one for name in self.pages() for one in missing_studies(name, text_of(name)))

    def test_every_page_is_in_the_navigation(self):
        self.none(not_in_navigation([name for name in documents() if name.startswith("docs/")],
                                    text_of("tools/docs_site/mkdocs.yml")))

    def test_every_command_is_in_start(self):
        overview = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=True).stdout
        commands = re.findall(r"^  ([\w-]+)", overview.split("Subcommands:\n")[1].split("\n\n")[0], re.MULTILINE)
        self.assertIn("study", commands)
        self.none(unnamed_commands(commands, text_of("docs/start.md")))


class TheseChecksCanFail(unittest.TestCase):
    def test_each_finds_what_is_wrong(self):
        wide = "word " * 30
        cases = {
            "file": dead_links("docs/a.md", "see [it](nowhere.md)"),
            "anchor": dead_links("docs/a.md", "# One\n\nsee [it](#two)"),
            "anchor elsewhere": dead_links("docs/a.md", "see [it](measures.md#no-such-heading)"),
            "mention": dead_mentions("a.cpp", "// docs/nowhere.md"),
            "decision": dead_mentions("a.cpp", "// docs/decisions/9999"),
            "page": too_long("docs/a.md", "\n" * 251),
            "readme": too_long("README.md", "\n" * 121),
            "line": too_wide("docs/a.md", wide),
            "study": missing_studies("docs/a.md", "```sh\nsphverify study cases/studies/none.json\n```"),
            "indented study": missing_studies("docs/a.md", "so:\n\n    sphverify study cases/studies/none.json\n"),
            "page not listed": not_in_navigation(["docs/a.md"], "nav:\n"),
            "page not there": not_in_navigation([], "nav:\n  - A: a.md\n"),
            "command": unnamed_commands(["study"], "| `list` | |"),
        }
        for name, complaints in cases.items():
            with self.subTest(name):
                self.assertTrue(list(complaints))

    def test_and_pass_what_is_right(self):
        wide = "word " * 30
        for complaints in (dead_links("docs/a.md", "# One\n\n[it](#one), [page](measures.md#norms-and-regions), `[no](link.md)`"),
                           dead_links("docs/a.md", "```\n[no](link.md)\n```"), dead_mentions("a.cpp", "docs/decisions/0009"),
                           too_long("docs/a.md", "\n" * 250), too_wide("docs/a.md", f"| {wide} |\n\n    {wide}\n```\n{wide}\n```\n"),
                           missing_studies("docs/a.md", "```\nsphverify study cases/studies/heat-1d.json\n```"),
                           unnamed_commands(["study"], "| `study` | |")):
            self.assertEqual(list(complaints), [])


if __name__ == "__main__":
    unittest.main()
