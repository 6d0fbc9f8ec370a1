"""A ROS domain that nobody else uses, and the environment of a run's processes.

``claim_domain``         a free ROS_DOMAIN_ID, held while the context lasts
``process_environment``  what a run's processes inherit
``player_environment``   what a replay adds to the user's own environment
``LOCALHOST_PROCESSES``  how many processes find each other by ROS's own range LOCALHOST
"""

import fcntl
import os
import socket
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from tlcomm_core.errors import InputError

__all__ = ["LOCALHOST_PROCESSES", "claim_domain", "player_environment", "process_environment"]

LOCALHOST_PROCESSES = 30
_DOMAINS = range(1, 102)
_PORT_BASE = 7400
_PORTS_PER_DOMAIN = 250
_PROBED_PORTS = 24
_RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
_PROFILES = "FASTRTPS_DEFAULT_PROFILES_FILE"
_TRANSPORTS = "FASTDDS_BUILTIN_TRANSPORTS"
_LOOPBACK = Path(__file__).with_name("loopback.xml")
_PROMPT = Path(__file__).with_name("prompt.xml")


@contextmanager
def claim_domain(directory: Path | None = None) -> Iterator[int]:
    """Yield a ROS_DOMAIN_ID in 1..101 that is free on this machine.

    Runs of this project keep apart by a locked file per domain; programs that know nothing of the
    files are found by their UDP ports (the domain's multicast port and first unicast ports).

    Args:
        directory: where the lock files are; by default the system's folder for temporary files.

    Raises:
        InputError: all domains are taken.
    """
    folder = Path(tempfile.gettempdir()) if directory is None else directory
    for domain in _DOMAINS:
        lock = _lock(folder / f"tlcomm-domain-{domain}.lock")
        if lock is None:
            continue
        with lock:
            if _ports_are_free(domain):
                yield domain
                return
    raise InputError(f"no ROS domain from {_DOMAINS[0]} to {_DOMAINS[-1]} is free on this machine")


def process_environment(
    inherited: Mapping[str, str], domain: int, log_folder: Path, processes: int
) -> dict[str, str]:
    """Return the environment for a run's processes.

    Processes stay on this machine, unless the user's own environment says how they find each other:
    by a discovery range or by profiles for the middleware.

    Args:
        inherited: usually ``os.environ``.
        domain: the ROS_DOMAIN_ID.
        log_folder: of the run; rcl's own logs go to ``ros`` in it.
        processes: how many there will be.

    Raises:
        InputError: they are too many for the user's discovery range.
    """
    if inherited.get(_RANGE) == "LOCALHOST" and processes > LOCALHOST_PROCESSES:
        raise InputError(
            f"{processes} processes, but only {LOCALHOST_PROCESSES} find each other with "
            f"{_RANGE}=LOCALHOST: unset it, or set it to SUBNET"
        )
    is_chosen = _RANGE in inherited or _PROFILES in inherited
    discovery = {} if is_chosen else {_RANGE: "SYSTEM_DEFAULT", _PROFILES: str(_LOOPBACK)}
    return {
        **inherited,
        **discovery,
        "ROS_DOMAIN_ID": str(domain),
        "ROS_LOG_DIR": str(log_folder / "ros"),
        "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp",
        # Without shared memory where the range allows it: a killed process would leave segments.
        _TRANSPORTS: "UDPv4",
        # One process computes on one core; the others have agents of their own.
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
        "PYTHONUNBUFFERED": "1",
    }


def player_environment(inherited: Mapping[str, str]) -> dict[str, str]:
    """Return what a replay adds to the user's environment, to be found by the user's own tools.

    Domain, discovery and middleware are the user's. Added is only what the user hasn't chosen: no
    shared memory, of which a killed process would leave segments, and prompt heartbeats.
    """
    added = {_TRANSPORTS: "UDPv4", _PROFILES: str(_PROMPT)}
    return {name: value for name, value in added.items() if name not in inherited}


def _lock(path: Path) -> IO[bytes] | None:
    """Return the open, locked file, or None when another process or user holds it."""
    try:
        fd = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW, 0o666)
    except OSError:
        return None
    file = os.fdopen(fd, "r+b")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        file.close()
        return None
    return file


def _ports_are_free(domain: int) -> bool:
    """Probe the multicast port (+0) and the first participants' unicast ports (+10 …)."""
    first = _PORT_BASE + _PORTS_PER_DOMAIN * domain
    return all(
        _port_is_free(port) for port in (first, *range(first + 10, first + 10 + _PROBED_PORTS))
    )


def _port_is_free(port: int) -> bool:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.bind(("", port))
        except OSError:
            return False
    return True
