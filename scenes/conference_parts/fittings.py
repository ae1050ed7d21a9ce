# SPDX-License-Identifier: GPL-3.0-only
"""What hangs on walls and stands about: screen, whiteboard, sideboard, flip chart, clock.

What hangs has its back in the plane z = 0 and faces +z; what stands does so on the origin.
"""

import numpy as np

from model.meshes import X, Y, Z, joined, moved, rotated
from model.portable import PI, Random, cos, sin
from model.shapes import cylinder, lathe, quad, rounded_box, steps, surface

from . import desk
from .basics import COARSE, bar, boxes, placed

Array = np.ndarray
SIDEBOARD = 30.0, 6.6, 4.4  # length, height, depth
PANEL_SLATS, PANEL_HEIGHT, PANEL_WIDTH = 44, 25.0, 31.0
BOARD_HALF_WIDTH, BOARD_HALF_HEIGHT = 12.0, 6.2


def slat_panel(fine: float) -> Array:
    """Upright strips of wood before the wall, from the middle of the floor upwards."""
    count = steps(PANEL_SLATS * min(1, 5 * fine), 4)
    pitch = PANEL_WIDTH / count
    x = -PANEL_WIDTH / 2 + pitch * np.arange(count)
    low = np.stack([x, 0 * x, 0 * x], axis=-1)
    return boxes(low, low + [0.62 * pitch, PANEL_HEIGHT, 0.45], ('bottom', 'back'))


def frame(half_width: float, half_height: float, edge: float, depth: float) -> Array:
    """Four bars around a rectangle."""
    a, b = half_width, half_height
    level = boxes([(-a - edge, b, 0), (-a - edge, -b - edge, 0)],
                  [(a + edge, b + edge, depth), (a + edge, -b, depth)], ('back',))
    upright = boxes([(-a - edge, -b, 0), (a, -b, 0)], [(-a, b, depth), (a + edge, b, depth)],
                    ('back', 'bottom', 'top'))
    return joined(level, upright)


def screen(fine: float) -> Array:
    """A large display with a camera bar below."""
    if fine < COARSE:
        return quad((-12.5, -7.0, 0.9), (12.5, -7.0, 0.9), (12.5, 7.0, 0.9), (-12.5, 7.0, 0.9))
    panel = boxes((-12.52, -7.02, 0.5), (12.52, 7.02, 0.9))
    bar_below = rounded_box((-4.5, -8.2, 0.5), (4.5, -7.35, 1.4), 0.3, steps(5 * fine, 1))
    lens = moved(rotated(cylinder(0.3, 0, 0.15, steps(24 * fine, 5)), X, PI / 2), 0, -7.78, 1.38)
    return joined(panel, moved(frame(12.5, 7.0, 0.18, 0.6), 0, 0, 0.42),
                  bar_below, lens)


def whiteboard(fine: float) -> Array:
    """With a tray, pens, an eraser, and notes under magnets."""
    a, b = BOARD_HALF_WIDTH, BOARD_HALF_HEIGHT
    if fine < COARSE:
        return quad((-a, -b, 0.15), (a, -b, 0.15), (a, b, 0.15), (-a, b, 0.15))
    board = joined(boxes((-a - 0.02, -b - 0.02, 0.05), (a + 0.02, b + 0.02, 0.15), ('back',)),
                   frame(a, b, 0.25, 0.28))
    tray = boxes([(-5, -b - 0.45, 0), (-5.02, -b - 0.4, 1.0)],
                 [(5, -b - 0.3, 1.1), (5.02, -b - 0.1, 1.12)], ('back',))
    if fine < 0.2:
        return joined(board, tray)
    random = Random(31)
    pens = [placed(desk.marker(fine), x, -b - 0.3, 0.55, float(random.uniform(-0.25, 0.25)))
            for x in (-3.6, -1.9, -0.3, 3.4)]
    eraser = rounded_box((1.0, -b - 0.29, 0.3), (2.3, -b + 0.1, 0.85), 0.08, steps(3 * fine, 1))
    return joined(board, tray, pens, eraser, notes(random, fine))


def notes(random: Random, fine: float) -> Array:
    magnet = rotated(cylinder(0.16, 0, 0.14, steps(18 * fine, 6)), X, PI / 2)
    parts = []
    for x, y in [(-9.2, 2.6), (-6.4, 3.1), (-8.8, -1.4), (7.5, 2.2), (9.9, 2.5)]:
        page = rotated(desk.sheet(float(random.uniform(0.5, 1.2)), fine), X, PI / 2)
        page = rotated(page, Z, float(random.uniform(-0.08, 0.08)))
        parts += [moved(page, x, y, 0.165), moved(magnet, x, y + 1.25, 0.14)]
    return joined(parts)


def sideboard(fine: float) -> Array:
    """Five doors with gaps between, on a recessed plinth."""
    length, height, depth = SIDEBOARD
    a = length / 2
    if fine < COARSE:
        return boxes((-a, 0, 0), (a, height, depth), ('bottom', 'back'))
    body = boxes((-a, 0.8, 0), (a, height - 0.25, depth - 0.25), ('back', 'top'))
    plinth = boxes((-a + 0.5, 0, 0), (a - 0.5, 0.8, depth - 0.8), ('bottom', 'back', 'top'))
    top = rounded_box((-a - 0.15, height - 0.25, 0), (a + 0.15, height, depth + 0.1), 0.06,
                      steps(3 * fine, 1))
    count, gap = 5, 0.08
    x = -a + length / count * np.arange(count)
    low = np.stack([x + gap / 2, np.full(count, 0.85), np.full(count, depth - 0.26)], axis=-1)
    doors = boxes(low, low + [length / count - gap, height - 1.2, 0.24], ('back',))
    path = np.array([(0, -0.75, -0.05), (0, -0.75, 0.2), (0, 0.75, 0.2), (0, 0.75, -0.05)])
    handle = bar(path, 0.05, steps(8 * fine, 3))
    handles = [moved(handle, at + length / count - 0.5, height - 1.65, depth) for at in x]
    return joined(body, plinth, top, doors, handles)


def flip_chart(fine: float) -> Array:
    """Three legs, a board, and a pad whose first sheet is half turned over."""
    segments = steps(10 * fine, 3)
    legs = [bar(np.array([foot, head], dtype=float), 0.12, segments)
            for foot, head in (((-3.4, 0, 1.6), (-2.6, 18.5, 0)), ((3.4, 0, 1.6), (2.6, 18.5, 0)),
                               ((0, 0, -4.2), (0, 17.5, -0.2)))]
    tilt = -0.085
    board = boxes((-3.5, 8.2, 0.2), (3.5, 18.6, 0.35))
    pad = boxes((-3.3, 8.6, 0.34), (3.3, 18.2, 0.5))
    clamp = rounded_box((-3.4, 17.9, 0.3), (3.4, 18.4, 0.75), 0.1, steps(3 * fine, 1))
    ledge = boxes((-3.52, 8.0, 0.15), (3.52, 8.25, 1.2))
    head = rotated(moved(joined(board, pad, clamp, ledge, curled_page(fine)), 0, -8.2, 0), X, tilt)
    pens = [placed(desk.marker(fine), x, 8.27, 1.45, 0.1) for x in (-1.5, 0.8)]
    return joined(legs, moved(head, 0, 8.2, 0.75), pens)


def curled_page(fine: float) -> Array:
    """The uppermost sheet bellies away from the pad towards its lower edge."""
    count = steps(14 * fine, 2)
    t = np.arange(count + 1) / count
    y = 17.9 - 9.1 * t + 1.1 * t * t * t
    z = 0.54 + 0.9 * t * t * t * t + 0.1 * sin(PI * t)
    ends = [np.stack([np.full_like(y, x), y, z + bulge * t * t], axis=-1)
            for x, bulge in ((-3.25, 0.0), (0.0, 0.12), (3.25, 0.5))]
    return surface(np.stack(ends))


def clock(fine: float) -> Array:
    """Ten past ten."""
    segments = steps(72 * fine, 8)
    case = lathe([(1.5, 0.0), (1.55, 0.1), (1.55, 0.32), (1.5, 0.36), (1.42, 0.34),
                  (1.4, 0.2), (0, 0.2)], segments)
    marks = [hand(0.1 if i % 3 == 0 else 0.05, 1.05, 1.3, 0.19, i * PI / 6) for i in range(12)]
    hands = [hand(0.1, -0.2, 0.75, 0.24, (10 + 10 / 60) * PI / 6),
             hand(0.08, -0.25, 1.1, 0.29, PI / 3)]
    pin = cylinder(0.08, 0.15, 0.35, steps(16 * fine, 5))
    return rotated(joined(case, marks, hands, pin), X, PI / 2)


def hand(width: float, start: float, end: float, y: float, angle: float) -> Array:
    """A strip on the face of the clock, at that angle clockwise from 12."""
    return rotated(boxes((-width / 2, y, -end), (width / 2, y + 0.03, -start)), Y, -angle)


def picture(fine: float) -> Array:
    """A framed relief of rings that spread like waves from two points."""
    count = steps(70 * fine, 6)
    x, y = np.meshgrid(np.linspace(-6, 6, count + 1), np.linspace(-4, 4, count + 1), indexing='ij')
    far = [np.sqrt((x - at[0]) * (x - at[0]) + (y - at[1]) * (y - at[1]))
           for at in ((-2.6, -0.8), (2.9, 1.2))]
    z = 0.45 + 0.1 * (cos(4.2 * far[0]) + cos(4.2 * far[1]))
    return joined(surface(np.stack([x, y, z], axis=-1)), frame(6, 4, 0.3, 0.8))


def projector(fine: float) -> Array:
    """Hung from the origin on a rod."""
    rod = bar(np.array([(0, 0.05, 0), (0, -3.3, 0)]), 0.14, steps(14 * fine, 4))
    rose = cylinder(0.5, -0.15, -0.01, steps(24 * fine, 5))
    body = rounded_box((-1.9, -4.4, -1.6), (1.9, -3.2, 1.6), 0.25, steps(6 * fine, 1))
    lens = bar(np.array([(-1.85, -3.8, 0.5), (-2.3, -3.8, 0.5)]), 0.42, steps(28 * fine, 6))
    vents = boxes([(-1.2 + 0.3 * i, -4.1, 1.59) for i in range(9)],
                  [(-1.1 + 0.3 * i, -3.5, 1.64) for i in range(9)])
    return joined(rod, rose, body, lens, vents if fine > 0.2 else [])


def air_outlet(fine: float) -> Array:
    """Concentric cones below the ceiling, which is in the plane y = 0."""
    segments = steps(64 * fine, 8)
    rings = [lathe([(r, -0.22), (r + 0.06, -0.24), (r + 0.38, -0.02)], segments)
             for r in (0.35, 0.75, 1.15, 1.55)]
    return joined(rings, lathe([(0, -0.26), (0.25, -0.25), (0.3, -0.05)], segments))


def waste_basket(fine: float) -> Array:
    """Of upright wires that lean outwards, held by rings."""
    count, segments = steps(44 * min(1, 2 * fine), 8), steps(6 * fine, 3)
    wire = bar(np.array([(0.95, 0.1, 0), (1.3, 3.2, 0)]), 0.03, segments)
    wires = [rotated(wire, Y, i * 2 * PI / count) for i in range(count)]
    angle = np.arange(steps(48 * fine, 8) + 1) * (2 * PI / steps(48 * fine, 8))
    hoops = [bar(np.stack([r * cos(angle), np.full_like(angle, y), r * sin(angle)], axis=-1),
                 0.045, segments) for r, y in ((0.95, 0.1), (1.08, 1.2), (1.3, 3.2))]
    return joined(wires, hoops, cylinder(0.95, 0.05, 0.1, steps(48 * fine, 8)))
