# SPDX-License-Identifier: GPL-3.0-or-later
"""A source as the compiler's library sees it: its tree, and whether a changed text still compiles."""

import json
import pathlib
import re
import shlex

from clang import cindex

WANTED = cindex.TranslationUnit.PARSE_PRECOMPILED_PREAMBLE | 0x100  # made at the first parse
# What every broken text asks is there from the beginning, so that its includes are read once. Mutants make constants
# variable: what narrows then did so before. An array must not become one of variable length.
ANYHOW = ["-include", str(pathlib.Path(__file__).resolve().parent / "mutants.hpp"), "-w", "-Wno-c++11-narrowing",
          "-Werror=vla", "-ferror-limit=0", "-fno-caret-diagnostics"]
LIBRARY = "/usr/lib/llvm-14/lib/libclang-14.so.1"
GCC_ONLY = ("-fpch-preprocess", "-Winvalid-pch", "-Wno-psabi")


def load_library():
    if not cindex.Config.loaded and pathlib.Path(LIBRARY).exists():
        cindex.Config.set_library_file(LIBRARY)


class Commands:
    """How each source of a configured build is compiled."""

    def __init__(self, build):
        self.by_file = {}
        for entry in json.loads((build / "compile_commands.json").read_text()):
            self.by_file[pathlib.Path(entry["file"])] = entry
        self.headers = build / "mutation-headers"

    def arguments(self, source):
        words = shlex.split(self.by_file[source]["command"])
        while pathlib.Path(words[0]).name == "ccache":
            words.pop(0)
        words = [w for w in words[1:words.index("-o")] if w not in GCC_ONLY]
        return [self.plain(w) if w.endswith("cmake_pch.hxx") else w for w in words] + ANYHOW

    def plain(self, header):
        """The same header where no precompiled one of another compiler lies beside it."""
        self.headers.mkdir(exist_ok=True)
        copy = self.headers / (pathlib.Path(header).parent.name + ".hpp")
        text = pathlib.Path(header).read_text()
        if not copy.exists() or copy.read_text() != text:
            copy.write_text(text)
        return str(copy)


class Unit:
    """One file, through the source that compiles it: itself, or one that includes it."""

    def __init__(self, file, source, arguments):
        load_library()
        self.file = str(file)
        self.unit = cindex.Index.create().parse(str(source), args=arguments, options=WANTED)
        self.errors = self.count()

    def count(self):
        return sum(d.severity >= cindex.Diagnostic.Error for d in self.unit.diagnostics)

    def compiles(self, text):
        try:
            self.unit.reparse(unsaved_files=[(self.file, text)])
        except cindex.TranslationUnitLoadError:
            return False
        return self.count() <= self.errors


def includers(root, folders):
    """File -> the files that include it, of all below these folders."""
    found = {}
    for folder in folders:
        for path in sorted((root / folder).rglob("*.?pp")):
            for name in re.findall(r'^#include "([^"]+)"', path.read_text(), re.M):
                found.setdefault(root / name, []).append(path)
    return found


def source_of(path, including, commands):
    """The source through which a file is read: itself, or the nearest that includes it."""
    seen, ring = {path}, [path]
    while ring:
        sources = [p for p in ring if p in commands.by_file]
        if sources:
            # The product's own first, then the shortest.
            return min(sources, key=lambda p: ("/tests/" in str(p), p.stat().st_size, str(p)))
        ring = sorted({q for p in ring for q in including.get(p, ())} - seen)
        seen.update(ring)
    return None
