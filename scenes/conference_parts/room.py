# SPDX-License-Identifier: GPL-3.0-only
"""The room itself: walls, ceiling, floor, skirting and door. Windows are in the wall of -z."""

import numpy as np

from model.meshes import X, joined, moved, rotated
from model.portable import PI, Random
from model.shapes import cylinder, quad, steps

from . import lamps
from .basics import COARSE, MEDIUM, bar, bent, boxes

Array = np.ndarray
HALF_LENGTH, HALF_WIDTH, HEIGHT = 50.0, 35.0, 32.0
LAMPS_X, LAMPS_Z = (-30.0, 0.0, 30.0), (-13.0, 13.0)
WINDOWS_X = (-36.0, -12.0, 12.0, 36.0)
WINDOW_HALF_WIDTH, WINDOW_LOW, WINDOW_HIGH = 10.0, 8.5, 28.5
REVEAL_DEPTH = 3.0
SKY = (-46.0, 46.0), (8.0, 29.0), -47.0  # x, y, z of the luminous panel outside
OUTSIDE = (-50.0, 1.0, -51.0), (50.0, 35.0, -35.0)  # corners of the box around it
DOOR_X = (4.0, 13.5)
DOOR_HEIGHT = 21.5
PLANK = 18.0, 1.75, 0.12  # length, width, thickness
BEVEL = 0.035


def wall_rectangle(x: tuple[float, float], y: tuple[float, float], z: float) -> Array:
    return quad((x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z))


def intervals(holes: list[tuple[float, float]], end: float) -> list[tuple[float, float]]:
    """What holes leave of [-end, end]."""
    bounds = [-end] + [bound for hole in holes for bound in hole] + [end]
    return list(zip(bounds[::2], bounds[1::2]))


def ceiling() -> Array:
    """Cut into strips around the panels of the lamps."""
    def rectangle(x: tuple[float, float], z: tuple[float, float]) -> Array:
        return quad((x[0], HEIGHT, z[0]), (x[1], HEIGHT, z[0]), (x[1], HEIGHT, z[1]),
                    (x[0], HEIGHT, z[1]))
    holes_x = [(x - lamps.HALF_LENGTH, x + lamps.HALF_LENGTH) for x in LAMPS_X]
    holes_z = [(z - lamps.HALF_WIDTH, z + lamps.HALF_WIDTH) for z in LAMPS_Z]
    strips = [rectangle((-HALF_LENGTH, HALF_LENGTH), z)
              for z in intervals(holes_z, HALF_WIDTH)]
    between = [rectangle(x, z) for z in holes_z for x in intervals(holes_x, HALF_LENGTH)]
    return joined(strips, between)


def window_wall() -> Array:
    holes = [(x - WINDOW_HALF_WIDTH, x + WINDOW_HALF_WIDTH) for x in WINDOWS_X]
    all_x = -HALF_LENGTH, HALF_LENGTH
    parts = [wall_rectangle(all_x, (0, WINDOW_LOW), -HALF_WIDTH),
             wall_rectangle(all_x, (WINDOW_HIGH, HEIGHT), -HALF_WIDTH)]
    parts += [wall_rectangle(pier, (WINDOW_LOW, WINDOW_HIGH), -HALF_WIDTH)
              for pier in intervals(holes, HALF_LENGTH)]
    reveals = [boxes((x0, WINDOW_LOW, -HALF_WIDTH - REVEAL_DEPTH),
                     (x1, WINDOW_HIGH, -HALF_WIDTH), ('front', 'back'))
               for x0, x1 in holes]
    return joined(parts, reveals)


def sky() -> Array:
    return wall_rectangle(*SKY)


def shell() -> Array:
    a, b = HALF_LENGTH, HALF_WIDTH
    closed_walls = boxes((-a, 0, -b), (a, HEIGHT, b), ('top', 'back'))
    outside = boxes(*OUTSIDE, ('front',))
    return joined(closed_walls, ceiling(), window_wall(), outside)


def planks() -> Array:
    """Floor boards with bevelled edges, each row shifted at random."""
    length, width, thickness = PLANK
    random, low, high = Random(11), [], []
    for row in range(int(2 * HALF_WIDTH / width)):
        z = -HALF_WIDTH + row * width
        x = -HALF_LENGTH - float(random.uniform(0, length))
        while x < HALF_LENGTH:
            start, end = max(x, -HALF_LENGTH), min(x + length, HALF_LENGTH)
            low.append((start, 0.02, z))
            high.append((end, thickness, z + width))
            x += length
    low, high = np.array(low), np.array(high)
    tops = boxes(low + [BEVEL, 0, BEVEL], high - [BEVEL, 0, BEVEL])
    return bevelled(tops, low, high)


def bevelled(tops: Array, low: Array, high: Array) -> Array:
    """Boards whose upper faces are drawn in: the lower corners go out to the full size."""
    centre = np.repeat((low + high) / 2, 12, axis=0)[:, np.newaxis]
    half = np.repeat((high - low) / 2 - [0.004, 0, 0.004], 12, axis=0)[:, np.newaxis]
    is_low = tops[..., 1:2] < centre[..., 1:2]
    lowered = centre + np.sign(tops - centre) * half
    mesh = np.where(is_low, lowered, tops).reshape(-1, 6, 2, 3, 3)
    return mesh[:, 1:].reshape(-1, 3, 3)


def skirting() -> Array:
    a, b, height, depth = HALF_LENGTH, HALF_WIDTH, 0.9, 0.14
    door_frame = 0.9
    front = boxes([(-a, 0, b - depth), (DOOR_X[1] + door_frame, 0, b - depth)],
                  [(DOOR_X[0] - door_frame, height, b), (a, height, b)],
                  ('bottom', 'front', 'left', 'right'))
    back = boxes((-a, 0, -b), (a, height, -b + depth), ('bottom', 'back', 'left', 'right'))
    left = boxes((-a, 0, -b + depth), (-a + depth, height, b - depth),
                 ('bottom', 'left', 'front', 'back'))
    return joined(front, back, left, left * [-1, 1, 1])


def door(fine: float) -> Array:
    """With its frame, in front of the wall of +z."""
    (x0, x1), z = DOOR_X, HALF_WIDTH
    if fine < COARSE:
        return boxes((x0, 0, z - 0.3), (x1, DOOR_HEIGHT, z), ('bottom', 'front'))
    posts = boxes([(x0 - 0.9, 0, z - 0.35), (x1, 0, z - 0.35)],
                  [(x0, DOOR_HEIGHT, z), (x1 + 0.9, DOOR_HEIGHT, z)], ('bottom', 'top', 'front'))
    lintel = boxes((x0 - 0.9, DOOR_HEIGHT, z - 0.35), (x1 + 0.9, DOOR_HEIGHT + 0.9, z), ('front',))
    leaf = boxes((x0 + 0.04, 0.2, z - 0.22), (x1 - 0.04, DOOR_HEIGHT - 0.04, z), ('front',))
    if fine < 0.2:
        return joined(posts, lintel, leaf)
    grooves = np.arange(4)[:, np.newaxis] * [0, 4.8, 0]
    panels = boxes([x0 + 0.9, 1.2, z - 0.3] + grooves, [x1 - 0.9, 5.5, z - 0.2] + grooves,
                   ('front',))
    rosette = rotated(cylinder(0.28, 0, 0.08, steps(28 * fine, 8)), X, -PI / 2)
    way = bent([(0, 0, -0.03), (0, 0, -0.55), (-1.25, 0, -0.55)], 0.25, steps(8 * fine, 1))
    lever = bar(way, 0.09, steps(12 * fine, 4))
    handle = moved(joined(rosette, lever), x1 - 0.5, 10.4, z - 0.2)
    return joined(posts, lintel, leaf, panels, handle)


def room(fine: float) -> Array:
    parts = [shell(), lamp_fittings(fine), door(fine)]
    if fine > COARSE:
        parts.append(skirting())
    if fine > MEDIUM:
        parts.append(planks())
    return joined(parts)


def lamp_fittings(fine: float) -> Array:
    lamp = lamps.lamp(fine)
    return joined([moved(lamp, x, HEIGHT, z) for x in LAMPS_X for z in LAMPS_Z])
