"""The `tlcomm` command: supervisor of a run, recorder and audit."""
