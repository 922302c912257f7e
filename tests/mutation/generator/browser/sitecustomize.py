# SPDX-License-Identifier: GPL-3.0-or-later
"""Tells every page that the tests open which mutant runs: scripts cannot read the environment."""

import os

try:
    from selenium import webdriver
except ImportError:
    webdriver = None

CHOSEN = os.environ.get("SPHVERIFY_MUTANT", "")

if webdriver and CHOSEN.isdigit():
    start = webdriver.Chrome.__init__

    def start_with_mutant(self, *arguments, **named):
        start(self, *arguments, **named)
        script = f"globalThis.__mutant = (number) => number === {CHOSEN};"
        self.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": script})

    webdriver.Chrome.__init__ = start_with_mutant
