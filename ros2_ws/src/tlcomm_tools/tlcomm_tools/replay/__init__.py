"""Replaying a bag: what is published when, apart from ROS.

``quality``   how a topic is offered
``script``    what a bag has to publish, in order
``schedule``  what is due at which time
``audience``  when to begin
``keyboard``  pause, step and quit
"""
