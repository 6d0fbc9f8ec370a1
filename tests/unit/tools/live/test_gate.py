"""Who is let in, to what."""

from http import HTTPStatus

import pytest

from tlcomm_tools.live.gate import Asked, Gate

PORT = 4242
HERE, ORIGIN = f"127.0.0.1:{PORT}", f"http://127.0.0.1:{PORT}"


def path_of(gate: Gate, what: Asked) -> str:
    """Return the path of something behind a gate."""
    return gate.address.removeprefix(ORIGIN) + what.value


@pytest.mark.parametrize("what", [*Asked])
def test_the_address_lets_in(what: Asked) -> None:
    """Page, library and feed are below it, as a browser asks for them."""
    gate = Gate(PORT)
    origins = [ORIGIN] if what is Asked.FEED else []
    assert gate.admit("GET", path_of(gate, what), [HERE], origins) is what
    assert gate.address_of(what).split("://")[1] == HERE + path_of(gate, what)


def test_each_view_has_a_token_of_its_own() -> None:
    """It is long, and another view's is no use."""
    one, other = Gate(PORT), Gate(PORT)
    assert one.address != other.address
    assert len(one.address.removeprefix(f"{ORIGIN}/").strip("/")) >= 32
    assert one.admit("GET", path_of(other, Asked.PAGE), [HERE], []) is HTTPStatus.NOT_FOUND


@pytest.mark.parametrize("path", ["/", "", "/favicon.ico", "/x/feed", "//", "/é/", "/../"])
def test_without_the_token_there_is_nothing(path: str) -> None:
    """Nothing tells whether there is anything."""
    assert Gate(PORT).admit("GET", path, [HERE], []) is HTTPStatus.NOT_FOUND


@pytest.mark.parametrize("more", ["x", "?", "?x=1", "feed/", "../", "%66eed"])
def test_below_the_token_is_nothing_else(more: str) -> None:
    """Only the three names are known."""
    gate = Gate(PORT)
    path = path_of(gate, Asked.PAGE) + more
    assert gate.admit("GET", path, [HERE], [ORIGIN]) is HTTPStatus.NOT_FOUND


@pytest.mark.parametrize(
    "hosts", [[], ["evil.example"], [f"localhost:{PORT}"], ["127.0.0.1"], [HERE, "evil.example"]]
)
@pytest.mark.parametrize("what", [*Asked])
def test_another_name_that_leads_here_is_refused(hosts: list[str], what: Asked) -> None:
    """A site whose name was made to lead here gets nothing, with the token or without."""
    gate = Gate(PORT)
    refused = gate.admit("GET", path_of(gate, what), hosts, [ORIGIN])
    assert refused is HTTPStatus.FORBIDDEN
    assert gate.admit("GET", "/", hosts, []) is HTTPStatus.FORBIDDEN


@pytest.mark.parametrize("origins", [[], ["http://evil.example"], ["null"], [ORIGIN, "null"]])
def test_a_page_of_another_site_opens_no_feed(origins: list[str]) -> None:
    """Whoever opens one says where it comes from, and that is here."""
    gate = Gate(PORT)
    assert gate.admit("GET", path_of(gate, Asked.FEED), [HERE], origins) is HTTPStatus.FORBIDDEN


def test_nothing_can_be_sent_here() -> None:
    """Only GET is answered."""
    gate = Gate(PORT)
    refused = gate.admit("POST", path_of(gate, Asked.PAGE), [HERE], [])
    assert refused is HTTPStatus.METHOD_NOT_ALLOWED
