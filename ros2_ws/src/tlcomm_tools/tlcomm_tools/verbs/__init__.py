"""The verbs of the command, a module each.

A verb's module has a docstring (its help), ``EXAMPLE``, ``add_arguments(parser)`` and
``run(options) -> Status``.
"""
