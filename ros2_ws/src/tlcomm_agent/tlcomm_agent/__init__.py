"""The ROS 2 node of one agent: a thin shell around the brain of `tlcomm_core`."""
