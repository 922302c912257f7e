#!/usr/bin/env python3
"""Sees that your code's rates are those of `sphverify evaluate` on the same particles; exit status 1 if not.

Usage: same-rates.py OWN.json SPHVERIFY.json [LIMIT]
Compares every list in OWN.json, {"rates": {scheme: {quantity: [one number or vector per particle]}}}. No number may
differ by more than LIMIT (1e-12 unless given) of the largest.
"""

import json
import sys


def flat(values):
    return [x for value in values for x in (value if isinstance(value, list) else [value])]


def judge(own, scheme, quantity, document, limit):
    """Whether one list of rates is the same, and what to say about it."""
    if scheme not in document["rates"]:
        return False, document.get("left_out", {}).get(scheme, "sphverify knows no such scheme")
    found = document["rates"][scheme]
    if found.get(quantity) is None:
        return False, found.get("reason", f"sphverify gives {', '.join(found)}")
    own, reference = flat(own), flat(found[quantity])
    if len(own) != len(reference):
        return False, f"{len(own)} numbers, expected {len(reference)}"
    largest = max(map(abs, reference))
    # Asked this way round, because nothing that is not a number is within a limit.
    far = [n for n, (a, b) in enumerate(zip(own, reference)) if not abs(a - b) <= limit * largest]
    if far:
        n = far[0]
        return False, f"{len(far)} of {len(own)} numbers are off, the first is {own[n]:.9g}, expected {reference[n]:.9g}"
    return True, f"{len(own)} numbers within {limit:g} of the largest"


def main(own_path, sphverify_path, limit="1e-12"):
    with open(own_path) as own_file, open(sphverify_path) as sphverify_file:
        own, document = json.load(own_file), json.load(sphverify_file)
    verdicts = []
    for scheme, quantities in own["rates"].items():
        for quantity, values in quantities.items():
            same, remark = judge(values, scheme, quantity, document, float(limit))
            verdicts.append(same)
            print("passed" if same else "failed", scheme, f"{quantity}: {remark}")
    if not verdicts:
        print(f"failed: {own_path} has no rates")
    return 0 if verdicts and all(verdicts) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
