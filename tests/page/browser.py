"""Headless Chromium by its DevTools protocol over a pair of pipes: commands and
events are JSON, each ended by a zero byte."""
import base64
import json
import os
import shutil
import subprocess
import tempfile
import time

KEYS = {" ": 32, "ArrowRight": 39}  # which browsers know by number
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic",
         "--no-first-run", "--disable-background-networking", "--disable-sync",
         "--disable-component-update", "--hide-scrollbars",
         "--disable-dev-shm-usage", "--remote-debugging-pipe"]


class Browser:
    def __init__(self, program):
        self.folder = tempfile.mkdtemp(prefix="twofold-browser.")
        commands, self.to = os.pipe()
        self.back, answers = os.pipe()

        # The browser reads from 3 and writes to 4; above 9 neither is in the
        # way of the other.
        def place():
            high = [os.dup(fd) for fd in (commands, answers)]
            high = [fd if fd > 9 else os.dup2(fd, fd + 20) for fd in high]
            os.dup2(high[0], 3)
            os.dup2(high[1], 4)

        self.process = subprocess.Popen(
            [program, *FLAGS, f"--user-data-dir={self.folder}", "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, close_fds=False, preexec_fn=place)
        os.close(commands)
        os.close(answers)
        self.number, self.rest, self.events = 0, b"", []

    def close(self):
        self.process.kill()
        self.process.wait()
        os.close(self.to)
        os.close(self.back)
        shutil.rmtree(self.folder, ignore_errors=True)

    def message(self):
        while b"\0" not in self.rest:
            data = os.read(self.back, 1 << 20)
            if not data:
                raise RuntimeError("the browser has ended")
            self.rest += data
        text, self.rest = self.rest.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, session=None, **params):
        self.number += 1
        command = {"id": self.number, "method": method, "params": params}
        if session:
            command["sessionId"] = session
        data = json.dumps(command).encode() + b"\0"
        while data:
            data = data[os.write(self.to, data):]
        while True:
            message = self.message()
            if message.get("id") == self.number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]
            self.events.append(message)


class Tab:
    """A page with a size, in a profile of its own."""

    def __init__(self, browser, width=1280, height=900, dark=False, calm=True,
                 phone=False):
        self.browser, self.width, self.height = browser, width, height
        self.context = browser.call("Target.createBrowserContext")
        target = browser.call("Target.createTarget", url="about:blank",
                              **self.context)
        self.session = browser.call("Target.attachToTarget", flatten=True,
                                    targetId=target["targetId"])["sessionId"]
        for domain in ("Page", "Runtime", "Network"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width,
                  height=height, deviceScaleFactor=2 if phone else 1,
                  mobile=phone)
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme",
             "value": "dark" if dark else "light"},
            {"name": "prefers-reduced-motion",
             "value": "reduce" if calm else "no-preference"}])

    def close(self):
        self.browser.call("Target.disposeBrowserContext", **self.context)

    def call(self, method, **params):
        return self.browser.call(method, self.session, **params)

    def open(self, url):
        failed = self.call("Page.navigate", url=url).get("errorText")
        while self.value("Boolean(window.twofold)") is not True:
            if failed or self.complaints():
                raise RuntimeError(f"{url} does not load: {self.complaints()}")
            time.sleep(0.05)

    def value(self, expression):
        """What JavaScript says; a promise is waited for."""
        got = self.call("Runtime.evaluate", expression=expression,
                        awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in got:
            detail = got["exceptionDetails"]
            raise RuntimeError(detail.get("exception", {}).get("description")
                               or detail["text"])
        return got["result"].get("value")

    def key(self, name, shift=False):
        for kind in ("rawKeyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=name,
                      windowsVirtualKeyCode=KEYS.get(name, 0),
                      modifiers=8 if shift else 0)

    def mouse(self, kind, x, y, held=False):
        self.call("Input.dispatchMouseEvent", type=f"mouse{kind}", x=x, y=y,
                  button="left" if held or kind != "Moved" else "none",
                  clickCount=1,
                  buttons=0 if kind == "Released" or not held else 1)

    def mine(self, method):
        return [event["params"] for event in self.browser.events
                if event.get("method") == method
                and event.get("sessionId") == self.session]

    def complaints(self):
        """Exceptions and errors on the console."""
        thrown = [event["exceptionDetails"].get("exception", {})
                  .get("description", event["exceptionDetails"]["text"])
                  for event in self.mine("Runtime.exceptionThrown")]
        said = [str(event["args"]) for event in
                self.mine("Runtime.consoleAPICalled")
                if event["type"] == "error"]
        return thrown + said

    def requests(self):
        return [event["request"]["url"]
                for event in self.mine("Network.requestWillBeSent")]

    def picture(self):
        """The whole page as PNG."""
        return base64.b64decode(self.call(
            "Page.captureScreenshot", format="png",
            captureBeyondViewport=True)["data"])
