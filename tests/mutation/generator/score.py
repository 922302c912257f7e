# SPDX-License-Identifier: GPL-3.0-or-later
"""The score of a run, by room, with its interval."""

import math


def wilson(successes, trials, z=1.959964):
    """Wilson's 95% interval of a probability."""
    if trials == 0:
        return 0.0, 1.0
    share = successes / trials
    middle = share + z * z / (2 * trials)
    half = z * math.sqrt(share * (1 - share) / trials + z * z / (4 * trials * trials))
    scale = 1 + z * z / trials
    return (middle - half) / scale, (middle + half) / scale


def table(records):
    lines = ["", "| room | mutants | caught | score | 95% interval |", "|---|---|---|---|---|"]
    rooms = list(dict.fromkeys(r["room"] for r in records))
    for room in [*sorted(rooms), "all"]:
        inside = [r for r in records if room in ("all", r["room"])]
        caught = sum(bool(r["caught_by"]) for r in inside)
        low, high = wilson(caught, len(inside))
        share = 100 * caught / len(inside) if inside else 0.0
        lines.append(f"| {room} | {len(inside)} | {caught} | {share:.1f}% | {100 * low:.1f} to {100 * high:.1f}% |")
    return "\n".join(lines)
