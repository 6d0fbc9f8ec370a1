"""Page and feed, on this machine alone."""

import asyncio
from collections.abc import Awaitable, Callable
from contextlib import ExitStack

import pytest
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.typing import Origin

from tlcomm_tools.live.audience import Audience
from tlcomm_tools.live.gate import Asked, Gate
from tlcomm_tools.live.server import Served, Server

LIMIT_S = 60.0
LARGE = "x" * 1_000_000


class Setting:
    """A server, its audience, and its gate."""

    def __init__(self) -> None:
        """Serve little."""
        self.whole = "whole"
        self.audience = Audience(lambda: self.whole)
        self.gates: list[Gate] = []
        self.server = Server(self._make, self.audience)

    def _make(self, gate: Gate) -> Served:
        self.gates.append(gate)
        return Served(b"page", b"charts")

    @property
    def gate(self) -> Gate:
        """The only gate."""
        (gate,) = self.gates
        return gate

    @property
    def port(self) -> int:
        """Where it listens."""
        return int(self.gate.address.split(":")[2].split("/")[0])

    def feed(self, origin: str = "") -> connect:
        """Open the feed, as the page does unless another origin is given."""
        own = self.gate.address[: self.gate.address.index("/", len("http://"))]
        address = self.gate.address_of(Asked.FEED)
        return connect(
            address, origin=Origin(origin or own), compression=None, max_size=None, proxy=None
        )

    async def ask(self, request: str) -> str:
        """Send a request; return the whole answer."""
        reader, writer = await asyncio.open_connection("127.0.0.1", self.port)
        writer.write(request.encode())
        answer = await reader.read()
        writer.close()
        await writer.wait_closed()
        return answer.decode()

    async def get(self, what: str, host: str = "") -> str:
        """Ask for a path."""
        host = host or f"127.0.0.1:{self.port}"
        return await self.ask(f"GET {what} HTTP/1.1\r\nHost: {host}\r\n\r\n")


def serve(use: Callable[[Setting], Awaitable[None]]) -> None:
    """Use a server until the end."""

    async def run() -> None:
        served = Setting()
        async with asyncio.timeout(LIMIT_S), served.server:
            await use(served)

    asyncio.run(run())


def test_page_and_library_are_served() -> None:
    """With headers that keep other sites and caches away, and the library in the cache."""

    async def use(served: Setting) -> None:
        path = "/" + served.gate.address.split("/", 3)[3]
        page, charts = await served.get(path), await served.get(f"{path}plotly.min.js")
        assert page.startswith("HTTP/1.1 200 OK\r\n")
        assert page.endswith("\r\n\r\npage")
        for line in (
            "Cache-Control: no-store",
            "Content-Security-Policy: frame-ancestors 'none'",
            "Content-Type: text/html; charset=utf-8",
            "Referrer-Policy: no-referrer",
            "X-Content-Type-Options: nosniff",
        ):
            assert f"{line}\r\n" in page
        assert "Content-Type: text/javascript\r\n" in charts
        assert "immutable" in charts
        assert charts.endswith("\r\n\r\ncharts")

    serve(use)


def test_only_this_machine_is_served() -> None:
    """The socket is bound to the loopback interface."""

    async def use(served: Setting) -> None:
        assert served.server._listener is not None
        (bound,) = served.server._listener.sockets
        assert bound.getsockname()[0] == "127.0.0.1"

    serve(use)


def test_strangers_are_refused() -> None:
    """Without token, by another name, or sent by another site."""

    async def use(served: Setting) -> None:
        path = "/" + served.gate.address.split("/", 3)[3]
        assert (await served.get("/")).startswith("HTTP/1.1 404")
        assert (await served.get(path, "evil.example")).startswith("HTTP/1.1 403")
        assert (await served.ask(f"POST {path} HTTP/1.1\r\nHost: x\r\n\r\n")).startswith(
            "HTTP/1.1 403"
        )
        with pytest.raises(InvalidStatus, match="403"):
            await served.feed("http://evil.example")

    serve(use)


def test_nonsense_is_survived() -> None:
    """What isn't HTTP ends a connection, and no more."""

    async def use(served: Setting) -> None:
        assert await served.ask("\x00\x01 nonsense\r\n\r\n") == ""
        path = "/" + served.gate.address.split("/", 3)[3]
        assert (await served.get(path)).endswith("page")

    serve(use)


def test_the_feed_tells_what_is_new() -> None:
    """Everything, then the news; at the end it is closed in good order."""
    texts: list[str | bytes] = []

    async def run() -> None:
        served = Setting()
        async with asyncio.timeout(LIMIT_S):
            async with served.server:
                connection = await served.feed()
                texts.append(await connection.recv())
                served.audience.tell("news")
                texts.append(await connection.recv())
                for _ in range(10):
                    served.audience.tell(LARGE)
                reading = asyncio.create_task(_read(connection))
            texts.extend(await reading)
            assert connection.close_code == 1000

    asyncio.run(run())
    assert texts == ["whole", "news", *[LARGE] * 10]


async def _read(connection: ClientConnection) -> list[str | bytes]:
    return [text async for text in connection]


@pytest.mark.parametrize("word", ["stop", b"\x00" * 100_000])
def test_a_page_that_says_anything_has_to_go(word: str | bytes) -> None:
    """Nothing that it says is heard, however long, and others stay."""

    async def use(served: Setting) -> None:
        async with served.feed() as other, served.feed() as loud:
            await loud.recv()
            await loud.send(word)
            with pytest.raises(ConnectionClosed) as caught:
                await loud.recv()
            assert caught.value.rcvd is not None
            assert caught.value.rcvd.code in {1008, 1009}
            served.audience.tell("news")
            assert [await other.recv(), await other.recv()] == ["whole", "news"]

    serve(use)


def test_a_page_that_stops_reading_holds_nobody_up() -> None:
    """Little waits for it while others get all, and the end doesn't wait for it."""

    async def run() -> None:
        served = Setting()
        served.whole = LARGE
        async with asyncio.timeout(LIMIT_S):
            async with served.server:
                stuck = await open_and_ignore(served)
                async with served.feed() as other:
                    await other.recv()
                    for number in range(30):
                        served.audience.tell(f"{number} {LARGE}")
                        assert str(await other.recv()).startswith(f"{number} ")
                        pages = served.audience._pages
                        assert max(len(page._waiting) for page in pages) <= 20
                    assert [page._is_behind for page in pages].count(True) == 1
            stuck.transport.abort()

    asyncio.run(run())


async def open_and_ignore(served: Setting) -> asyncio.StreamWriter:
    """Open the feed, and read no more than the first line of the answer."""
    reader, writer = await asyncio.open_connection("127.0.0.1", served.port, limit=1000)
    address = served.gate.address_of(Asked.FEED).split("/", 3)
    writer.write(
        f"GET /{address[3]} HTTP/1.1\r\nHost: {address[2]}\r\nOrigin: http://{address[2]}\r\n"
        "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n".encode()
    )
    assert b"101" in await reader.readline()
    return writer


def test_no_more_pages_than_some() -> None:
    """One too many is told so."""

    async def use(served: Setting) -> None:
        with ExitStack() as stack:
            for _ in range(16):
                stack.enter_context(served.audience.page())
            with pytest.raises(InvalidStatus, match="503"):
                await served.feed()

    serve(use)
