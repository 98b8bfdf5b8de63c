#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Uses a page of kios_clash: see browser.py. Clashes are chosen by mouse and keyboard, which must
turn the view to them and colour both parts; other parts are hidden and shown."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from browser import run


def colored(picture, like):
    """The part of a picture whose pixels are like that: red, or blue."""
    rows, size = picture
    pixels = [row[i:i + 3] for row in rows for i in range(0, len(row), size)]
    return sum(1 for p in pixels if like(*p)) / len(pixels)


def red(r, g, b):
    return r > g + 25 and r > b + 25


def blue(r, g, b):
    return b > r + 40


def test(page):
    browser = page.browser
    listed = browser.value("document.querySelectorAll('tr[data-clash]').length")
    page.require("%d clashes are listed" % listed,
                 listed == browser.value("report.clashes.length") > 100)
    page.require("the worst are first", browser.value("report.clashes[order[0]].status") == "overlap")
    page.require("nothing is coloured", colored(page.start, red) + colored(page.start, blue) < 0.01)
    page.camera()
    x, y = browser.value("(() => { const r = document.querySelector('tr[data-clash] td')."
                         "getBoundingClientRect(); return [r.x + 5, r.y + 5]; })()")
    for kind in ("mousePressed", "mouseReleased"):
        browser.mouse(kind, x, y, button="left", clickCount=1)
    first = page.picture()
    with open(sys.argv[3].replace(".png", "_clash.png"), "wb") as file:
        file.write(browser.screenshot())
    page.require("a click chooses a clash", browser.value("shown.clash === order[0]"))
    page.require("a is red and b blue", colored(first, red) > 0.005 and colored(first, blue) > 0.005)
    page.require("the view is nearer", browser.value("camera.distance < camera.radius"))
    page.require("the segment's middle is what is looked at", browser.value(
        "scene.segment[0].every((x, i) => Math.abs(x + scene.segment[1][i]) < 1e-12)"))
    browser.key("o")
    page.require("others are hidden", page.changed(first) > 0.001 and
                 browser.value("renderer.meshes.filter((m) => !m.hidden).length") == 2)
    browser.key("o")
    page.require("and shown again", page.changed(first) == 0)
    browser.key("]")
    page.require("a key goes to the next", browser.value("shown.clash === order[1]"))
    browser.key("[")
    page.require("and back", browser.value("shown.clash === order[0]"))
    browser.key("a")
    browser.key("r")
    page.require("all parts are shown as at first", page.changed() == 0)


run(test)
