"""The workers of a Dask cluster, on as many machines as it has.

``remote_workers``  those of its scheduler
"""

import asyncio
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import Final
from urllib.parse import urlsplit

from tlcomm_core.errors import InputError

__all__ = ["remote_workers"]

_ANSWER_S: Final = 5
_SCHEME: Final = "tcp"
_ADDRESS: Final = "that of a Dask scheduler, such as tcp://HOST:8786"


@contextmanager
def remote_workers(address: str) -> Iterator[Executor]:
    """Give the workers of a Dask cluster; what they haven't begun is cancelled on an error.

    Args:
        address: of its scheduler.

    Raises:
        InputError: Dask isn't installed, or no scheduler with workers answers at the address.
    """
    try:
        from distributed import Client  # noqa: PLC0415 (an extra)
        from distributed.comm import connect  # noqa: PLC0415
    except ImportError:
        raise InputError(
            "--scheduler: Dask isn't installed; 'scripts/dask --version' installs it"
        ) from None
    _check(address)

    async def knock() -> None:
        comm = await connect(address, timeout=_ANSWER_S)
        await comm.close()

    try:
        # A client that finds nobody takes long to give up, and does so loudly.
        asyncio.run(knock())
    except (OSError, MemoryError) as error:  # taken for a length, another protocol is too much
        raise InputError(
            f"--scheduler: no Dask scheduler answers at {address!r} within {_ANSWER_S} s; expected"
            f" {_ADDRESS}"
        ) from error
    with Client(address, timeout=_ANSWER_S, set_as_default=False) as client:
        if not client.scheduler_info()["workers"]:
            raise InputError(
                f"--scheduler: the one at {address!r} has no workers; start some with"
                f" 'scripts/dask worker {address}'"
            )
        executor = client.get_executor(pure=False)
        try:
            yield executor
        finally:
            executor.shutdown(wait=False)


def _check(address: str) -> None:
    """Refuse what is no address; Dask itself would look for it in vain."""
    try:
        parts = urlsplit(address)
        is_fine = parts.scheme == _SCHEME and bool(parts.hostname) and parts.port is not None
    except ValueError:
        is_fine = False
    if not is_fine:
        raise InputError(f"--scheduler: {address!r} isn't an address; expected {_ADDRESS}")
