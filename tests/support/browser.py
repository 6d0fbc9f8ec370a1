"""A headless Chromium, driven through its own driver by WebDriver's HTTP and JSON.

``Browser``      one window; a context manager
``why_missing``  why there is none on this machine, or ""
"""

import base64
import json
import re
import shutil
import time
from collections.abc import Mapping
from pathlib import Path
from subprocess import PIPE, STDOUT, Popen
from typing import Any, Final, Self
from urllib.request import Request, urlopen

__all__ = ["Browser", "why_missing"]

_PROGRAMS: Final = ("chromium", "chromedriver")
_ELEMENT: Final = "element-6066-11e4-a52e-4f735466cecf"
_LIMIT_S: Final = 60.0


def why_missing() -> str:
    """Return why no browser can be driven here, or ""."""
    missing = [name for name in _PROGRAMS if shutil.which(name) is None]
    return f"{' and '.join(missing)} not installed" if missing else ""


class Browser:
    """One window of a headless Chromium.

    Args:
        size: width and height of the window (px).
        dark: whether the user prefers dark.
    """

    def __init__(self, size: tuple[int, int], *, dark: bool = False) -> None:
        self._driver = Popen(["chromedriver", "--port=0"], stdout=PIPE, stderr=STDOUT, text=True)
        self._base = f"http://127.0.0.1:{self._read_port()}"
        switches = [
            "--headless=new",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
            f"--window-size={size[0]},{size[1]}",
            *(["--force-dark-mode"] if dark else []),
        ]
        wanted = {
            "goog:chromeOptions": {"args": switches, "binary": shutil.which("chromium")},
            "goog:loggingPrefs": {"browser": "ALL"},
        }
        session = self._ask("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
        self._base += f"/session/{session['sessionId']}"
        # Chromium's windows are never narrower than 500 px; a phone is emulated.
        metrics = {"width": size[0], "height": size[1], "deviceScaleFactor": 1, "mobile": False}
        self._command("Emulation.setDeviceMetricsOverride", metrics)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self._command("Emulation.setEmulatedMedia", {"features": [scheme]})

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        try:
            self._ask("DELETE", "")
        finally:
            self._driver.terminate()
            self._driver.wait()
            assert self._driver.stdout is not None
            self._driver.stdout.close()

    def open(self, address: str) -> None:
        """Load a page."""
        self._ask("POST", "/url", {"url": address})

    def evaluate(self, expression: str) -> Any:  # noqa: ANN401 - any JSON
        """Return the value of an expression in the page."""
        script = {"script": f"return {expression}", "args": []}
        return self._ask("POST", "/execute/sync", script)

    def text(self, selector: str) -> str:
        """Return the text of the first element of a CSS selector, as it is rendered."""
        return str(self._ask("GET", f"/element/{self._find(selector)}/text"))

    def click(self, selector: str) -> None:
        """Click into the middle of an element."""
        self._ask("POST", f"/element/{self._find(selector)}/click", {})

    def press(self, selector: str, keys: str) -> None:
        """Press keys with an element in focus."""
        self._ask("POST", f"/element/{self._find(selector)}/value", {"text": keys})

    def wait_for(self, expression: str) -> None:
        """Wait until an expression in the page is true."""
        limit_s = time.monotonic() + _LIMIT_S
        while not self.evaluate(f"Boolean({expression})"):
            assert time.monotonic() < limit_s, f"{expression} never became true"

    def complaints(self) -> list[str]:
        """Return what the console has shown since the last time."""
        return [own["message"] for own in self._ask("POST", "/se/log", {"type": "browser"})]

    def save_screenshot(self, path: Path) -> None:
        """Write what is seen, as PNG."""
        path.write_bytes(base64.b64decode(self._ask("GET", "/screenshot")))

    def _find(self, selector: str) -> str:
        found = self._ask("POST", "/element", {"using": "css selector", "value": selector})
        return str(found[_ELEMENT])

    def _command(self, name: str, parameters: Mapping[str, Any]) -> None:
        self._ask("POST", "/goog/cdp/execute", {"cmd": name, "params": parameters})

    def _read_port(self) -> int:
        assert self._driver.stdout is not None
        for line in self._driver.stdout:
            if found := re.search(r"started successfully on port (\d+)", line):
                return int(found[1])
        raise AssertionError("chromedriver doesn't start")

    def _ask(self, verb: str, path: str, body: Mapping[str, Any] | None = None) -> Any:  # noqa: ANN401
        data = None if body is None else json.dumps(body).encode()
        headers = {"Content-Type": "application/json"}
        # Both are of our own driver.
        request = Request(self._base + path, data, headers, method=verb)  # noqa: S310
        with urlopen(request, timeout=_LIMIT_S) as answer:  # noqa: S310
            return json.load(answer)["value"]
