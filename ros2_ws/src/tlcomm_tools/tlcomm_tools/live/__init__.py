"""A run's page while the run goes on: the report's page, fed as the run's messages come.

``growing``    lists and values of which pages get what is new
``way``        an agent's way, thinned as it grows
``rounds``     what was agreed on, as it comes about
``windows``    which windows were kept, as they are decided
``document``   the page's document, growing
``intake``     ROS messages into it
``beginning``  what was said before there was anybody to hear it, from the bag
``session``    from what is heard to what pages are told
``gate``       who is let in, to what
``audience``   the pages that are looked at, each with what it hasn't got yet
``server``     page and feed on this machine alone
"""
