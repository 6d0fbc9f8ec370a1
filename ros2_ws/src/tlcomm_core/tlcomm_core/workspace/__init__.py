"""Where agents can be and how long driving takes: grid, maps and travel times."""
