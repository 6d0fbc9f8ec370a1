"""Processes of runs, by their command lines.

``processes_of``  those of one run
"""

from pathlib import Path

__all__ = ["processes_of"]


def processes_of(folder: Path, role: str = "") -> list[int]:
    """Return the processes of the run in a folder that live; zombies have no command line.

    Args:
        folder: what the run was told to write to.
        role: words of the command line, with a space between.
    """
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            line = path.read_bytes().replace(b"\0", b" ")
        except (FileNotFoundError, ProcessLookupError):
            continue
        if str(folder).encode() in line and role.encode() in line:
            found.append(int(path.parent.name))
    return found
