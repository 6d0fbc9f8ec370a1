"""Searches for whole team strategies, which the solvers propose.

By a bound    ``bounded_costs`` of places, and the cheapest ``placement`` for them
The optimum   ``exact``, with ``centre_bound`` and ``limits``
Near it       ``coalition``, with ``spanning_tree``, ``tree_programme``, ``reattachment``,
              ``regrouping`` and ``adjustment``
"""
