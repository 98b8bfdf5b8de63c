#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Uses a page of `kios_robot show --path`: see test/tools/browser.py. The path must be clear and
have several parts."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../tools"))
from browser import differing, run


def test(page):
    browser = page.browser
    page.require("the motion is proven", browser.value("motion.verdict") == "clear" and
                 browser.value("document.getElementById('first').hidden"))
    stops = browser.value("stops")
    page.require("its stops are %s" % stops, len(stops) > 2 and stops[0] == 0 and
                 stops[-1] == browser.value("frames.length - 1") and stops == sorted(set(stops)))
    page.require("a stop is a configuration of the file",
                 browser.value("frames[stops[2]].q") == [-1.54347, -0.206187])
    page.require("the robot is drawn at all stops", browser.value("ghosts.length") ==
                 len(stops) * browser.value("scene.meshes.filter((m) => !m.obstacle).length"))
    browser.key("s")
    alone = page.picture()
    page.require("without them much of the view is another", differing(page.start, alone) > 0.01)
    browser.key("s")
    page.require("with them it looks as before", page.changed() == 0)
    page.slide("path", stops[3])
    page.require("the slider moves the robot among them", page.changed() > 0.003)
    # The curve holds what the slider shows, and leads along the path.
    page.require("the band holds what is seen", browser.value("""content.band.every((step, i) =>
      step[0] > 0 && step[0] <= step[1] && [i, i + 1].every((k) => frames[k].clearance >= step[0]))"""))
    browser.value("""(() => {
      const box = document.querySelector('.curve svg').getBoundingClientRect();
      document.querySelector('.curve').dispatchEvent(new MouseEvent('click',
        {clientX: box.left + 0.5 * box.width, clientY: box.top + 5})); })()""")
    place = browser.value("frames[shown.place].at")
    page.require("a click on the curve leads to %.2f of the path" % place, abs(place - 0.5) < 0.02)
    page.slide("path", 0)
    page.require("back at the start it looks as before", page.changed() == 0)


run(test)
