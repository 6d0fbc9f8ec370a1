"""A run as one page that explains it: from its bag, with everything inside, for any browser.

``links``     who heard whom, from when to when
``steps``     the steps of its plan that an agent has done
``moves``     the moves of single agents by which a round's cost came down
``rounds``    what was agreed on, and what came of it
``document``  all that the page shows, ready for JSON
``page``      the page round it, from ``assets``
"""
