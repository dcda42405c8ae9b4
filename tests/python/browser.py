"""A headless Chromium, driven by chromedriver's WebDriver protocol with Python's own library."""
import base64
import json
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

CHROMIUM = shutil.which("chromium")
CHROMEDRIVER = shutil.which("chromedriver")
KEYS = {"right": "\ue014", "left": "\ue012", "up": "\ue013", "down": "\ue015", "home": "\ue011",
        "end": "\ue010", "escape": "\ue00c"}


def available():
    return bool(CHROMIUM and CHROMEDRIVER)


class Browser:
    """One window. Use with `with`."""

    def __init__(self, width=1300, height=850):
        self.profile = tempfile.TemporaryDirectory(prefix="sonarsim-browser-")
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.server = f"http://127.0.0.1:{port}"
        self.driver = subprocess.Popen([CHROMEDRIVER, f"--port={port}"], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
        self.session = None
        try:
            self._wait_for_driver()
            options = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                       f"--user-data-dir={self.profile.name}", f"--window-size={width},{height}"]
            answer = self._send("POST", "/session", {"capabilities": {"alwaysMatch": {
                "goog:chromeOptions": {"binary": CHROMIUM, "args": options},
                "goog:loggingPrefs": {"browser": "ALL"}}}})
            self.session = f"/session/{answer['sessionId']}"
        except BaseException:
            self.__exit__()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.session:
            self._send("DELETE", self.session)
        self.driver.terminate()
        self.driver.wait(timeout=30)
        self.profile.cleanup()

    def _send(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.server + path, data, method=method,
                                         headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(error.read().decode()) from error

    def _wait_for_driver(self):
        for _ in range(600):
            try:
                self._send("GET", "/status")
                return
            except OSError:
                time.sleep(0.1)
        raise RuntimeError("chromedriver does not answer")

    def open(self, path):
        self._send("POST", f"{self.session}/url", {"url": path.resolve().as_uri()})

    def run(self, script):
        """What the JavaScript returns."""
        return self._send("POST", f"{self.session}/execute/sync", {"script": script, "args": []})

    def press(self, *keys):
        """Keys by their names in KEYS, or single letters."""
        actions = [{"type": kind, "value": KEYS.get(key, key)}
                   for key in keys for kind in ("keyDown", "keyUp")]
        self._send("POST", f"{self.session}/actions",
                   {"actions": [{"type": "key", "id": "keyboard", "actions": actions}]})

    def wait_for(self, script):
        """Until the JavaScript returns something true, which is returned."""
        return self._until(lambda: self.run(script), script)

    def wait_for_complaint(self):
        """The warnings and errors on the console, once there is one."""
        return "\n".join(self._until(self.complaints, "a warning on the console"))

    @staticmethod
    def _until(ask, what):
        for _ in range(600):
            if value := ask():
                return value
            time.sleep(0.05)
        raise AssertionError(f"never came: {what}")

    def screenshot(self, selector):
        """What an element of the page looks like, PNG bytes."""
        element = self._send("POST", f"{self.session}/element",
                             {"using": "css selector", "value": selector})
        return base64.b64decode(self._send(
            "GET", f"{self.session}/element/{next(iter(element.values()))}/screenshot"))

    def complaints(self):
        """Warnings and errors on the console since the last call."""
        entries = self._send("POST", f"{self.session}/se/log", {"type": "browser"})
        return [entry["message"] for entry in entries if entry["level"] in ("WARNING", "SEVERE")]
