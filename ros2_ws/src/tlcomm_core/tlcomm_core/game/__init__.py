"""The meeting game: candidates, initial strategy, best responses, equilibrium.

The round        ``offer``, ``candidates``, ``problem``; what it costs: ``strategy``, ``potential``
Meeting places   ``links`` between them, and the ``rules`` (``resilience``) that they must keep
S⁰               ``initial`` at a ``common_place``; where places must be separate, ``formation``
Best responses   ``best_response``, ``openings``, ``responses``; Algorithm 1: ``algorithm``
Solvers          ``solver``, and what peers propose: ``recognition``
  by a bound     ``bounded_costs`` of places, and the cheapest ``placement`` for them
  the optimum    ``exact``, with ``centre_bound`` and ``limits``
  near it        ``coalition``, with ``spanning_tree``, ``tree_programme``, ``reattachment``,
                 ``regrouping`` and ``adjustment``
To be read       ``rationale`` of a meeting, ``document`` of a round, ``sample`` rounds
"""
