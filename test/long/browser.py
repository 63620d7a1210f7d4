# SPDX-License-Identifier: GPL-3.0-or-later
"""What drive-page and drive-playground share: a browser without a display that shows a page and is used as a person does,
and checks of what it shows."""
import argparse
import base64
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]


def parser_for(documentation):
    """A parser of the command line of a script with this documentation, with the option for the browser."""
    parser = argparse.ArgumentParser(description=documentation.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--browser", choices=["chromium", "firefox"], default="chromium")
    return parser


def start_browser(name, downloads):
    """A browser, which is installed if it is missing, and saves files in the folder `downloads`."""
    kind = {"chromium": Chromium, "firefox": Firefox}[name]
    subprocess.run([ROOT / "scripts/install-dependencies", *kind.packages, "fonts-dejavu-core"], check=True)
    return kind(downloads)


def fail(text):
    sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {text}")


def wait_for(condition, what):
    for _ in range(600):
        if condition():
            return
        time.sleep(0.05)
    fail(f"not within 30 s: {what}")


def check(what, holds):
    if not holds:
        fail(f"does not hold: {what}")
    print(f"holds: {what}")


class Browser:
    """A page in a browser, used as a person does; how a browser is told what to do is up to the classes below."""

    def __init__(self):
        self.profile = tempfile.TemporaryDirectory()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.process.terminate()
        self.process.wait()
        self.profile.cleanup()

    def open(self, page, width, height, *, is_phone=False):
        self.resize(width, height, is_phone)
        self.navigate("about:blank")  # so that another fragment loads the page again
        self.navigate(page)
        wait_for(lambda: self.evaluate("document.readyState") == "complete", "the page loads")
        self.settle()

    def settle(self):
        self.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def tap(self, x, y):
        self.press(x, y)
        self.settle()

    def click(self, name):
        self.evaluate(f"document.getElementById('{name}').click()")

    def text(self, name):
        return self.evaluate(f"document.getElementById('{name}').textContent")

    def type(self, name, text):
        self.evaluate(f"document.getElementById('{name}').focus(), document.getElementById('{name}').select()")
        self.insert(text)
        self.evaluate("document.activeElement.blur()")

    def copied_link(self):
        """What the button `link` copies; a browser without a display may have no clipboard."""
        self.evaluate("navigator.clipboard.writeText = text => { window.copied = text; return Promise.resolve(); }")
        self.click("link")
        return self.evaluate("window.copied")

    def picture(self, path):
        path.write_bytes(base64.b64decode(self.screenshot()))


class Chromium(Browser):
    """Chromium takes commands of the DevTools protocol from one pipe and answers on another."""

    packages = ["chromium"]
    can_be_a_phone = True

    def __init__(self, downloads):
        super().__init__()
        commands, self.output = os.pipe()
        self.input, answers = os.pipe()

        def place_pipes():  # where Chromium expects them
            copies = os.dup(commands), os.dup(answers)
            os.dup2(copies[0], 3)
            os.dup2(copies[1], 4)

        self.process = subprocess.Popen(
            ["chromium", "--headless", "--no-sandbox", "--remote-debugging-pipe", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--hide-scrollbars",
             f"--user-data-dir={self.profile.name}"],
            preexec_fn=place_pipes, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(commands)
        os.close(answers)
        self.rest, self.calls, self.session = b"", 0, None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(downloads))
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in "Page", "Runtime":
            self.call(domain + ".enable")

    def receive(self):
        while b"\0" not in self.rest:
            data = os.read(self.input, 1 << 20)
            if not data:
                fail("Chromium ended")
            self.rest += data
        text, self.rest = self.rest.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **parameters):
        self.calls += 1
        message = {"id": self.calls, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.output, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive()
            if answer.get("method") == "Runtime.exceptionThrown":
                fail(f"the page failed: {answer['params']['exceptionDetails']}")
            if answer.get("id") == self.calls:
                if "error" in answer:
                    fail(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def evaluate(self, text):
        answer = self.call("Runtime.evaluate", expression=text, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            fail(f"{text}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def resize(self, width, height, is_phone):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, mobile=is_phone,
                  deviceScaleFactor=2 if is_phone else 1)
        self.call("Emulation.setTouchEmulationEnabled", enabled=is_phone)

    def navigate(self, page):
        self.call("Page.navigate", url=page)

    def press(self, x, y):
        for kind in "mousePressed", "mouseReleased":
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def insert(self, text):
        self.call("Input.insertText", text=text)

    def screenshot(self):
        return self.call("Page.captureScreenshot", format="png")["data"]


class Firefox(Browser):
    """Firefox takes commands of WebDriver by its protocol Marionette from a port of this computer. It has no WebGL
    without a display, so that Xvfb gives it one."""

    packages = ["firefox-esr", "libegl1", "libgl1-mesa-dri", "xvfb"]
    can_be_a_phone = False  # its windows are at least 450 pixels wide

    def __init__(self, downloads):
        super().__init__()
        profile = pathlib.Path(self.profile.name)
        preferences = {"marionette.port": 0, "browser.download.folderList": 2, "browser.download.dir": str(downloads),
                       "browser.download.always_ask_before_handling_new_types": False, "webgl.force-enabled": True}
        (profile / "user.js").write_text(
            "".join(f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in preferences.items()))
        self.display = subprocess.Popen(["Xvfb", "-displayfd", "1", "-noreset", "-screen", "0", "1600x1200x24"],
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        screen = ":" + self.display.stdout.readline().decode().strip()
        self.process = subprocess.Popen(["firefox-esr", "--marionette", "--no-remote", "--profile", profile],
                                        env={**os.environ, "DISPLAY": screen, "HOME": self.profile.name},
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        port = profile / "MarionetteActivePort"
        wait_for(lambda: port.exists() and port.read_text(), "Firefox listens")
        self.input = socket.create_connection(("127.0.0.1", int(port.read_text()))).makefile("rwb")
        self.calls = 0
        self.receive()
        self.call("WebDriver:NewSession", capabilities={})

    def close(self):
        super().close()
        self.display.terminate()
        self.display.wait()

    def receive(self):
        length = b""
        while not length.endswith(b":"):
            length += self.input.read(1) or fail("Firefox ended")
        return json.loads(self.input.read(int(length[:-1])))

    def call(self, method, **parameters):
        self.calls += 1
        message = json.dumps([0, self.calls, method, parameters]).encode()
        self.input.write(b"%d:" % len(message) + message)
        self.input.flush()
        _, _, error, result = self.receive()
        if error:
            fail(f"{method}: {error['message']}")
        return result

    def evaluate(self, text):
        return self.call("WebDriver:ExecuteScript", script=f"return {text}", args=[], sandbox=None)["value"]

    def resize(self, width, height, is_phone):
        self.navigate("about:blank")
        frame = self.evaluate("[outerWidth - innerWidth, outerHeight - innerHeight]")
        self.call("WebDriver:SetWindowRect", width=width + frame[0], height=height + frame[1])

    def navigate(self, page):
        self.call("WebDriver:Navigate", url=page)

    def perform(self, kind, actions):
        self.call("WebDriver:PerformActions", actions=[{"type": kind, "id": kind, "actions": actions}])

    def press(self, x, y):
        self.perform("pointer", [{"type": "pointerMove", "x": x, "y": y}, {"type": "pointerDown", "button": 0},
                                 {"type": "pointerUp", "button": 0}])

    def insert(self, text):
        self.perform("key", [{"type": kind, "value": key} for key in text for kind in ("keyDown", "keyUp")])

    def screenshot(self):
        return self.call("WebDriver:TakeScreenshot", full=False)["value"]
