# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a large JSON object piece by piece: of some of its keys every element alone, so that it is never there at once."""

import json
import re

from .errors import Error

CHUNK = 1 << 22  # characters
NEAR_THE_END = 16  # what is cut may be a number or a word
SPACE = re.compile(r"[ \t\r\n]*")


def _refuse(constant):
    raise ValueError(f"found {constant}, which is not JSON")


_decoder = json.JSONDecoder(parse_constant=_refuse)


class _Text:
    """A window on the file's text, which starts at the line `line`."""

    def __init__(self, file, name):
        self.file, self.name = file, name
        self.text, self.at, self.line, self.column = "", 0, 1, 1
        self.ended = False
        self.more()

    def more(self):
        """Reads on; each time twice as much, if nothing of it could be used."""
        read, self.at = self.at, 0
        lines = self.text.count("\n", 0, read)
        self.column = read - self.text.rfind("\n", 0, read) if lines else self.column + read
        self.line += lines
        rest = self.text[read:]
        chunk = self.file.read(max(CHUNK, len(rest)))
        self.ended = not chunk
        self.text = rest + chunk

    def fail(self, what, at=None):
        at = self.at if at is None else at
        lines = self.text.count("\n", 0, at)
        column = at - self.text.rfind("\n", 0, at) if lines else self.column + at
        raise Error(f"{self.name}: line {self.line + lines}, column {column}: {what}") from None

    def next(self):
        """The next character that is no space, which stays; empty at the end."""
        while True:
            self.at = SPACE.match(self.text, self.at).end()
            if self.at < len(self.text):
                return self.text[self.at]
            if self.ended:
                return ""
            self.more()

    def take(self, *expected):
        found = self.next()
        if found not in expected or not found:
            wanted = " or ".join(repr(character) for character in expected)
            self.fail(f"found {repr(found) if found else 'the end of the file'}, expected {wanted}")
        self.at += 1
        return found

    def key(self):
        self.take('"')
        self.at -= 1
        return self.value()

    def value(self):
        self.next()
        while True:
            try:
                value, end = _decoder.raw_decode(self.text, self.at)
            except json.JSONDecodeError as error:
                is_cut = error.pos > len(self.text) - NEAR_THE_END or error.msg.startswith("Unterminated string")
                if not is_cut:
                    self.fail(f"not JSON: {error.msg[0].lower()}{error.msg[1:]}", error.pos)
                if self.ended:
                    self.fail("not JSON: the file ends within a value", len(self.text))
            except (ValueError, RecursionError) as error:
                self.fail(f"not JSON: {error}")
            else:
                if end < len(self.text) or self.ended:  # a number may go on
                    self.at = end
                    return value
            self.more()


def pieces(path, one_by_one):
    """Every (key, index, value) of the object in a file. Of the keys of `one_by_one` every element of their list has a
    piece; of any other key the whole value, with the index None."""
    try:
        with open(path, encoding="utf-8") as file:
            text = _Text(file, path)
            text.take("{")
            seen = set()
            ended = text.next() == "}" and text.take("}")
            while not ended:
                key = text.key()
                if key in seen:
                    text.fail(f"found the key '{key}' twice")
                seen.add(key)
                text.take(":")
                if key in one_by_one:
                    yield from _elements(text, key)
                else:
                    yield key, None, text.value()
                ended = text.take(",", "}") == "}"
            if text.next():
                text.fail("found more text, expected the end of the file")
    except UnicodeDecodeError:
        raise Error(f"{path}: found bytes that are not UTF-8") from None
    except OSError as error:
        raise Error(f"{path}: {error.strerror}") from None


def _elements(text, key):
    text.take("[")
    index = 0
    if text.next() == "]":
        text.take("]")
        return
    while True:
        yield key, index, text.value()
        index += 1
        if text.take(",", "]") == "]":
            return
