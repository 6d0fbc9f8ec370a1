"""Counting messages that changed nothing."""

from tlcomm_agent.ignored import Ignored


def test_a_reason_is_told_once() -> None:
    """And counted each time."""
    ignored = Ignored()
    assert [ignored.note(reason) for reason in ("late", "late", "early")] == ["late", None, "early"]
    assert ignored == {"late": 2, "early": 1}


def test_others_cant_make_up_reasons_without_end() -> None:
    """After a hundred, new ones are one; known ones still count by themselves."""
    ignored = Ignored()
    told = [ignored.note(f"a message in the name of {number}") for number in range(150)]
    assert len([reason for reason in told if reason is not None]) == len(ignored) == 101
    assert ignored["further reasons"] == 50
    ignored.note("a message in the name of 7")
    assert ignored["a message in the name of 7"] == 2
