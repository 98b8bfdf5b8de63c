#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Drives the tools' pages in headless Chromium, over its debugging pipe. A module of tests.

usage: TEST.py CHROMIUM PAGE.html PICTURE.png [--size WxH] [--dark] [--no-test]

Draws the page and does what the test says, which turns it, zooms it and more. The test fails unless
the page asks nothing of the network and the console stays free of errors. PICTURE.png is the page
as it first looks; --no-test stops there.
"""
import argparse
import base64
import json
import os
import select
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib


class Browser:
    def __init__(self, program):
        to_browser, self.commands = os.pipe()
        self.answers, from_browser = os.pipe()
        self.profile = tempfile.mkdtemp(prefix="kios_page_")
        command = [program, "--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
                   "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                   "--ignore-gpu-blocklist", "--remote-debugging-pipe", "--no-first-run",
                   "--disable-background-networking", "--user-data-dir=" + self.profile,
                   "about:blank"]
        # Chromium reads commands from descriptor 3 and answers on 4.
        script = 'exec "$@" 3<&%d 4>&%d' % (to_browser, from_browser)
        self.log = tempfile.TemporaryFile()
        self.process = subprocess.Popen(["bash", "-c", script, "bash", *command],
                                        pass_fds=[to_browser, from_browser],
                                        stdin=subprocess.DEVNULL, stdout=self.log,
                                        stderr=subprocess.STDOUT)
        os.close(to_browser)
        os.close(from_browser)
        self.pending = b""
        self.last_id = 0
        self.events = []
        self.session = None

    def message(self, deadline):
        while b"\0" not in self.pending:
            ready, _, _ = select.select([self.answers], [], [], max(0, deadline - time.time()))
            part = os.read(self.answers, 1 << 20) if ready else b""
            if not part:
                self.log.seek(0)
                sys.exit("browser.py: Chromium does not answer:\n" +
                         self.log.read().decode(errors="replace")[-3000:])
            self.pending += part
        text, self.pending = self.pending.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **parameters):
        self.last_id += 1
        request = {"id": self.last_id, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.commands, json.dumps(request).encode() + b"\0")
        deadline = time.time() + 120
        while True:
            message = self.message(deadline)
            if message.get("id") != self.last_id:
                self.events.append(message)
            elif "error" in message:
                sys.exit("browser.py: %s: %s" % (method, message["error"]))
            else:
                return message["result"]

    def open(self, url, width, height, dark):
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target,
                                 flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=False)
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.call("Page.navigate", url=url)
        deadline = time.time() + 60
        while self.value("document.body && document.body.dataset.state || ''") != "drawn":
            if time.time() > deadline:
                sys.exit("browser.py: the page is not drawn: state '%s', '%s'; %s" % (
                    self.value("document.body.dataset.state"),
                    self.value("document.getElementById('failure').textContent"),
                    self.complaints()))
            time.sleep(0.05)

    def value(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in result:
            sys.exit("browser.py: %s: %s" % (expression, result["exceptionDetails"]))
        return result["result"].get("value")

    def settle(self):
        self.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame("
                   "() => done(1))))")

    def screenshot(self):
        self.settle()
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def drag(self, begin, end):
        self.mouse("mousePressed", *begin, button="left", buttons=1, clickCount=1)
        for step in range(1, 9):
            x, y = (b + (e - b) * step / 8 for b, e in zip(begin, end))
            self.mouse("mouseMoved", x, y, button="left", buttons=1)
        self.mouse("mouseReleased", *end, button="left", buttons=0, clickCount=1)

    def key(self, key):
        text = {"text": key} if len(key) == 1 else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, **text)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key)

    def complaints(self):
        """Errors on the console, exceptions, and requests that leave the page."""
        found = []
        for event in self.events:
            method, parameters = event.get("method"), event.get("params", {})
            if method == "Runtime.exceptionThrown":
                found.append(str(parameters["exceptionDetails"]))
            if method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "assert"):
                found.append(str(parameters["args"]))
            if method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
                found.append(parameters["entry"]["text"])
            if method == "Network.requestWillBeSent":
                url = parameters["request"]["url"]
                if not url.startswith(("file:", "about:", "data:")):
                    found.append("the page asks for " + url)
        return found

    def close(self):
        self.session = None
        os.write(self.commands, b'{"id":0,"method":"Browser.close"}\0')
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
        shutil.rmtree(self.profile, ignore_errors=True)


def pixels(png):
    """Rows of a PNG of 8-bit RGB or RGBA, and the bytes of a pixel."""
    at, compressed = 8, b""
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, colors = struct.unpack(">IIBB", png[at + 8:at + 18])
            assert depth == 8 and colors in (2, 6)
        if kind == b"IDAT":
            compressed += png[at + 8:at + 8 + length]
        at += 12 + length
    size = 3 if colors == 2 else 4
    raw, rows, above = zlib.decompress(compressed), [], bytearray(width * size)
    for row in range(height):
        begin = row * (width * size + 1)
        kind, line = raw[begin], bytearray(raw[begin + 1:begin + 1 + width * size])
        for i in range(len(line) if kind else 0):
            a = line[i - size] if i >= size else 0
            b = above[i]
            c = above[i - size] if i >= size else 0
            if kind == 4:
                nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            line[i] = (line[i] + (0, a, b, (a + b) // 2, nearest if kind == 4 else 0)[kind]) & 255
        rows.append(line)
        above = line
    return rows, size


def view(png, width):
    """The part of a screenshot that the canvas covers, without the controls."""
    rows, size = pixels(png)
    return [bytes(row[:width * size]) for row in rows[:len(rows) - 90]], size


def differing(a, b):
    (rows, size), (others, _) = a, b
    count = sum(1 for row, other in zip(rows, others) if row != other
                for i in range(0, len(row), size)
                if max(abs(x - y) for x, y in zip(row[i:i + 3], other[i:i + 3])) > 12)
    return count / (len(rows) * len(rows[0]) / size)


class Requirements:
    """What a test asks of the page in a browser, and what failed."""

    def __init__(self, browser, first):
        self.browser = browser
        self.width, height = browser.value("[canvas.clientWidth, canvas.clientHeight]")
        self.middle = (self.width / 2, height / 2)
        self.failures = []
        self.start = view(first, self.width)

    def require(self, what, holds):
        print("%s: %s" % (what, "ok" if holds else "FAILED"))
        if not holds:
            self.failures.append(what)

    def picture(self):
        self.browser.value("document.activeElement.blur()")  # without the frame of the focus
        return view(self.browser.screenshot(), self.width)

    def changed(self, picture=None):
        """The part of the view that differs from a picture, else from that at the start."""
        return differing(picture or self.start, self.picture())

    def camera(self):
        """Mouse, wheel, finger and R, which every page has."""
        browser, middle = self.browser, self.middle
        rows, size = self.start
        colors = {row[i:i + 3] for row in rows for i in range(0, len(row), size)}
        self.require("the picture has %d colours" % len(colors), len(colors) > 200)
        browser.drag(middle, (middle[0] + 120, middle[1] + 40))
        turned = self.picture()
        self.require("a drag turns it", differing(self.start, turned) > 0.02)
        browser.mouse("mouseWheel", *middle, deltaX=0, deltaY=300)
        self.require("the wheel zooms", self.changed(turned) > 0.02)
        before = browser.value("camera.rotation.join()")
        browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
        for kind, dx in (("touchStart", 0), ("touchMove", 30), ("touchMove", 60)):
            browser.call("Input.dispatchTouchEvent", type=kind,
                         touchPoints=[{"x": middle[0] + dx, "y": middle[1]}])
        browser.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        browser.call("Emulation.setTouchEmulationEnabled", enabled=False)
        self.require("a finger turns it", browser.value("camera.rotation.join()") != before)
        browser.key("r")
        self.require("R restores the view", self.changed() == 0)

    def slide(self, name, value):
        self.browser.value("(() => { const s = document.getElementById('%s'); s.value = %s;"
                           "s.dispatchEvent(new Event('input')); return 1; })()" % (name, value))


def run(test):
    """test(Requirements) uses the page and notes what fails."""
    parser = argparse.ArgumentParser()
    parser.add_argument("chromium")
    parser.add_argument("page")
    parser.add_argument("picture")
    parser.add_argument("--size", default="900x560")
    parser.add_argument("--dark", action="store_true")
    parser.add_argument("--no-test", action="store_true")
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    browser = Browser(options.chromium)
    try:
        browser.open("file://" + os.path.abspath(options.page), width, height, options.dark)
        first = browser.screenshot()
        with open(options.picture, "wb") as file:
            file.write(first)
        requirements = Requirements(browser, first)
        if not options.no_test:
            test(requirements)
        failures = requirements.failures + browser.complaints()
    finally:
        browser.close()
    if failures:
        sys.exit("browser.py: " + "; ".join(failures))
