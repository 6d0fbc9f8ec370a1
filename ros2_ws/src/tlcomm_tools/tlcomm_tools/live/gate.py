"""Who is let in, to what.

``Gate``   knows the address that a user was given, and turns everything else away
``Asked``  what a request is for, or why it gets nothing
"""

import secrets
from collections.abc import Sequence
from enum import Enum
from http import HTTPStatus
from typing import Final

__all__ = ["HOST", "Asked", "Gate"]

HOST: Final = "127.0.0.1"
"""Where a view is served: on this machine alone."""

_TOKEN_BYTES: Final = 24


class Asked(Enum):
    """What a request is for: the name below the address."""

    PAGE = ""
    CHARTS = "plotly.min.js"
    FEED = "feed"


class Gate:
    """Lets in who knows the token, and was sent by nobody else.

    A page of another site can send a browser here. It doesn't know the token; and where it makes
    its own name lead here, or opens a feed, the browser says so in ``Host`` and ``Origin``.

    Attributes:
        address: of the page.
    """

    def __init__(self, port: int) -> None:
        """Draw a token.

        Args:
            port: that is served.
        """
        self._host: Final = f"{HOST}:{port}"
        self._origin: Final = f"http://{self._host}"
        self._root: Final = f"/{secrets.token_urlsafe(_TOKEN_BYTES)}/"
        self.address: Final = f"{self._origin}{self._root}"

    def address_of(self, what: Asked) -> str:
        """Return where something is."""
        scheme = "ws" if what is Asked.FEED else "http"
        return f"{scheme}://{self._host}{self._root}{what.value}"

    def admit(
        self, method: str, path: str, hosts: Sequence[str], origins: Sequence[str]
    ) -> Asked | HTTPStatus:
        """Return what a request is for, or the status to refuse it with.

        Args:
            method: of the request.
            path: as requested, with its query.
            hosts: all its headers ``Host``.
            origins: all its headers ``Origin``; a browser always sends one to open a feed.
        """
        if [*hosts] != [self._host]:
            return HTTPStatus.FORBIDDEN
        root, name = path[: len(self._root)], path[len(self._root) :]
        if not secrets.compare_digest(root.encode(), self._root.encode()):
            return HTTPStatus.NOT_FOUND
        if name not in {own.value for own in Asked}:
            return HTTPStatus.NOT_FOUND
        asked = Asked(name)
        if [*origins] != [self._origin] and (origins or asked is Asked.FEED):
            return HTTPStatus.FORBIDDEN
        return asked if method == "GET" else HTTPStatus.METHOD_NOT_ALLOWED
