"""One agent: its brain, controller and radio."""
