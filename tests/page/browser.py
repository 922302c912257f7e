# SPDX-License-Identifier: GPL-3.0-or-later
"""Chromium without a window, for the tests of the report page."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
import program  # noqa: E402

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ImportError as missing:
    raise unittest.SkipTest(f"needs python3-selenium: {missing}")

CHROMIUM, DRIVER = pathlib.Path("/usr/bin/chromium"), pathlib.Path("/usr/bin/chromedriver")
FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--window-size=1300,1000",
]


class BrowserTest(program.ProgramTest):
    """A class of tests has one browser, and a folder for documents and pages, which `maker` fills."""

    @classmethod
    def setUpClass(cls):
        if not CHROMIUM.exists() or not DRIVER.exists():
            raise unittest.SkipTest("needs chromium and chromium-driver")
        cls.maker = program.ProgramTest()
        folder = tempfile.TemporaryDirectory(prefix="sphverify-page-")
        cls.addClassCleanup(folder.cleanup)
        cls.place = cls.maker.folder = pathlib.Path(folder.name)
        cls.addClassCleanup(cls.maker.doCleanups)

    @classmethod
    def start_browser(cls):
        options = webdriver.ChromeOptions()
        options.binary_location = str(CHROMIUM)
        for flag in [*FLAGS, f"--user-data-dir={cls.place / 'profile'}"]:
            options.add_argument(flag)
        options.add_experimental_option("prefs", {"download.default_directory": str(cls.place / "saved")})
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.driver = webdriver.Chrome(options=options, service=Service(str(DRIVER)))
        cls.addClassCleanup(cls.driver.quit)

    def open(self, name):
        for kind in ["browser", "performance"]:
            self.driver.get_log(kind)
        self.driver.get((self.place / name).as_uri())
        # On a busy machine `get` may return before the page's script has run.
        drawn = "return document.documentElement.dataset.drawn"
        WebDriverWait(self.driver, 60).until(lambda _: self.script(drawn) == "true", "the page is not drawn")

    def script(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def one(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def choose(self, label, value):
        control = self.driver.find_element(By.XPATH, f"//label[span='{label}']/select")
        Select(control).select_by_visible_text(value)

    def assert_silent(self):
        severe = [line for line in self.driver.get_log("browser") if line["level"] != "INFO"]
        self.assertEqual(severe, [])
