# SPDX-License-Identifier: GPL-3.0-only
"""The sky: a half-dome behind the wood, a cap above it, and the sun.

The rest is open: a closed dome would reflect so much sunlight that no shadow was left.
"""

import numpy as np

from model.portable import PI, cos, sin
from model.shapes import surface

Array = np.ndarray

RADIUS = 98.0
SUN_AZIMUTH = (60.0, 76.0)  # degrees from +x towards -z
SUN_ELEVATION = (60.0, 69.0)
AHEAD = [14, 37, *SUN_AZIMUTH, 96, 120, 144, 166]  # azimuths of the panes behind the wood
ROUND = [*AHEAD, 195, 230, 270, 310, 345, 374]
HORIZON, HAZE, CAP = -12.0, 27.0, 76.0  # elevations


def _dome(azimuths: list[float], elevations: list[float]) -> Array:
    """Panes between circles of longitude and latitude, facing inwards."""
    azimuth = np.array(azimuths)[::-1, np.newaxis] * (PI / 180)
    elevation = np.array(elevations)[np.newaxis] * (PI / 180)
    flat = np.where(elevation < PI / 2, cos(elevation), 0)
    return RADIUS * surface(np.stack(np.broadcast_arrays(
        flat * cos(azimuth), sin(elevation), -flat * sin(azimuth)), axis=-1))


def haze() -> Array:
    return _dome(AHEAD, [HORIZON, 8, HAZE])


def zenith() -> Array:
    """With a hole where the sun is."""
    low, high = SUN_ELEVATION
    left = AHEAD.index(SUN_AZIMUTH[1])
    return np.concatenate([
        _dome(AHEAD, [HAZE, 43, low]), _dome(AHEAD[:left], [low, high]),
        _dome(AHEAD[left:], [low, high]), _dome(AHEAD, [high, CAP]), _dome(ROUND, [CAP, 90])])


def sun() -> Array:
    return _dome(list(SUN_AZIMUTH), list(SUN_ELEVATION))
