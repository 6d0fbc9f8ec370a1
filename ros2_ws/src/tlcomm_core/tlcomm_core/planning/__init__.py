"""From a task to a local plan: transition system, product, lasso (Section IV-A)."""
