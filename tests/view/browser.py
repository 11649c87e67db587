"""Chromium without a window, driven by its DevTools protocol over pipes; needs Python's standard library alone."""

import base64
import fcntl
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
# Pictures are drawn by SwiftShader, on the processor: the same everywhere, and no graphics card is needed.
OPTIONS = ["--headless", "--no-sandbox", "--remote-debugging-pipe", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
           "--hide-scrollbars", "--no-first-run", "--disable-extensions", "--disable-background-networking",
           "--disable-component-update", "--disable-sync", "--mute-audio"]


def find():
    """The path of a browser, or None."""
    return next(filter(None, map(shutil.which, NAMES)), None)


class Browser:
    """The process. Messages are JSON, each ended by a zero byte: commands on its descriptor 3, answers on 4."""

    def __init__(self, path, timeout=60):
        self.timeout = timeout
        self.folder = tempfile.TemporaryDirectory(prefix="powercell-browser-", ignore_cleanup_errors=True)
        command, self.commands = os.pipe()
        self.answers, answer = os.pipe()
        ends = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (command, answer)]  # away from 3 and 4

        def connect():
            os.dup2(ends[0], 3)
            os.dup2(ends[1], 4)

        self.process = subprocess.Popen(
            [path, *OPTIONS, "--user-data-dir=" + self.folder.name], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, preexec_fn=connect, pass_fds=(3, 4), start_new_session=True)
        for end in (command, answer, *ends):
            os.close(end)
        self.number = 0
        self.buffer = b""
        self.events = []

    def read(self, deadline):
        while b"\0" not in self.buffer:
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([self.answers], [], [], left)[0]:
                raise TimeoutError("the browser does not answer")
            part = os.read(self.answers, 1 << 20)
            if not part:
                raise ConnectionError("the browser has ended")
            self.buffer += part
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, session=None, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        text = json.dumps(message).encode() + b"\0"
        while text:
            text = text[os.write(self.commands, text):]
        deadline = time.monotonic() + self.timeout
        while True:
            answer = self.read(deadline)
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self.events.append(answer)

    def close(self):
        try:
            self.call("Browser.close")
            self.process.wait(10)
        except (ConnectionError, TimeoutError, subprocess.TimeoutExpired, BrokenPipeError):
            self.process.kill()
            self.process.wait()
        os.close(self.commands)
        os.close(self.answers)
        self.folder.cleanup()


class Tab:
    """A page of a size, on a desktop or a phone."""

    def __init__(self, browser, width, height, scale=1, phone=False):
        self.browser, self.phone = browser, phone
        self.url = "about:blank"
        self.target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = browser.call("Target.attachToTarget", targetId=self.target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(domain + ".enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=phone)
        if phone:
            self.call("Emulation.setTouchEmulationEnabled", enabled=True)

    def call(self, method, **parameters):
        return self.browser.call(method, self.session, **parameters)

    def evaluate(self, script):
        """The value of an expression, awaited if it is a promise."""
        answer = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(script + ": " + json.dumps(answer["exceptionDetails"])[:500])
        return answer["result"].get("value")

    def wait(self, condition, timeout=60):
        deadline = time.monotonic() + timeout
        while not self.evaluate(condition):
            if time.monotonic() > deadline:
                raise TimeoutError(f"not within {timeout} s: {condition}; {self.complaints()}")
            time.sleep(0.02)

    def open(self, path):
        self.url = "file://" + os.fspath(path)
        self.call("Page.navigate", url=self.url)
        self.wait("['ready', 'failed'].includes(document.documentElement?.dataset.state)")

    def press(self, x, y):
        """A click, or on a phone a tap."""
        if self.phone:
            self.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
            self.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
            return
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def drag(self, x, y, dx, dy, steps=4):
        self.call("Input.dispatchMouseEvent", type="mousePressed", x=x, y=y, button="left", clickCount=1)
        for k in range(1, steps + 1):
            self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x + dx * k / steps, y=y + dy * k / steps,
                      button="left", buttons=1)
        self.call("Input.dispatchMouseEvent", type="mouseReleased", x=x + dx, y=y + dy, button="left", clickCount=1)

    def key(self, name):
        code = {"Enter": 13, "Escape": 27}.get(name, 0)
        text = {"Enter": "\r"}.get(name, name if len(name) == 1 else "")
        self.call("Input.dispatchKeyEvent", type="keyDown", key=name, text=text, windowsVirtualKeyCode=code)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=name, windowsVirtualKeyCode=code)

    def screenshot(self):
        """PNG, as seen."""
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])

    def complaints(self):
        """Errors and warnings of the page so far, and addresses that it asked for besides its own."""
        found = []
        for event in self.browser.events:
            if event.get("sessionId") != self.session:
                continue
            method, given = event["method"], event.get("params", {})
            if method == "Runtime.exceptionThrown":
                found.append("exception: " + json.dumps(given["exceptionDetails"])[:500])
            elif method == "Runtime.consoleAPICalled" and given["type"] in ("error", "warning", "assert"):
                found.append("console: " + json.dumps(given["args"])[:500])
            elif method == "Log.entryAdded" and given["entry"]["level"] == "error":
                found.append("log: " + given["entry"]["text"])
            elif method == "Network.requestWillBeSent" and given["request"]["url"] != self.url:
                found.append("request: " + given["request"]["url"][:200])
        return found

    def close(self):
        self.browser.call("Target.closeTarget", targetId=self.target)


class Eyes:
    """Looks at screenshots, in a tab of its own."""

    def __init__(self, browser):
        self.tab = Tab(browser, 100, 100)
        self.tab.evaluate("""globalThis.pixels = async (png, box) => {
            const bytes = Uint8Array.from(atob(png), (c) => c.charCodeAt(0));
            const image = await createImageBitmap(new Blob([bytes]));
            const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
            context.drawImage(image, 0, 0);
            const [x, y, width, height] = box.map((part, k) => Math.round(part * (k % 2 ? image.height : image.width)));
            return context.getImageData(x, y, width, height).data;
        }; undefined""")

    def look(self, script, *pictures, box):
        """Evaluates a script on arrays `a` (and `b`) of red, green, blue, alpha in a box: parts of width and height."""
        names = "abc"[:len(pictures)]
        loads = "".join(f"const {name} = await pixels('{base64.b64encode(picture).decode()}', {json.dumps(box)});"
                        for name, picture in zip(names, pictures))
        return self.tab.evaluate("(async () => {" + loads + script + "})()")

    def colours(self, picture, box):
        """How many of the pixels have each colour, the most frequent first: [[red, green, blue], share]."""
        return self.look("""const counts = new Map();
            for (let k = 0; k < a.length; k += 4) {
              const colour = (a[k] << 16) | (a[k + 1] << 8) | a[k + 2];
              counts.set(colour, (counts.get(colour) ?? 0) + 1);
            }
            return [...counts].sort((p, q) => q[1] - p[1]).slice(0, 2000)
                .map(([c, n]) => [[c >> 16, (c >> 8) & 255, c & 255], (4 * n) / a.length]);""", picture, box=box)

    def change(self, before, after, box):
        """The share of the pixels that differ clearly."""
        return self.look("""let count = 0;
            for (let k = 0; k < a.length; k += 4)
              if (Math.abs(a[k] - b[k]) + Math.abs(a[k + 1] - b[k + 1]) + Math.abs(a[k + 2] - b[k + 2]) > 24) ++count;
            return (4 * count) / a.length;""", before, after, box=box)
