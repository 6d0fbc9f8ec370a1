"""The meeting game: candidates, initial strategy, best responses, equilibrium.

The round        ``offer``, ``candidates``, ``problem``; what it costs: ``strategy``, ``potential``
Meeting places   ``links`` between them, and the ``rules`` (``resilience``) that they must keep
S⁰               ``initial`` at a ``common_place``; where places must be separate, ``formation``
Best responses   ``best_response``, ``openings``, ``responses``; Algorithm 1: ``algorithm``
Solvers          ``solver``, and what peers propose: ``recognition``
                 what they propose is found in ``search``
To be read       ``rationale`` of a meeting, ``document`` of a round, ``sample`` rounds
"""
