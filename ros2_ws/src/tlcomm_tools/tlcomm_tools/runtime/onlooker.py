"""A live view's process, as the run sees it: somebody who looks on, and whom nothing depends on.

``Onlooker``  the process, from beginning to end
"""

import contextlib
import json
import os
import signal
import subprocess
import threading
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Final, Self

__all__ = ["Onlooker"]

_PATIENCE_S: Final = 6.0


class Onlooker:
    """A process that looks on, as long as the context lasts; what becomes of it is only told.

    It isn't supervised: whether it starts, hangs or dies, the run doesn't notice. Its end is that
    of its standard input, so it doesn't outlive this process either.
    """

    def __init__(
        self,
        command: Sequence[str],
        environment: Mapping[str, str],
        log: Path,
        tell: Callable[[str], None],
    ) -> None:
        """Prepare to start.

        Args:
            command: program and arguments; the first line that it prints is its address.
            environment: of the process.
            log: file for its standard error.
            tell: is told what a user should know, a line at a time, by another thread too.
        """
        self._command: Final = tuple(command)
        self._environment: Final = dict(environment)
        self._log: Final = log
        self._tell: Final = tell
        self._process: subprocess.Popen[str] | None = None
        self._is_over = False
        self._reader = threading.Thread(target=self._read, name="onlooker", daemon=True)

    def __enter__(self) -> Self:
        """Start it, if it can be started."""
        try:
            with self._log.open("wb") as log:
                self._process = subprocess.Popen(
                    self._command,
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=log,
                    env=self._environment,
                    text=True,
                    start_new_session=True,
                )
        except OSError as error:
            self._tell(f"no live view: {error}")
        else:
            self._reader.start()
        return self

    def __exit__(self, *_: object) -> None:
        """End it, the hard way if it takes too long."""
        process = self._process
        if process is None:
            return
        self._is_over = True
        assert process.stdin is not None
        with contextlib.suppress(BrokenPipeError):
            process.stdin.close()
        try:
            process.wait(_PATIENCE_S)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        self._reader.join()
        assert process.stdout is not None
        process.stdout.close()

    def begin(self) -> None:
        """Tell it that all processes of the run have found each other."""
        self._say({"event": "begun"})

    def end(self, verdict: Any) -> None:  # noqa: ANN401 - as the result has it
        """Tell it that the run is over, and what it says of itself."""
        self._say({"event": "over", "verdict": verdict})

    def _say(self, word: Mapping[str, Any]) -> None:
        if self._process is None or self._is_over:
            return
        assert self._process.stdin is not None
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.write(f"{json.dumps(word)}\n")
            self._process.stdin.flush()

    def _read(self) -> None:
        """Tell the address, and of an end that comes too soon."""
        assert self._process is not None
        assert self._process.stdout is not None
        address = self._process.stdout.readline().strip()
        if address:
            self._tell(f"live view at {address}")
        while self._process.stdout.readline():
            pass
        if not self._is_over:
            self._tell(f"the live view has ended, the run goes on; its log: {self._log}")
