#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Uses a page of `kios_robot show`: see test/tools/browser.py. The path of the page must meet
something on its way."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../tools"))
from browser import differing, run


def test(page):
    browser = page.browser
    # Each part covers something, and comes back.
    for key, what, least in (("m", "robot", 0.01), ("o", "obstacles", 0.01),
                             ("n", "nearest points", 0.0001)):
        browser.key(key)
        covered = page.changed()
        page.require("without %s %.2f %% of the view are others" % (what, 100 * covered),
                     covered > least)
        browser.key(key)
        page.require("with %s it looks as before" % what, page.changed() == 0)
    page.camera()

    page.require("the motion is refuted", browser.value("motion.verdict") == "contact")
    place = browser.value("frames.findIndex((frame) => frame.contact)")
    page.require("contact begins at place %d, which is marked, and the page opens there" % place,
                 place > 1 and place == browser.value("contactPlace") and
                 place == browser.value("shown.place") and
                 browser.value("fields.clearance.textContent") == "contact" and
                 browser.value("document.getElementById('mark').offsetHeight") > 0)
    page.slide("path", 0)
    clearance = browser.value("fields.clearance.textContent")
    page.require("the panel says how far it is: " + clearance, clearance.endswith(" m"))
    at_start = page.picture()
    page.require("the robot has moved", differing(page.start, at_start) > 0.01)
    browser.key("]")
    page.require("a key steps along the path", browser.value("shown.place") == 1)
    browser.value("document.getElementById('first').click()")
    page.require("the button leads to the contact", browser.value("shown.place") == place and
                 page.changed() == 0)
    gap = browser.value("""(() => {
      const s = document.getElementById('path').getBoundingClientRect();
      const m = document.getElementById('mark').getBoundingClientRect();
      return Math.abs(s.left + 8 + (s.width - 16) * shown.place / (frames.length - 1) -
        (m.left + m.right) / 2); })()""")
    page.require("the mark is %.1f pixels off the thumb" % gap, gap < 3)
    last = browser.value("frames.length - 1")
    page.slide("path", last)
    page.require("the slider reaches the end", browser.value("shown.place") == last and
                 page.changed() > 0.001)
    page.slide("path", 0)
    page.require("back at the start it looks as before", page.changed(at_start) == 0)


run(test)
