"""Messages and times that nobody thought of."""

import copy
import math

from hypothesis import given, settings
from hypothesis import strategies as st

from support.protocol_states import States
from support.snapshots import snapshot
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.protocol.actions import CountIgnored, HoldStrategy, SendMessage
from tlcomm_core.protocol.messages import BestResponse, Confirmation, Message, PlanOffer
from tlcomm_core.protocol.negotiation import Phase

STATES = States()
PHASES = list(Phase)
DIGEST = next(message.digest for message in STATES.said if isinstance(message, Confirmation))

names = st.sampled_from([*sorted(STATES.meeting.team.members), "stranger", ""])
rounds = st.sampled_from([STATES.meeting.round] * 6 + [STATES.meeting.round - 1, 0, 2**32 - 1])
small = st.integers(-1, 12)
# Finite values stay such that their squares are finite too; the wire's types allow no others here.
numbers = st.floats(-1e6, 1e6) | st.sampled_from([math.nan, math.inf, -math.inf])
offers = st.sampled_from(STATES.meeting.offers).flatmap(
    lambda offer: st.builds(
        type(offer),
        agent=st.just(offer.agent) | names,
        arrival_s=st.just(offer.arrival_s) | numbers,
        x_m=st.just(offer.x_m),
        y_m=st.just(offer.y_m),
        yaw_rad=st.just(offer.yaw_rad),
        linear_mps=st.just(offer.linear_mps),
        angular_radps=st.just(offer.angular_radps),
        stops=st.just(offer.stops) | st.just(()),
    )
)
some_names = st.lists(names, max_size=5).map(tuple)
generated = st.one_of(
    st.builds(PlanOffer, names, rounds, some_names, st.lists(offers, max_size=4).map(tuple)),
    st.builds(
        BestResponse,
        names,
        rounds,
        small,
        small,
        names,
        numbers,
        st.builds(Strategy, names, numbers, numbers, small, numbers, numbers),
    ),
    st.builds(Confirmation, names, rounds, small, st.just(DIGEST) | st.integers(0), some_names),
)
heard = st.lists(generated | st.sampled_from(STATES.said), max_size=12)


@settings(max_examples=200, deadline=None)
@given(state=st.sampled_from(sorted(STATES.negotiations)), messages=heard)
def test_no_sequence_of_messages_breaks_the_state_machine(
    state: str, messages: list[Message]
) -> None:
    """Ignored or accepted, in any order: no exception, no trace of what is ignored, no way back,
    one agreement at the most, and nothing said in another's name.
    """
    negotiation = copy.deepcopy(STATES.negotiations[state])
    held = [negotiation.agreed] if negotiation.agreed else []
    for step, message in enumerate(messages):
        phase, before = negotiation.phase, snapshot(negotiation)
        if actions := negotiation.hear(message):
            assert [type(action) for action in actions] == [CountIgnored]
            assert snapshot(negotiation) == before
        now_s = 1e6 + step
        for action in negotiation.proceed(now_s):
            if isinstance(action, HoldStrategy):
                held.append(action.strategy)
            elif isinstance(action, SendMessage):
                assert action.message.sender == STATES.own
                assert action.message.round == STATES.meeting.round
        assert PHASES.index(negotiation.phase) >= PHASES.index(phase)
        assert negotiation.next_need_s > now_s
        assert len(held) == (negotiation.phase is Phase.AGREED)
