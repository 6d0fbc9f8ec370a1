"""What a run is judged by, each figure defined once, with its formula; the same for every method.

All are pure functions of a run's records and its scenario.

Tasks        ``satisfaction``: makespan, cycle, tasks per hour
Meetings     ``meeting``: detour, wait and additional time; ``coordination``: computing
Work         ``lost_time``: what isn't an agent's own work, also without meetings; ``distance``
Links        ``connection``: when the team was connected; ``information_age``
Estimates    ``deviation`` from the field
Together     ``summary``: by their names; ``run``: from a run's records
"""
