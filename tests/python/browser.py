"""A headless Chromium, driven by chromedriver's WebDriver protocol with Python's own library."""
import base64
import contextlib
import json
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

CHROMIUM, CHROMEDRIVER = shutil.which("chromium"), shutil.which("chromedriver")
KEYS = {"right": "\ue014", "left": "\ue012", "down": "\ue015", "home": "\ue011", "end": "\ue010", "escape": "\ue00c"}


@contextlib.contextmanager
def opened():
    """A Browser with one window."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    with contextlib.ExitStack() as stack:
        profile = stack.enter_context(tempfile.TemporaryDirectory(prefix="sonarsim-browser-"))
        driver = stack.enter_context(subprocess.Popen([CHROMEDRIVER, f"--port={port}"], stdout=subprocess.DEVNULL,
                                                      stderr=subprocess.DEVNULL))
        stack.callback(driver.terminate)
        window = Browser(f"http://127.0.0.1:{port}")
        until(window.is_ready, "an answer of chromedriver")
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", f"--user-data-dir={profile}",
                   "--window-size=1300,850"]
        window.server += "/session/" + window.send("POST", "/session", {"capabilities": {"alwaysMatch": {
            "goog:chromeOptions": {"binary": CHROMIUM, "args": options}, "goog:loggingPrefs": {"browser": "ALL"}}}})["sessionId"]
        stack.callback(window.send, "DELETE", "")
        yield window


def until(ask, what):
    """What `ask` returns, once it is true."""
    for _ in range(1200):
        if value := ask():
            return value
        time.sleep(0.05)
    raise AssertionError(f"never came: {what}")


class Browser:
    def __init__(self, server):
        self.server = server

    def send(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.server + path, data, method=method, headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(error.read().decode()) from error

    def is_ready(self):
        with contextlib.suppress(OSError):
            return self.send("GET", "/status")

    def open(self, path):
        self.send("POST", "/url", {"url": path.resolve().as_uri()})

    def run(self, script):
        """What the JavaScript returns."""
        return self.send("POST", "/execute/sync", {"script": script, "args": []})

    def press(self, *keys):
        """Keys by their names in KEYS, or single letters."""
        actions = [{"type": kind, "value": KEYS.get(key, key)} for key in keys for kind in ("keyDown", "keyUp")]
        self.send("POST", "/actions", {"actions": [{"type": "key", "id": "keyboard", "actions": actions}]})

    def wait_for(self, script):
        """Until the JavaScript returns something true, which is returned."""
        return until(lambda: self.run(script), script)

    def screenshot(self, selector):
        """What an element of the page looks like, PNG bytes."""
        element = self.send("POST", "/element", {"using": "css selector", "value": selector})
        return base64.b64decode(self.send("GET", f"/element/{next(iter(element.values()))}/screenshot"))

    def complaints(self):
        """Warnings and errors on the console since the last call."""
        entries = self.send("POST", "/se/log", {"type": "browser"})
        return [entry["message"] for entry in entries if entry["level"] in ("WARNING", "SEVERE")]
