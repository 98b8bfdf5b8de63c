#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Uses a page of kios_inspect: see browser.py. Mesh and volumes are shown and hidden, levels are
stepped through by keyboard and slider, and each must change the picture."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from browser import differing, run


def test(page):
    browser = page.browser
    for key in "vm":
        browser.key(key)
    background = page.picture()
    for key in "vm":
        browser.key(key)
    covered = differing(page.start, background)
    page.require("mesh and volumes cover %.0f %% of the view" % (100 * covered), covered > 0.05)
    page.require("what is hidden and shown again looks as before", page.changed() == 0)
    page.camera()
    level = browser.value("shown.level")
    browser.key("[" if level > 0 else "]")
    page.require("a key changes the level", browser.value("shown.level") != level and
                 page.changed() > 0.001)
    deepest = int(browser.value("document.getElementById('level').max"))
    page.slide("level", deepest)
    page.require("the slider reaches level %d" % deepest,
                 browser.value("shown.level") == deepest and page.changed() > 0.001)


run(test)
