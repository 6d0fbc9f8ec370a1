"""Bags: rosbag2 folders of MCAP files, written and read without ROS.

``topics``       what a run records
``definitions``  the message definitions that go inside
``compression``  how chunks are compressed
``records``      the encoding of MCAP records
``parsing``      their decoding
``writer``       crash-safe writing
``container``    reading, damaged files included
``typestore``    decoding by the definitions that a file brings along
``messages``     any of a bag's messages, decoded
``repair``       finishing a bag that was left unfinished
``reader``       a bag as ``RunRecords``
"""
