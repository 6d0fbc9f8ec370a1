"""Nodes under test: a ROS domain of their own, and a context per test."""

import os
import warnings
from collections.abc import Iterator

import pytest

from tlcomm_tools.runtime.domain import claim_domain

# The interfaces' generator imports a parser that the standard library warns of.
with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import rosidl_generator_py  # noqa: F401 (for its effect)

from rclpy.context import Context


@pytest.fixture(scope="session")
def domain() -> Iterator[int]:
    """Hold a free ROS domain, kept to this machine and out of shared memory."""
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ["FASTDDS_BUILTIN_TRANSPORTS"] = "UDPv4"
    os.environ["RMW_IMPLEMENTATION"] = "rmw_fastrtps_cpp"
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
