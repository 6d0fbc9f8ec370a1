"""Methods side by side: the same scenarios, seeds and time for each, and what came of it."""
