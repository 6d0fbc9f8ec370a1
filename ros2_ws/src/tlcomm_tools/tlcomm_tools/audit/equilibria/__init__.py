"""Whether agreed strategies are equilibria, reckoned anew from the plans that agents laid open.

``cells``       the cells of a map, and the moves between them
``travel``      times by turn and forward, and what a detour adds
``openings``    where one agent may go while the others stay
``rounds``      which plans an agreement was made with, and on which map
``candidates``  when an agent could be where, and what that costs it
``finding``     what was found: ``audit_equilibria`` is the way in
"""
