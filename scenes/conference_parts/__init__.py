# SPDX-License-Identifier: GPL-3.0-only
"""The furniture of the conference room; one unit is 100 mm.

Where a function takes `fine`, that is the square root of the level of detail: how many times more
segments a curve has than in the standard scene.
"""
