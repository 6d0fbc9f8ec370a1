"""The independent audit of a run: from its records alone, as a bag or memory holds them.

``evidence``    the records, and what follows from them
``tracks``      where each agent was, from its odometry
``links``       when the whole team was connected, from the tracks
``words``       what each agent's steps made true, from the events and tracks
``formula``     formulas read and evaluated on finite words
``progress``    what a word says of a task: the runtime monitor's verdict
``tasks``       each task's verdict and satisfactions
``trespass``    whether agents kept out of what their tasks forbid
``membership``  what is of nobody whom the scenario names, and is left out
``finiteness``  what isn't a number, and is left out
``motion``      whether agents drove as they can: no faster, and without jumps
``clearance``   whether agents kept clear of obstacles, which may come and go
``actions``     whether actions were done where they claim, and for as long as they take
``conditions``  whether actions had what they need first
``guarantees``  whether the method of coordination kept its promises
``agreements``  who agrees on what
``strategies``  whether those who agree hold the same strategies
``plans``       whether their meetings are connected, in their windows and to be had in time
``meetings``    whether their places are as the scenario demands
``equilibria``  whether anybody could have gained alone, by the plans that were laid open
``proximity``   whether two agents were in range and sight of each other at given times
``hearing``     whether agents heard only what was said, by somebody in range, and not before
``findings``    all of it as one document: ``audit_run`` is the way in

It shares no code with planner, game, protocol and world, so that it can't repeat their mistakes.
The verdict comes from the monitors of the LTL library, which are tested on their own; how often φ
of □◇φ was satisfied is counted by ``formula`` alone.
"""
