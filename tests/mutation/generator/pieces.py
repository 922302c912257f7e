# SPDX-License-Identifier: GPL-3.0-or-later
"""A mutant as an edit of a source, and a source with many of them at once.

An edit replaces the text from `start` to `end`. What comes in its place is a list of pieces: text, or a pair (start, end) that
stands for that part of the source, with whatever other mutants lie in it. ON stands for the question whether the mutant runs.
"""

import dataclasses

ON = "\0"


@dataclasses.dataclass
class Mutant:
    file: str
    start: int
    end: int
    rule: str
    says: str  # what the slip was, in code
    pieces: list  # both versions, chosen by ON
    mutated: list  # the broken version alone
    constant: bool = False  # lies where the compiler may evaluate it
    number: int = 0
    line: int = 0
    room: str = ""

    @property
    def name(self):
        return f"{self.number}"


def choice(mutated, original):
    """An expression that is one of two."""
    return ["(", ON, " ? (", *mutated, ") : (", *original, "))"]


def render(source, mutants, guard):
    """The source with all mutants in it; guard(mutant) is the text that asks whether it runs."""
    return render_part(source, 0, len(source), sorted(mutants, key=lambda m: (m.start, -m.end, m.number)), guard)


def render_part(source, start, end, mutants, guard):
    inside = [m for m in mutants if start <= m.start and m.end <= end]
    done, at = [], start
    while inside:
        outer = inside[0]
        done.append(source[at:outer.start])
        within = [m for m in inside[1:] if m.end <= outer.end]
        done.append(fill(outer.pieces, source, within, guard(outer), guard))
        at = outer.end
        inside = [m for m in inside[1:] if m.start >= outer.end]
    done.append(source[at:end])
    return "".join(done)


def fill(pieces, source, mutants, on, guard):
    text = []
    for piece in pieces:
        if isinstance(piece, str):
            text.append(piece.replace(ON, on))
        else:
            text.append(render_part(source, *piece, mutants, guard))
    return "".join(text)


def mutated_text(source, mutant):
    """What the broken version says in the place of the sound one."""
    return fill(mutant.mutated, source, [], "", None)


def conflict(one, other):
    """Whether two mutants cut each other: neither holds the other, or a part of one that the other leaves out."""
    if one.end <= other.start or other.end <= one.start:
        return False
    outer, inner = (one, other) if (one.start, -one.end) < (other.start, -other.end) else (other, one)
    if (outer.start, outer.end) == (inner.start, inner.end) or outer.end < inner.end:
        return True
    spans = [piece for piece in outer.pieces if not isinstance(piece, str)]
    return not any(a <= inner.start and inner.end <= b for a, b in spans)
