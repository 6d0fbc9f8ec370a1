"""Nodes under test: a ROS domain of their own, and a context per test."""

import os
import tempfile
import warnings
from collections.abc import Iterator
from pathlib import Path

import pytest

from tlcomm_tools.runtime.domain import claim_domain, process_environment

# Kept to this machine and out of shared memory, for all that is loaded from here on.
os.environ.update(process_environment({}, 0, Path(tempfile.gettempdir()), 1))

# The interfaces' generator imports a parser that the standard library warns of.
with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import rosidl_generator_py  # noqa: F401 (for its effect)

from rclpy.context import Context


@pytest.fixture(scope="session")
def domain() -> Iterator[int]:
    """Hold a free ROS domain."""
    with claim_domain() as claimed:
        yield claimed


@pytest.fixture
def context(domain: int) -> Iterator[Context]:
    """Own a context, and destroy it."""
    own = Context()
    own.init(args=[], domain_id=domain)
    try:
        yield own
    finally:
        own.try_shutdown()
        own.destroy()
