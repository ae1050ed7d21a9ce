# SPDX-License-Identifier: GPL-3.0-only
"""Where the many small things lie and grow."""

import numpy as np

from model.portable import Random, cos, power, sin

from . import land

Array = np.ndarray

VIEW_HALF_ANGLE = 0.75  # radians; most of what is small grows where the camera looks


def scattered(count: int, nearest: float, farthest: float, seed: int, towards: float = 1.4
              ) -> tuple[Array, Array, Array, Array]:
    """Places in view of the eye, denser near it: x, z, distance, and further draws (count, 6)."""
    draws = Random(seed).uniform(0, 1, (count, 8))
    distance = nearest + (farthest - nearest) * power(draws[:, 0], towards)
    angle = VIEW_HALF_ANGLE * (2 * draws[:, 1] - 1)
    x = land.EYE[0] + distance * sin(angle)
    z = land.EYE[1] - distance * cos(angle)
    inside = x * x + z * z < (land.RADIUS - 4)**2
    return x[inside], z[inside], distance[inside], draws[inside, 2:]
