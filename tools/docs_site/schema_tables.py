# SPDX-License-Identifier: GPL-3.0-or-later
"""A JSON schema as tables: a row for each key with its type and explanation, a table for each named definition."""
import json
import re


def plain(text: str) -> str:
    """Markdown of a description: code spans stay, what would be markup does not."""
    parts = re.split(r"(`[^`]*`)", text.replace("|", "&#124;"))
    return "".join(part if place % 2 else part.replace("<", "&lt;").replace("*", "&#42;").replace("_", "&#95;")
                   for place, part in enumerate(parts))


def alternatives(schema: dict) -> list[dict]:
    return schema.get("oneOf") or schema.get("anyOf") or []


def definition(schema: dict, root: dict) -> tuple[str, dict] | None:
    if not schema.get("$ref", "").startswith("#/"):
        return None
    meant = root
    for step in schema["$ref"][2:].split("/"):
        meant = meant[step]
    return schema["$ref"].removeprefix("#/$defs/"), meant


def holds_objects(schema: dict) -> bool:
    return "properties" in schema or any(holds_objects(one) for one in alternatives(schema))


def named_values(schema: dict) -> list[dict]:
    """What keys that the document chooses hold."""
    more = schema.get("additionalProperties")
    return [*schema.get("patternProperties", {}).values(), *([more] if isinstance(more, dict) else [])]


def link(reference: str) -> str:
    document, _, place = reference.partition("#")
    name = document.removesuffix(".schema.json")
    words = place.split("/")[2:3]
    return f"[{words[0] if words else name}]({name}.md{'#' + words[0].replace('_', '-') if words else ''})"


def limits(schema: dict) -> str:
    low, high = schema.get("minimum"), schema.get("maximum")
    text = []
    if low is not None and high is not None:
        text.append(f"{low} to {high}")
    elif low is not None or high is not None:
        text.append(f"{low} or more" if low is not None else f"up to {high}")
    if "exclusiveMinimum" in schema:
        text.append(f"above {schema['exclusiveMinimum']}" + (f", up to {high}" if high is not None else ""))
        text = text[-1:]
    return f" ({text[0]})" if text else ""


def type_of(schema: dict, root: dict) -> str:
    if found := definition(schema, root):
        name, meant = found
        return f"[{name}](#{name.replace('_', '-')})" if holds_objects(meant) and "/" not in name else type_of(meant, root)
    if "$ref" in schema:
        return link(schema["$ref"])
    if "const" in schema:
        return f"`{json.dumps(schema['const'])}`"
    if "enum" in schema:
        return ", ".join(f"`{one if isinstance(one, str) else json.dumps(one)}`" for one in schema["enum"])
    if choices := alternatives(schema):
        if "type" in schema and not any(key in one for one in choices for key in ("type", "$ref", "enum", "const", "oneOf")):
            return schema["type"]  # conditions on which keys stand together
        return choice([one for one in choices if one.get("type") != "null"], root) + (
            " or null" if any(one.get("type") == "null" for one in choices) else "")
    if "allOf" in schema and "type" not in schema:
        return type_of(schema["allOf"][0], root)
    kinds = schema.get("type", "any")
    kinds = kinds if isinstance(kinds, list) else [kinds]
    return " or ".join(one_type(kind, schema, root) for kind in kinds)


def choice(choices: list[dict], root: dict) -> str:
    if len(choices) == 2 and choices[1].get("type") == "array" and choices[1].get("items") == choices[0]:
        return type_of(choices[0], root) + "; or a list of such"
    return " or ".join(dict.fromkeys(type_of(one, root) for one in choices))


def one_type(kind: str, schema: dict, root: dict) -> str:
    if kind == "array":
        return "list of " + type_of(schema["items"], root) if "items" in schema else "list"
    if kind == "object" and "properties" not in schema and (named := named_values(schema)):
        return "object, by name: " + choice(named, root)
    return kind + (limits(schema) if kind in ("number", "integer") else "")


def inner_objects(schema: dict, key: str) -> list[tuple[str, dict]]:
    """Objects that are written out where they stand, with the path of keys that leads to them."""
    if "properties" in schema:
        return [(key, schema)]
    found = [inner for one in alternatives(schema) for inner in inner_objects(one, key)]
    if isinstance(schema.get("items"), dict):
        found += inner_objects(schema["items"], key + "[]")
    for named in named_values(schema):
        found += inner_objects(named, key + ".NAME")
    # Of a list of what may also stand alone, once.
    return [one for place, one in enumerate(found) if all(one[1] != other[1] for other in found[:place])]


def rows(schema: dict, root: dict, prefix: str = "") -> list[str]:
    required = schema.get("required", [])
    text = []
    for key, value in schema["properties"].items():
        meant = definition(value, root)
        says = value.get("description") or (meant[1].get("description", "") if meant else "")
        if "default" in value:
            says += f" Default: `{json.dumps(value['default'])}`."
        text.append(f"| `{prefix}{key}` | {'yes' if key in required else ''} | {type_of(value, root)} | {plain(says)} |")
        for path, inner in inner_objects(value, key):
            text += rows(inner, root, f"{prefix}{path}.")
    return text


def tables(schema: dict, root: dict) -> str:
    text = ""
    for path, found in inner_objects(schema, ""):
        says = found.get("description", "")
        if found is not schema and says:
            text += f"\n{plain(says)}\n"
        text += "\n| key | needed | type | what |\n|---|---|---|---|\n" + "\n".join(rows(found, root, f"{path}." if path else ""))
        text += "\n"
    return text


def page_of_schema(schema: dict) -> str:
    name = schema["$id"].rsplit("/", 1)[1].removesuffix(".schema.json")
    text = f"# {name}\n\n{schema['title']}. {plain(schema['description'])}\n" + tables(schema, schema)
    for word, meant in schema.get("$defs", {}).items():
        if holds_objects(meant):
            text += f"\n## {word.replace('_', '-')}\n\n{plain(meant.get('description', ''))}\n" + tables(meant, schema)
    return text
