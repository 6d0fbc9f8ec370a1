"""Messages as values, read by the names of their fields: of ROS, or of a bag's decoder."""
