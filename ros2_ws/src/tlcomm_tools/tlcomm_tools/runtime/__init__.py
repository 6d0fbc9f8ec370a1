"""What runs a team as processes: environment, supervision, notification, spinning."""
