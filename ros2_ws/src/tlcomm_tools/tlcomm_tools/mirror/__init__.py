"""Standard mirrors of what a run says, for viewers that don't know this project's messages.

``window_watch``  which windows are kept so far
``picture``       what is known of a team at one time
``odometry``      poses and velocities, decoded fast
``intake``        recorded messages into the picture
``elements``      the small parts of standard messages
``way``           where an agent will drive, to the next meeting
``paths``         the plan ahead and the path behind
``markers``       regions, agents, radio links, and where the team meets
``diagnostics``   how planner, game, radio, windows and agents are
``mirror``        all of it: recorded messages in, mirrored messages out
"""
