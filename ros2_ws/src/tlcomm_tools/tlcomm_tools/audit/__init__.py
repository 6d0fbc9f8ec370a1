"""The independent audit of a run: from its bag alone.

``tracks``      where each agent was, from its odometry
``links``       when the whole team was connected, from the tracks
``formula``     formulas read and evaluated on finite words
``tasks``       each task's satisfactions, from the events and tracks
``trespass``    whether agents kept out of what their tasks forbid
``conditions``  whether actions had what they need first
``strategies``  whether all agents hold the same strategies
``findings``    all of it as one document

It shares no code with planner, game, protocol and world, so that it can't repeat their mistakes.
"""
