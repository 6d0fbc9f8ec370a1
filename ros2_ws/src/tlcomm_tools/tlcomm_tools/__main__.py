"""``python -m tlcomm_tools``: the command."""

from tlcomm_tools.cli import main

raise SystemExit(main())
