"""What agents measure, as it truly is: only the world knows it."""
