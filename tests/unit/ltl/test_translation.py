"""Which construction a formula gets."""

import pytest

from tlcomm_core.ltl import Construction, parse, translate

RESTARTED, TABLEAU = Construction.RESTARTED_GOOD_PREFIX, Construction.TABLEAU
COMPOSED = Construction.COMPOSED


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("G F (a & F b)", RESTARTED),
        ("[]<>(a U b)", RESTARTED),
        ("!F G !a", RESTARTED),
        ("!<>!(true U X a)", RESTARTED),
        ("G F !G a", RESTARTED),
        ("G F (a R b)", TABLEAU),
        ("G F G a", TABLEAU),
        ("F a", TABLEAU),
        ("G F a & G F b", COMPOSED),
        ("G F (a & F b) & G !c", COMPOSED),
        ("G (F (a & F b) & !c)", COMPOSED),
        ("F d & !F G (!a | G !b)", COMPOSED),
        ("G F (a R b) & G F G c", TABLEAU),
        ("G F a & G F b & G F c & G F d & G F e", TABLEAU),
        ("G F a & G F b & G F c & G F d & G F e & G F (f & F g)", COMPOSED),
        ("true", TABLEAU),
        ("a -> G F a", TABLEAU),
    ],
)
def test_construction_follows_the_shape(text: str, kind: Construction) -> None:
    """G F of a co-safe formula, however written, is restarted, conjoined ones are composed; all
    else goes to the tableau.
    """
    assert translate(parse(text)).kind is kind
