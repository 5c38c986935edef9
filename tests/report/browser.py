"""A headless Chromium over its debugging pipe: no package beside Python is needed."""
import base64
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time


def find_chromium():
    names = ("chromium", "chromium-browser", "google-chrome", "chrome")
    return next((path for path in map(shutil.which, names) if path), None)


class Browser:
    """One page with its frames; what their consoles say of errors and warnings is in `said`."""

    def __init__(self, program, seconds=120.0):
        self.seconds, self.count, self.said, self.buffer = seconds, 0, [], b""
        self.contexts = {}  # of scripts, by frame
        self.sessions = {}  # of frames in a process of their own
        self.profile = tempfile.TemporaryDirectory(
            prefix="flowslide-browser-", ignore_cleanup_errors=True)
        to_browser, self.out = os.pipe()
        self.into, from_browser = os.pipe()

        def ends():  # the browser reads 3 and writes 4; neither may be overwritten on the way
            reads, writes = os.dup(to_browser), os.dup(from_browser)
            os.dup2(reads, 3)
            os.dup2(writes, 4)

        self.process = subprocess.Popen(
            [program, "--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe",
             "--hide-scrollbars", "--no-first-run", "--disable-background-networking",
             "--disable-dev-shm-usage", f"--user-data-dir={self.profile.name}", "about:blank"],
            preexec_fn=ends, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        attached = self.call("Target.attachToTarget", targetId=target, flatten=True)
        self.session = attached["sessionId"]
        for part in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{part}.enable")
        self.call("Target.setAutoAttach", autoAttach=True, waitForDebuggerOnStart=False, flatten=True)

    def __enter__(self):
        return self

    def __exit__(self, *error):
        """Lets the browser end by itself: its own processes write into the profile until then."""
        try:
            del self.session
            self.call("Browser.close")
            self.process.wait(self.seconds)
        except (OSError, RuntimeError, AttributeError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        os.close(self.out)
        os.close(self.into)
        self.profile.cleanup()

    def receive(self):
        while b"\0" not in self.buffer:
            part = os.read(self.into, 1 << 20)
            if not part:
                raise RuntimeError("the browser has ended")
            self.buffer += part
        message, self.buffer = self.buffer.split(b"\0", 1)
        message = json.loads(message)
        self.note(message)
        return message

    def note(self, message):
        method, params = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            detail = params["exceptionDetails"]
            self.said.append(detail.get("exception", {}).get("description") or detail["text"])
        elif method == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning"):
            words = (str(a.get("value", a.get("description"))) for a in params["args"])
            self.said.append(" ".join(words))
        elif method == "Log.entryAdded" and params["entry"]["level"] in ("error", "warning"):
            self.said.append(params["entry"]["text"])
        elif method == "Runtime.executionContextCreated":
            context = params["context"]
            if context["auxData"]["isDefault"]:
                self.contexts[context["auxData"]["frameId"]] = context["id"]
        elif method == "Target.attachedToTarget" and hasattr(self, "session"):
            self.sessions[params["targetInfo"]["targetId"]] = params["sessionId"]
            for part in ("Runtime", "Log", "Network"):
                self.send(f"{part}.enable", params["sessionId"])
        elif method == "Target.detachedFromTarget":
            self.sessions = {f: s for f, s in self.sessions.items() if s != params["sessionId"]}
        elif method == "Network.requestWillBeSent":
            url = params["request"]["url"]
            if not url.startswith(("file:", "blob:", "data:", "about:")):
                self.said.append(f"loads {url}")

    def send(self, method, session=None, **params):
        self.count += 1
        message = {"id": self.count, "method": method, "params": params}
        if session or hasattr(self, "session"):
            message["sessionId"] = session or self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        return message

    def call(self, method, session=None, **params):
        message = self.send(method, session, **params)
        until = time.monotonic() + self.seconds
        while time.monotonic() < until:
            answer = self.receive()
            if answer.get("id") == message["id"]:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
        raise RuntimeError(f"{method}: no answer in {self.seconds:g} s")

    def run(self, code, **where):
        """The value of an expression in the page, of a promise when it is kept."""
        answer = self.call("Runtime.evaluate", expression=code, returnByValue=True,
                           awaitPromise=True, **where)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"]["exception"]["description"])
        return answer["result"].get("value")

    def run_in(self, name, code):
        """The same in a frame of the page, by its name."""
        element = self.call("Runtime.evaluate", expression=f"document.getElementsByName('{name}')[0]")
        node = self.call("DOM.describeNode", objectId=element["result"]["objectId"])
        frame = node["node"]["frameId"]
        if frame in self.sessions:
            return self.run(code, session=self.sessions[frame])
        return self.run(code, contextId=self.contexts[frame])

    def wait(self, code, run=None):
        until = time.monotonic() + self.seconds
        while not (value := (run or self.run)(code)):
            if time.monotonic() > until:
                raise RuntimeError(f"never came true: {code}")
            time.sleep(0.1)
        return value

    def wait_in(self, name, code):
        """A frame that is just being loaded has no scripts yet."""
        def run(code):
            try:
                return self.run_in(name, code)
            except (RuntimeError, KeyError):
                return None
        return self.wait(code, run)

    def open(self, path, width, height=900, dark=False, phone=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=2 if phone else 1, mobile=phone)
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
                            {"name": "prefers-reduced-motion", "value": "reduce"}])
        self.call("Page.navigate", url=pathlib.Path(path).resolve().as_uri())
        self.wait("document.documentElement?.dataset.ready")

    def key(self, key, code=None, text=None):
        for kind in ("keyDown", "keyUp"):
            extra = {"text": text} if text and kind == "keyDown" else {}
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=code or key, **extra)

    def point_at(self, x, y, kind="mouseMoved", **extra):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **extra)

    def picture(self, path, whole=True):
        answer = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=whole)
        pathlib.Path(path).write_bytes(base64.b64decode(answer["data"]))
