# SPDX-License-Identifier: GPL-3.0-only
"""The parts of the scene atrium. Lengths are in metres.

A bay or an ornament is modelled in a frame of its own: u runs along the wall, y upwards, w from
the court through the wall into the walk, so that w = 0 is the plane of the columns' axes.
"""
