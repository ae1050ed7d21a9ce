# SPDX-License-Identifier: GPL-3.0-only
"""The sky: a dome whose upper part is brighter, and the sun, which is one of its panes."""

import numpy as np

from model.portable import PI, cos, sin
from model.shapes import surface

Array = np.ndarray

RADIUS = 98.0
SUN_AZIMUTH = (186.0, 194.0)  # degrees from +x towards -z
SUN_ELEVATION = (44.0, 52.0)
AZIMUTHS = [0, 30, 60, 90, 120, 150, *SUN_AZIMUTH, 215, 245, 275, 305, 335, 360]
HORIZON, HAZE = -12.0, 27.0


def _dome(azimuths: list[float], elevations: list[float]) -> Array:
    """Panes between circles of longitude and latitude, facing inwards."""
    azimuth = np.array(azimuths)[::-1, np.newaxis] * (PI / 180)
    elevation = np.array(elevations)[np.newaxis] * (PI / 180)
    flat = np.where(elevation < PI / 2, cos(elevation), 0)
    return RADIUS * surface(np.stack(np.broadcast_arrays(
        flat * cos(azimuth), sin(elevation), -flat * sin(azimuth)), axis=-1))


def haze() -> Array:
    return _dome(AZIMUTHS, [HORIZON, 8, HAZE])


def zenith() -> Array:
    low, high = SUN_ELEVATION
    sun = AZIMUTHS.index(SUN_AZIMUTH[0])
    return np.concatenate([
        _dome(AZIMUTHS, [HAZE, low]),
        _dome(AZIMUTHS[:sun + 1], [low, high]), _dome(AZIMUTHS[sun + 1:], [low, high]),
        _dome(AZIMUTHS, [high, 68, 90])])


def sun() -> Array:
    return _dome(list(SUN_AZIMUTH), list(SUN_ELEVATION))
