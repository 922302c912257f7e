# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of docs/ as mkdocs takes them: links that leave docs/ lead to copies of what they name, as pages."""
import os
import pathlib
import re
import subprocess

FENCE = re.compile(r"^\s*(```|~~~)")
LINK = re.compile(r"(\]\()([^)\s#]+)(#[^)\s]*)?(\))")
LANGUAGES = {".py": "python", ".json": "json", ".c": "c", ".h": "c", ".hpp": "cpp", ".sh": "sh", ".yml": "yaml"}


def with_deep_items(text: str) -> str:
    """What belongs to an item of a list behind an empty line stands 2 or 3 columns in, which mkdocs wants to be 4."""
    lines = []
    in_item = behind_gap = deep = False
    for line in text.split("\n"):
        if not line.strip():
            behind_gap, deep = True, False
        else:
            if re.match(r"([-*]|\d+\.) ", line):
                in_item, deep = True, False
            elif re.match(r" {2,3}\S", line):
                deep = deep or (in_item and behind_gap)
            elif behind_gap:
                in_item = False
            if deep:
                line = "    " + line.lstrip()
            behind_gap = False
        lines.append(line)
    return "\n".join(lines)


def tracked(source: pathlib.Path) -> list[str]:
    """What git knows or would add; of an archive without git all that is there."""
    listed = subprocess.run(["git", "-C", source, "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True)
    names = listed.stdout.split("\n")
    if "README.md" in names:
        return [name for name in names if name and (source / name).is_file()]
    return sorted(str(path.relative_to(source)) for path in source.rglob("*")
                  if path.is_file() and not {"build", "node_modules", "__pycache__"} & set(path.parts))


class Pages:
    def __init__(self, source: pathlib.Path, folder: pathlib.Path):
        self.source, self.folder = source, folder
        self.tracked = tracked(source)
        self.written = set()

    def write_all(self) -> None:
        for name in self.tracked:
            if name.startswith("docs/"):
                self.write(name)

    def place_of(self, name: str) -> str:
        """Where a file or folder of the repository stands among the pages."""
        if name.startswith("docs/"):
            return name.removeprefix("docs/")
        return f"sources/{name}" + ("" if name.endswith(".md") else ".md")

    def write(self, name: str) -> None:
        if name in self.written:
            return
        self.written.add(name)
        path, target = self.source / name, self.folder / self.place_of(name)
        target.parent.mkdir(parents=True, exist_ok=True)
        if name.endswith(".md"):
            target.write_text(with_deep_items(self.with_links(path.read_text(), name)))
        elif name.startswith("docs/"):
            target.write_bytes(path.read_bytes())
        elif path.is_dir():
            files = [one for one in self.tracked if one.startswith(name + "/")]
            links = "".join(f"- [{one.removeprefix(name + '/')}](/{one})\n" for one in files)
            target.write_text(self.with_links(f"# {name}\n\n{links}", name + "/."))
        else:
            language = LANGUAGES.get(path.suffix, "")
            target.write_text(f"# {name}\n\n````{language}\n{path.read_text()}\n````\n")

    def with_links(self, text: str, name: str) -> str:
        fenced = False
        lines = []
        for line in text.split("\n"):
            if FENCE.match(line):
                fenced = not fenced
            lines.append(line if fenced else LINK.sub(lambda match: self.link(match, name), line))
        return "\n".join(lines)

    def link(self, match: re.Match, name: str) -> str:
        address = match[2]
        if re.match(r"\w+:", address):
            return match[0]
        folder = name.removesuffix("/.") if name.endswith("/.") else os.path.dirname(name)
        meant = os.path.normpath(address[1:] if address.startswith("/") else os.path.join(folder, address))
        if not (self.source / meant).exists():
            raise SystemExit(f"tools/docs: {name}: links to {address}, which is not there")
        if not meant.startswith("docs/"):
            self.write(meant)
        from_folder = os.path.dirname(self.place_of(name.removesuffix("/.")))
        return match[1] + os.path.relpath(self.place_of(meant), from_folder or ".") + (match[3] or "") + match[4]
