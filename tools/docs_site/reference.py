# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference, from what the program and the schemas say of themselves: Markdown in a folder of the build."""
import json
import pathlib
import re
import subprocess
import textwrap

from docs_site.schema_tables import page_of_schema

# Title of the page, and the kinds of `sphverify list` that stand on it.
PARTS = {"formulations": ("Formulations", ["formulations"]), "cases": ("Cases", ["cases"]),
         "choices": ("Kernels, walls, viscosities, layouts", ["kernels", "walls", "viscosities", "layouts"]),
         "measures": ("Measures", ["measures"])}
# Keys of a description, in the order in which they are shown; what is not named here follows.
KEYS = ["equation", "source", "computes", "domain", "walls", "initial", "support", "work_partner", "reads", "fields",
        "wall_values", "passes", "conserves"]


def output_of(program: str, *arguments: str) -> str:
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def cell(text: str) -> str:
    return re.sub(r"\s*\n\s*", "<br>", text.replace("<", "&lt;").replace("|", "&#124;").replace("*", "&#42;")
                  .replace("_", "&#95;").replace("[", "&#91;"))


def description(entry: dict) -> str:
    text = f"## {entry['id']}\n\n{entry['title']}.\n"
    keys = KEYS + [key for key in entry if key not in [*KEYS, "schema", "kind", "id", "title", "parameters", "remarks",
                                                       "rules"]]
    rows = []
    for key in keys:
        if not (value := entry.get(key)):
            continue
        if key == "equation":
            text += "\n" + "".join(textwrap.fill(line, 105, initial_indent="    ", subsequent_indent="        ",
                                                 break_long_words=False, break_on_hyphens=False) + "\n"
                                   for line in value.split("\n"))
        elif key == "work_partner":
            rows.append(f"| work partner | [{value}](#{anchor(value)}) |")
        else:
            rows.append(f"| {key.replace('_', ' ')} | {cell(value if isinstance(value, str) else ', '.join(value))} |")
    if rows:
        text += "\n| | |\n|---|---|\n" + "\n".join(rows) + "\n"
    if entry.get("parameters"):
        text += "\n| parameter | default | meaning |\n|---|---|---|\n"
        text += "".join(parameter_row(line) for line in entry["parameters"])
    remarks = entry.get("remarks") or ""
    for remark in [remarks] if isinstance(remarks, str) else remarks:
        text += f"\n{cell(remark)}\n" if remark else ""
    if entry.get("rules"):
        text += f"\n```\n{entry['rules']}\n```\n"
    return text


def parameter_row(line: str) -> str:
    """Of "NAME [default] in UNIT: meaning"."""
    if match := re.match(r"(\S+) \[(.*?)\](?: in ([^:]*))?: (.*)", line, re.DOTALL):
        name, default, unit, meaning = match.groups()
        return f"| `{name}` | {cell(default)}{' ' + cell(unit) if unit else ''} | {cell(meaning)} |\n"
    name, _, meaning = line.partition(":")
    return f"| {cell(name)} | | {cell(meaning.strip())} |\n"


def anchor(identifier: str) -> str:
    return re.sub(r"[^\w -]", "", identifier).lower()


def pages_of_parts(program: str) -> dict[str, str]:
    there = json.loads(output_of(program, "list", "--json"))
    pages = {}
    for name, (title, kinds) in PARTS.items():
        text = f"# {title}\n\nWhat `sphverify list` and `sphverify describe` print.\n"
        for kind in kinds:
            if len(kinds) > 1:
                text += f"\n**{kind.capitalize()}**\n"
            text += "\n| identifier | what |\n|---|---|\n"
            text += "".join(f"| [{one['id']}](#{anchor(one['id'])}) | {cell(one['title'])} |\n" for one in there[kind])
        for kind in kinds:
            for one in there[kind]:
                entry = json.loads(output_of(program, "describe", one["id"], "--json"))
                if entry["kind"] == kind:
                    text += "\n" + description(entry)
        pages[f"{name}.md"] = text
    unknown = set(there) - {"schema"} - {kind for _, kinds in PARTS.values() for kind in kinds}
    if unknown:
        raise SystemExit(f"tools/docs: `sphverify list` has {', '.join(sorted(unknown))}: say in tools/docs_site/reference.py, "
                         "PARTS, on which page they stand")
    return pages


def subcommands(program: str) -> list[str]:
    listed = output_of(program, "--help").split("Subcommands:\n")[1].split("\n\n")[0]
    return re.findall(r"^  (\S+)", listed, re.MULTILINE)


def page_of_commands(program: str) -> str:
    text = f"# Commands\n\n```\n{output_of(program, '--help')}```\n"
    for name in subcommands(program):
        text += f"\n## {name}\n\n```\n{output_of(program, name, '--help')}```\n"
    return text


def write_reference(program: str, source: pathlib.Path, folder: pathlib.Path) -> list[dict[str, str]]:
    """Writes the pages, and gives their entries of the navigation."""
    folder.mkdir(parents=True)
    pages = {"commands.md": page_of_commands(program), **pages_of_parts(program)}
    schemas = {path.name: json.loads(path.read_text()) for path in sorted((source / "reports/schema").glob("*.json"))}
    for name, schema in schemas.items():
        pages[name.removesuffix(".schema.json") + ".md"] = page_of_schema(schema)
    for name, text in pages.items():
        (folder / name).write_text(text)
    return [{re.match("# (.*)", text)[1]: f"reference/{name}"} for name, text in pages.items()]
