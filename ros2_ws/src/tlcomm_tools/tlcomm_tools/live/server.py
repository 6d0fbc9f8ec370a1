"""Page and feed, on this machine alone.

``Served``  a page's text, and the library that draws its charts
``Server``  serves them, and tells all pages what is new
"""

import asyncio
import logging
import socket
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from email.utils import formatdate
from http import HTTPStatus
from typing import Final, Self

from websockets.asyncio.server import Server as Listener
from websockets.asyncio.server import ServerConnection, serve
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode
from websockets.http11 import Request, Response

from tlcomm_tools.live.audience import Audience, Page
from tlcomm_tools.live.gate import HOST, Asked, Gate

__all__ = ["Served", "Server"]

# A page has nothing to say.
_MOST_BYTES_HEARD: Final = 125
_CLOSING_S: Final = 0.5
# How long the end waits for pages to take what is left.
_FAREWELL_S: Final = 2.0
_HEADERS: Final = {
    "Connection": "close",
    "Content-Security-Policy": "frame-ancestors 'none'",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    # The address is the key; no other site is to learn it.
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
_LOG: Final = logging.getLogger("tlcomm.live")


@dataclass(frozen=True, slots=True)
class Served:
    """What is served beside the feed.

    Attributes:
        page: its text.
        charts: the library that draws its charts.
    """

    page: bytes
    charts: bytes


class Server:
    """Serves a page and its feed, as long as the context lasts."""

    def __init__(self, make: Callable[[Gate], Served], audience: Audience) -> None:
        """Take a free port.

        Args:
            make: makes what is served at an address.
            audience: whom the feed goes to.

        Raises:
            OSError: there is no port.
        """
        self._socket: Final = socket.create_server((HOST, 0))
        self._gate: Final = Gate(self._socket.getsockname()[1])
        self._served: Final = make(self._gate)
        self._audience: Final = audience
        self._feeds: Final[dict[asyncio.Task[None], ServerConnection]] = {}
        self._listener: Listener | None = None

    @property
    def address(self) -> str:
        """Where the page is."""
        return self._gate.address

    async def __aenter__(self) -> Self:
        self._listener = await serve(
            self._feed,
            sock=self._socket,
            process_request=self._answer,
            compression=None,
            server_header=None,
            max_size=_MOST_BYTES_HEARD,
            close_timeout=_CLOSING_S,
            # A page in the background may sleep for long, and goes on then.
            ping_interval=None,
            logger=_LOG,
        )
        return self

    async def __aexit__(self, *_: object) -> None:
        """Let the pages take what is left, if they do so soon, and close."""
        assert self._listener is not None
        self._audience.end()
        if self._feeds:
            await asyncio.wait(self._feeds, timeout=_FAREWELL_S)
        for connection in self._feeds.values():
            connection.transport.abort()
        self._listener.close()
        await self._listener.wait_closed()

    def _answer(self, _: ServerConnection, request: Request) -> Response | None:
        """Return the answer to a request; ``None`` opens the feed."""
        headers = request.headers
        asked = self._gate.admit(
            request.method, request.path, headers.get_all("Host"), headers.get_all("Origin")
        )
        match asked:
            case HTTPStatus():
                return _response(asked, asked.phrase.encode(), "text/plain", "no-store")
            case Asked.PAGE:
                page = self._served.page
                return _response(HTTPStatus.OK, page, "text/html; charset=utf-8", "no-store")
            case Asked.CHARTS:
                kept = "private, max-age=86400, immutable"
                return _response(HTTPStatus.OK, self._served.charts, "text/javascript", kept)
            case Asked.FEED if self._audience.is_full:
                busy = HTTPStatus.SERVICE_UNAVAILABLE
                return _response(busy, b"too many pages", "text/plain", "no-store")
            case Asked.FEED:
                return None

    async def _feed(self, connection: ServerConnection) -> None:
        """Feed a page until it goes, says anything, or there is no more."""
        with self._audience.page() as page:
            feeding = asyncio.create_task(_send(page, connection))
            hearing = asyncio.create_task(_hear(connection))
            self._feeds[feeding] = connection
            try:
                await asyncio.wait((feeding, hearing), return_when=asyncio.FIRST_COMPLETED)
            finally:
                for task in (feeding, hearing):
                    task.cancel()
                del self._feeds[feeding]


async def _send(page: Page, connection: ServerConnection) -> None:
    with suppress(ConnectionClosed):
        async for text in page.texts():
            await connection.send(text)
        await connection.close()


async def _hear(connection: ServerConnection) -> None:
    """Wait for the connection's end; whoever says something has to go."""
    with suppress(ConnectionClosed):
        await connection.recv()
        await connection.close(CloseCode.POLICY_VIOLATION, "a page only listens")


def _response(status: HTTPStatus, body: bytes, kind: str, kept: str) -> Response:
    headers = Headers(
        {
            "Date": formatdate(usegmt=True),
            "Content-Type": kind,
            "Content-Length": str(len(body)),
            "Cache-Control": kept,
            **_HEADERS,
        }
    )
    return Response(status.value, status.phrase, headers, body)
