"""The coordination protocol: what agents say, and the state machine that says it."""
