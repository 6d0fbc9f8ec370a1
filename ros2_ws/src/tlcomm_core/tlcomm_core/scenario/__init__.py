"""Scenario files: reading, checking, writing, and what follows from them."""
