"""What a run is judged by, each figure defined once, with its formula; the same for every method.

All are pure functions of a run's records and its scenario.

Links            ``connection``: when the team was connected, and who could hear whom through others
Tasks            ``satisfaction``: makespan, cycle, tasks per hour
Meetings         ``meeting``: detour, wait and additional time; ``coordination``: computing
Effort           ``distance``
"""
