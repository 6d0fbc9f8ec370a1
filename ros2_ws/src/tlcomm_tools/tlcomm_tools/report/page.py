"""The page round a report's document: markup, style and scripts in one file, nothing from outside.

``render_page``  the page's text
"""

import base64
import hashlib
import json
from collections.abc import Mapping
from html import escape
from importlib.resources import files
from string import Template
from typing import Any, Final

__all__ = ["render_page"]

_ASSETS: Final = files(__package__) / "assets"
_CHARTS: Final = files("plotly").joinpath("package_data", "plotly.min.js")
# In this order: each uses what those before it define.
_PARTS: Final = (
    "elements.js",
    "run.js",
    "playback.js",
    "map.js",
    "agents.js",
    "rounds.js",
    "findings.js",
    "page.js",
)
# What would end a script, begin a comment in it, or end a line of JavaScript, as JSON escapes it.
_ESCAPES: Final = {ord(sign): f"\\u{ord(sign):04x}" for sign in "<>&\u2028\u2029"}


def render_page(document: Mapping[str, Any]) -> str:
    """Return the page of a report's document.

    Nothing in the document can become markup or script: it is data in the page, and the scripts
    put it into the text of elements. Only the page's own scripts run, each known by its hash.

    Cost: some 5 MB of text, nearly all of it the library that draws the charts.
    """
    # First what shows the run, then the library, so that nobody waits for it.
    scripts = (
        "\n".join(["'use strict';", *map(_asset, _PARTS)]),
        _CHARTS.read_text("utf-8"),
        "\n".join(["'use strict';", _asset("charts.js")]),
    )
    run = document["run"]
    return Template(_asset("page.html")).substitute(
        policy=_policy(scripts),
        title=escape(f"{run['scenario']}, method {run['method']}"),
        style=_asset("page.css"),
        data=_json(document),
        scripts="\n".join(f"<script>{script}</script>" for script in scripts),
    )


def _asset(name: str) -> str:
    return _ASSETS.joinpath(name).read_text("utf-8")


def _json(document: Mapping[str, Any]) -> str:
    text = json.dumps(document, allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    return text.translate(_ESCAPES)


def _policy(scripts: tuple[str, ...]) -> str:
    """Return a content security policy: these scripts, styles of the page, nothing else."""
    digests = (hashlib.sha256(script.encode()).digest() for script in scripts)
    hashes = " ".join(f"'sha256-{base64.b64encode(own).decode()}'" for own in digests)
    return "; ".join(
        [
            "default-src 'none'",
            f"script-src {hashes}",
            "style-src 'unsafe-inline'",
            "img-src data: blob:",
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )
