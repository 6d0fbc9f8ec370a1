"""The pages that are looked at, each with what it hasn't got yet."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import ExitStack

from tlcomm_tools.live.audience import Audience


async def rest(texts: AsyncIterator[str]) -> list[str]:
    """Return all that a page is to get."""
    return [text async for text in texts]


def test_a_page_gets_everything_then_what_is_new() -> None:
    """In order, and after the end there is no more."""

    async def look() -> list[str]:
        audience = Audience(lambda: "whole")
        with audience.page() as page:
            texts = page.texts()
            first = await anext(texts)
            audience.tell("one")
            audience.tell("two")
            audience.end()
            return [first, *await rest(texts)]

    assert asyncio.run(look()) == ["whole", "one", "two"]


def test_a_slow_page_gets_everything_anew() -> None:
    """However much it misses, little waits for it, and at last it knows all."""
    told: list[str] = []

    async def look() -> tuple[int, list[str]]:
        audience = Audience(lambda: " ".join(["whole", *told[-1:]]))
        with audience.page() as page:
            texts = page.texts()
            await anext(texts)
            most = 0
            for number in range(1000):
                told.append(str(number))
                audience.tell(told[-1])
                most = max(most, len(page._waiting))
            audience.end()
            return most, await rest(texts)

    most, texts = asyncio.run(look())
    assert most <= 20
    assert texts == ["whole 999"]


def test_a_page_after_the_end_gets_everything_once() -> None:
    """Who comes late sees how it ended."""

    async def look() -> list[str]:
        audience = Audience(lambda: "whole")
        audience.end()
        with audience.page() as page:
            return await rest(page.texts())

    assert asyncio.run(look()) == ["whole"]


def test_pages_are_few() -> None:
    """Beyond a number there is no room; who goes makes some."""
    audience = Audience(lambda: "")
    with ExitStack() as stack:
        for number in range(16):
            assert not audience.is_full, number
            stack.enter_context(audience.page())
        assert audience.is_full
    assert not audience.is_full
