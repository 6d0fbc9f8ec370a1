"""Every phase hears every kind of message, sound or not, from anybody."""

import copy
import math
from collections.abc import Iterator
from dataclasses import replace

import pytest

from support.protocol_states import States
from support.snapshots import snapshot
from tlcomm_core.protocol.actions import CountIgnored
from tlcomm_core.protocol.messages import BestResponse, Confirmation, Message, PlanOffer
from tlcomm_core.protocol.negotiation import Negotiation, Phase
from tlcomm_core.protocol.reception import Reception

STATES = States()
PHASES = list(Phase)
REASONS = {reception.value for reception in Reception} - {"accepted"}
LATER_S = 1e6


def spoilt_offers(message: PlanOffer) -> Iterator[tuple[str, Message]]:
    """Yield what may be wrong with offers."""
    doubled = (*message.offers, *(replace(offer, x_m=-9.0) for offer in message.offers[:1]))
    yield "known stranger", replace(message, known=("stranger",))
    yield "knows nothing", replace(message, known=(), offers=())
    yield "doubled", replace(message, offers=doubled)
    for offer in message.offers[:1]:
        yield "no stops", replace(message, offers=(replace(offer, stops=()),))
        yield "elsewhere", replace(message, offers=(replace(offer, x_m=offer.x_m + 0.1),))
        yield "nowhere", replace(message, offers=(replace(offer, x_m=math.nan),))
        yield "of a stranger", replace(message, offers=(replace(offer, agent="stranger"),))


def spoilt_response(message: BestResponse) -> Iterator[tuple[str, Message]]:
    """Yield what may be wrong with a best response."""
    for hop in (-1, message.hop + 1, 99):
        yield f"hop {hop}", replace(message, hop=hop)
    for iteration in (-1, message.iteration - 1, message.iteration + 1, 10**9):
        yield f"iteration {iteration}", replace(message, iteration=iteration)
    for change_s in (math.nan, -math.inf, 1.0, -1e-6, -1e9):
        yield f"change {change_s}", replace(message, change_s=change_s)
    for agent in ("stranger", STATES.own, STATES.beyond):
        strategy = replace(message.strategy, agent=agent)
        yield f"for {agent}", replace(message, candidate=agent, strategy=strategy)
        yield f"strategy of {agent}", replace(message, strategy=strategy)
    for arrival_s in (math.nan, math.inf, 1e9):
        strategy = replace(message.strategy, arrival_s=arrival_s)
        yield f"there at {arrival_s}", replace(message, strategy=strategy)
    yield "nowhere", replace(message, strategy=replace(message.strategy, x_m=math.nan))


def spoilt_confirmation(message: Confirmation) -> Iterator[tuple[str, Message]]:
    """Yield what may be wrong with a confirmation."""
    yield "other digest", replace(message, digest=message.digest ^ 1)
    yield "other iteration", replace(message, iteration=message.iteration + 1)
    yield "of a stranger", replace(message, confirmed=("stranger",))
    yield "of nobody", replace(message, confirmed=())


def variants(message: Message) -> Iterator[tuple[str, Message]]:
    """Yield a message as it is and spoilt, of all rounds and senders."""
    yield "sound", message
    match message:
        case PlanOffer():
            yield from spoilt_offers(message)
        case BestResponse():
            yield from spoilt_response(message)
        case Confirmation():
            yield from spoilt_confirmation(message)
    for round_ in (-1, message.round - 1, message.round + 1):
        yield f"round {round_}", replace(message, round=round_)
    for sender in (*STATES.beside, STATES.beyond, STATES.own, "stranger", ""):
        if sender != message.sender:
            yield f"from {sender!r}", replace(message, sender=sender)


def hear(negotiation: Negotiation, message: Message) -> str:
    """Let it hear; return the reason of ignoring it, or ``accepted``, checked for its effect."""
    phase, agreed, before = negotiation.phase, negotiation.agreed, snapshot(negotiation)
    actions = negotiation.hear(message)
    assert negotiation.phase is phase
    assert negotiation.agreed is agreed
    if not actions:
        return "accepted"
    (action,) = actions
    assert isinstance(action, CountIgnored)
    assert action.reason in REASONS
    assert snapshot(negotiation) == before
    return action.reason


def test_all_states_are_there() -> None:
    """Each phase is passed through, to the end."""
    names = {state.split()[1] for state in STATES.negotiations}
    assert names == {*(phase.value for phase in PHASES), "settled"}


@pytest.mark.parametrize("state", sorted(STATES.negotiations))
def test_any_message_is_taken_in_or_ignored(state: str) -> None:
    """Nothing raises; what is ignored leaves no trace; what is accepted leads on, never back."""
    fresh = STATES.negotiations[state]
    negotiation = copy.deepcopy(fresh)
    counted = 0
    for message in STATES.said:
        for name, variant in variants(message):
            reason = hear(negotiation, variant)
            counted += 1
            if name in ("round -1", f"round {message.round - 1}"):
                assert reason in ("late", "foreign")
            if name in ("from ''", "from 'stranger'", f"from {STATES.own!r}"):
                assert reason == "foreign"
            if reason == "accepted":
                negotiation.proceed(LATER_S)
                assert PHASES.index(negotiation.phase) >= PHASES.index(fresh.phase)
                assert (negotiation.agreed is not None) is (negotiation.phase is Phase.AGREED)
                negotiation = copy.deepcopy(fresh)
    assert counted > 500


# What becomes of a sound message that a neighbour really said, by the state that hears it. Offers
# and confirmations are answered where the sender may lack something.
_TABLE = {
    ("gathering", PlanOffer): {"accepted", "duplicate"},
    ("gathering", BestResponse): {"accepted", "duplicate"},
    ("gathering", Confirmation): {"accepted", "duplicate"},
    ("improving", PlanOffer): {"accepted", "duplicate"},
    ("improving", BestResponse): {"accepted", "late", "duplicate", "early"},
    ("improving", Confirmation): {"accepted", "duplicate"},
    ("confirming", PlanOffer): {"duplicate"},
    ("confirming", BestResponse): {"late"},
    ("confirming", Confirmation): {"accepted", "duplicate"},
    ("agreed", PlanOffer): {"duplicate"},
    ("agreed", BestResponse): {"late"},
    ("agreed", Confirmation): {"accepted", "duplicate"},
    ("settled", PlanOffer): {"duplicate"},
    ("settled", BestResponse): {"accepted"},
    ("settled", Confirmation): {"duplicate"},
}


@pytest.mark.parametrize("state", sorted(STATES.negotiations))
@pytest.mark.parametrize("kind", [PlanOffer, BestResponse, Confirmation])
def test_a_neighbours_true_word_has_its_place(state: str, kind: type[Message]) -> None:
    """What is accepted, late, early or a duplicate in which phase is as the table says."""
    fresh = STATES.negotiations[state]
    reasons = set()
    for message in STATES.said:
        if isinstance(message, kind) and message.sender in STATES.beside:
            reasons.add(hear(copy.deepcopy(fresh), message))
    assert reasons
    assert reasons <= _TABLE[state.split()[1], kind]
