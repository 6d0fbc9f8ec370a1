"""tlcomm without ROS: LTL planning, the meeting game, its protocol, the brain and the world."""
