"""Figures of runs and of comparisons, from values that are small enough to be kept and sent.

``trace``    one run, as much of it as is drawn
``courses``  how the cost came down in its first rounds
``gallery``  all figures of a run, of several methods, of a sweep

Only what draws imports matplotlib; what makes a trace starts without it.
"""
