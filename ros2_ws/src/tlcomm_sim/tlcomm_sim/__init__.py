"""The ROS 2 node of the simulated world: a thin shell around the world of `tlcomm_core`."""
