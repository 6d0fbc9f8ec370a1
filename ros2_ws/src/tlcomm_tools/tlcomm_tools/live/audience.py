"""The pages that are looked at, each with what it hasn't got yet.

``Page``      one of them
``Audience``  all of them
"""

import asyncio
from collections import deque
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import contextmanager
from typing import Final

__all__ = ["Audience", "Page"]

_MOST_PAGES: Final = 16
# A page that is behind by more than this gets everything at once instead.
_MOST_WAITING: Final = 20


class Page:
    """A page, and what it hasn't got yet: never more than a few seconds' news."""

    def __init__(self, whole: Callable[[], str]) -> None:
        """Begin with everything.

        Args:
            whole: makes a text of all that was told so far.
        """
        self._whole: Final = whole
        self._waiting: Final = deque[str]()
        self._is_behind = True
        self._is_over = False
        self._changed: Final = asyncio.Event()
        self._changed.set()

    def offer(self, news: str) -> None:
        """Let the page have some news, sooner or later; or everything, if it is too slow."""
        if len(self._waiting) == _MOST_WAITING:
            self._waiting.clear()
            self._is_behind = True
        if not self._is_behind:
            self._waiting.append(news)
        self._changed.set()

    def end(self) -> None:
        """Say that there will be no more."""
        self._is_over = True
        self._changed.set()

    async def texts(self) -> AsyncIterator[str]:
        """Yield what the page is to get next, until the end."""
        while True:
            await self._changed.wait()
            if self._is_behind:
                self._is_behind = False
                yield self._whole()
            elif self._waiting:
                yield self._waiting.popleft()
            elif self._is_over:
                return
            else:
                self._changed.clear()


class Audience:
    """All pages that are looked at."""

    def __init__(self, whole: Callable[[], str]) -> None:
        """Begin without any.

        Args:
            whole: makes a text of all that was told so far.
        """
        self._whole: Final = whole
        self._pages: Final[set[Page]] = set()
        self._is_over = False

    @property
    def is_full(self) -> bool:
        """Whether there are as many pages as may be."""
        return len(self._pages) >= _MOST_PAGES

    @contextmanager
    def page(self) -> Iterator[Page]:
        """Yield a new page, which is one of the audience while the context lasts."""
        page = Page(self._whole)
        if self._is_over:
            page.end()
        self._pages.add(page)
        try:
            yield page
        finally:
            self._pages.remove(page)

    def tell(self, news: str) -> None:
        """Let all pages have some news; none is waited for."""
        for page in self._pages:
            page.offer(news)

    def end(self) -> None:
        """Say that there will be no more."""
        self._is_over = True
        for page in self._pages:
            page.end()
