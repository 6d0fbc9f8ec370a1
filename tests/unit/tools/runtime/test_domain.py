"""Choosing a free ROS domain, and the processes' environment."""

import socket
import subprocess
import sys
from pathlib import Path

import pytest

from tlcomm_core.errors import InputError
from tlcomm_tools.runtime.domain import (
    claim_domain,
    player_environment,
    process_environment,
)


def test_two_claims_differ(tmp_path: Path) -> None:
    """Two runs at a time get two domains, and a domain given back is given out again."""
    with claim_domain(tmp_path) as first:
        with claim_domain(tmp_path) as second:
            assert first != second
        with claim_domain(tmp_path) as again:
            assert again == second


def test_claim_of_another_process_counts(tmp_path: Path) -> None:
    """A domain held by another process is not given out while that process lives."""
    program = f"""
from pathlib import Path
from tlcomm_tools.runtime.domain import claim_domain
with claim_domain(Path({str(tmp_path)!r})) as domain:
    print(domain, flush=True)
    input()
"""
    with subprocess.Popen(
        [sys.executable, "-c", f"import sys; sys.path[:0] = {sys.path!r}\n{program}"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as other:
        assert other.stdin is not None
        assert other.stdout is not None
        held = int(other.stdout.readline())
        with claim_domain(tmp_path) as own:
            assert own != held
        other.stdin.write("\n")


@pytest.mark.parametrize("offset", [0, 10, 33])
def test_domain_in_use_by_others_is_left_alone(tmp_path: Path, offset: int) -> None:
    """A domain whose multicast or participant port is bound by a stranger is passed over."""
    with claim_domain(tmp_path) as free:
        pass
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
        stranger.bind(("", 7400 + 250 * free + offset))
        with claim_domain(tmp_path) as domain:
            assert domain != free


def test_unusable_folder_is_an_input_error(tmp_path: Path) -> None:
    """Where no lock file can be made, no domain is free."""
    with pytest.raises(InputError, match="no ROS domain"), claim_domain(tmp_path / "missing"):
        pass


def test_environment_keeps_processes_on_this_machine(tmp_path: Path) -> None:
    """By default discovery stays on this machine, and nothing goes through shared memory."""
    environment = process_environment({"PATH": "/bin"}, 42, tmp_path, 10)
    assert environment["PATH"] == "/bin"
    assert environment["ROS_DOMAIN_ID"] == "42"
    assert environment["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "SYSTEM_DEFAULT"
    profiles = Path(environment["FASTRTPS_DEFAULT_PROFILES_FILE"]).read_text(encoding="utf-8")
    assert "<address>127.0.0.1</address>" in profiles
    assert environment["FASTDDS_BUILTIN_TRANSPORTS"] == "UDPv4"
    assert environment["ROS_LOG_DIR"] == str(tmp_path / "ros")


@pytest.mark.parametrize(
    "chosen",
    [
        {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"},
        {"FASTRTPS_DEFAULT_PROFILES_FILE": "/etc/fleet.xml"},
    ],
)
def test_the_users_own_way_of_discovery_stays(tmp_path: Path, chosen: dict[str, str]) -> None:
    """Who says how processes find each other is not overruled."""
    environment = process_environment(chosen, 1, tmp_path, 31)
    for variable in ("ROS_AUTOMATIC_DISCOVERY_RANGE", "FASTRTPS_DEFAULT_PROFILES_FILE"):
        assert environment.get(variable) == chosen.get(variable)


def test_too_many_processes_for_the_range_localhost(tmp_path: Path) -> None:
    """More processes than ROS's own local discovery carries are refused, if that was chosen."""
    with pytest.raises(InputError, match="31 processes"):
        process_environment({"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}, 1, tmp_path, 31)
    process_environment({}, 1, tmp_path, 31)


def test_a_replay_is_where_the_users_tools_are() -> None:
    """Domain and discovery are left alone; what the user has chosen of the rest is, too."""
    added = player_environment({"ROS_DOMAIN_ID": "7"})
    assert added.keys() == {"FASTDDS_BUILTIN_TRANSPORTS", "FASTRTPS_DEFAULT_PROFILES_FILE"}
    assert Path(added["FASTRTPS_DEFAULT_PROFILES_FILE"]).is_file()
    chosen = {"FASTRTPS_DEFAULT_PROFILES_FILE": "mine.xml"}
    assert player_environment(chosen).keys() == {"FASTDDS_BUILTIN_TRANSPORTS"}
