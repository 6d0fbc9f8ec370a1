"""What each method of coordination promises, audited from the evidence alone.

``guarantee``   a promise, and what was found of it
``methods``     which promises a method makes
``windows``     the team is connected for D_c in every window
``places``      everybody meets where it started
``connection``  the team is connected at every instant
``turns``       one acts at a time, by turns
``pairs``       pairs that agreed to meet do
``schedule``    every pair meets again and again, and word gets round to everybody
``silence``     nobody meets
"""
