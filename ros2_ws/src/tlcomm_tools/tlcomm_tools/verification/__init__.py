"""Decision replay: fresh brains are told what a bag's agents were told, and must do the same.

``recording``   what a bag holds of it
``setting``     what the bag says of the run, and whether it holds all that is needed
``inputs``      what one agent was told, in order, and when it had to act
``outputs``     what agents did, recorded and anew
``rehearsal``   one agent once more, in lock step with its own record
``mismatch``    where two values differ
``comparison``  one agent's record beside what comes out
``findings``    the first difference of all: ``verify`` is the way in
"""
