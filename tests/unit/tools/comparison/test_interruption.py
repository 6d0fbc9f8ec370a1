"""Ctrl-C where it can be dealt with."""

import signal

import pytest

from tlcomm_tools.comparison.interruption import held_interruption


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_waits_until_it_is_asked_for(number: signal.Signals) -> None:
    """Also a second one; afterwards signals do what they did before."""
    before = signal.getsignal(number)
    with held_interruption() as act:
        act()
        signal.raise_signal(number)
        signal.raise_signal(number)
        with pytest.raises(KeyboardInterrupt):
            act()
    assert signal.getsignal(number) is before
