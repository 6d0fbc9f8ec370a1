"""The page round a document: markup, style and scripts in one file, nothing from outside.

``Feed``         where a page that goes on gets from what it doesn't hold itself
``render_page``  the page's text
``read_charts``  the library that draws its charts
"""

import base64
import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from string import Template
from typing import Any, Final

__all__ = ["Feed", "read_charts", "render_page"]

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
    "feed.js",
    "page.js",
)
# What would end a script, begin a comment in it, or end a line of JavaScript, as JSON escapes it.
_ESCAPES: Final = {ord(sign): f"\\u{ord(sign):04x}" for sign in "<>&\u2028\u2029"}


@dataclass(frozen=True, slots=True)
class Feed:
    """Where a page that goes on gets from what it doesn't hold itself.

    Attributes:
        news: a WebSocket's address; what it sends is changes of the document.
        charts: the address of the library that draws the charts.
    """

    news: str
    charts: str


def render_page(document: Mapping[str, Any], feed: Feed | None = None) -> str:
    """Return the page of a document.

    Nothing in the document can become markup or script: it is data in the page, and the scripts
    put it into the text of elements. Only the page's own scripts run, each known by its hash.

    Args:
        document: what the page shows.
        feed: of a run that goes on; without it the page holds everything, and needs nobody.

    Cost: without a feed some 5 MB of text, nearly all of it the library that draws the charts.
    """
    scripts = [
        _script("'use strict';", *map(_asset, _PARTS)),
        # After what shows the run, so that nobody waits for it.
        _script(read_charts()) if feed is None else _loaded(feed.charts),
        _script("'use strict';", _asset("charts.js")),
    ]
    run = document["run"]
    return Template(_asset("page.html")).substitute(
        policy=_policy([own.source for own in scripts], feed),
        title=escape(f"{run['scenario']}, method {run['method']}"),
        style=_asset("page.css"),
        data=_json(document if feed is None else {**document, "feed": feed.news}),
        scripts="\n".join(own.element for own in scripts),
    )


def read_charts() -> str:
    """Return the library that draws the charts."""
    return _CHARTS.read_text("utf-8")


@dataclass(frozen=True, slots=True)
class _Script:
    """A script's element, and what the policy knows it by."""

    element: str
    source: str


def _script(*parts: str) -> _Script:
    text = "\n".join(parts)
    digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
    return _Script(f"<script>{text}</script>", f"'sha256-{digest}'")


def _loaded(address: str) -> _Script:
    return _Script(f'<script src="{escape(address)}"></script>', address)


def _asset(name: str) -> str:
    return _ASSETS.joinpath(name).read_text("utf-8")


def _json(document: Mapping[str, Any]) -> str:
    text = json.dumps(document, allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    return text.translate(_ESCAPES)


def _policy(scripts: Iterable[str], feed: Feed | None) -> str:
    """Return a content security policy: these scripts, styles of the page, the feed's news."""
    return "; ".join(
        [
            "default-src 'none'",
            f"script-src {' '.join(scripts)}",
            "style-src 'unsafe-inline'",
            "img-src data: blob:",
            *([] if feed is None else [f"connect-src {feed.news}"]),
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )
