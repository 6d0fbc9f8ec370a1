"""The meeting game: candidates, initial strategy, best responses, equilibrium."""
