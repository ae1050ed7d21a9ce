# SPDX-License-Identifier: GPL-3.0-only
"""Bookcases. They stand with their back in the plane z = 0 and open towards +z."""

from dataclasses import dataclass, field

import numpy as np

from model import vectors
from model.meshes import Z, joined, moved
from model.portable import PI, Random, cos, sin
from model.shapes import quad, steps, surface

from . import tableware
from .basics import COARSE, FACES, boxes, placed

Array = np.ndarray
WIDTH, HEIGHT, DEPTH = 18.0, 26.0, 3.2
BOARD = 0.22
COLUMNS, ROWS = 2, 7
PLINTH = 0.8
COVER = 0.035
PAGES_INSET = 0.06


@dataclass
class Books:
    """Sizes (thickness, height, depth), lower left rear corners, and how far each leans over."""

    sizes: list[tuple[float, float, float]] = field(default_factory=list)
    corners: list[tuple[float, float, float]] = field(default_factory=list)
    leans: list[float] = field(default_factory=list)

    def add(self, size: tuple[float, float, float], corner: tuple[float, float, float],
            lean: float = 0) -> None:
        self.sizes.append(size)
        self.corners.append(corner)
        self.leans.append(lean)


def sheets() -> Array:
    """A bookcase of boards without thickness."""
    inner, row = column_width() + BOARD, row_height()
    y = [PLINTH + i * row for i in range(ROWS)] + [HEIGHT]
    boards = [quad((0, at, 0.1), (WIDTH, at, 0.1), (WIDTH, at, DEPTH), (0, at, DEPTH)) for at in y]
    uprights = [quad((x, 0, 0.1), (x, 0, DEPTH), (x, HEIGHT, DEPTH), (x, HEIGHT, 0.1))
                for x in (0, inner, 2 * inner)]
    back = quad((0, 0, 0.09), (WIDTH, 0, 0.09), (WIDTH, HEIGHT, 0.09), (0, HEIGHT, 0.09))
    return joined(boards, uprights, back)


def carcass() -> Array:
    inner, row = column_width(), row_height()
    uprights_x = BOARD / 2 + np.arange(COLUMNS + 1) * (inner + BOARD)
    uprights = [boxes((x - BOARD / 2, -0.02, 0.02), (x + BOARD / 2, HEIGHT, DEPTH))
                for x in uprights_x]
    shelves = [boxes((x + BOARD / 2, y, 0.1), (x + BOARD / 2 + inner, y + BOARD, DEPTH - 0.04),
                     ('left', 'right'))
               for x in uprights_x[:-1] for y in [PLINTH + i * row for i in range(ROWS + 1)]]
    plinth = boxes((BOARD, 0, 0.1), (WIDTH - BOARD, PLINTH, DEPTH - 0.4),
                   ('bottom', 'top', 'back', 'left', 'right'))
    back = quad((0, 0, 0.09), (WIDTH, 0, 0.09), (WIDTH, HEIGHT, 0.09), (0, HEIGHT, 0.09))
    return joined(uprights, shelves, plinth, back)


def column_width() -> float:
    return (WIDTH - (COLUMNS + 1) * BOARD) / COLUMNS


def row_height() -> float:
    return (HEIGHT - BOARD - PLINTH) / ROWS


def fill_row(books: Books, ornaments: list, x: float, end: float, y: float, random: Random,
             thicker: float) -> None:
    """Sets of books of a kind, then some that lean, a lying pile or an ornament."""
    while x < end - 0.6:
        kind = float(random.uniform(0, 1))
        if kind < 0.12 and end - x > 3.2:
            lying_pile(books, x, y, random, thicker)
            x += 2.7
        elif kind < 0.22 and end - x > 3:
            ornaments.append((x + 1.3, y, int(random.integers(4))))
            x += 2.7
        else:
            x = standing_set(books, x, end, y, random, thicker)


def standing_set(books: Books, x: float, end: float, y: float, random: Random,
                 thicker: float) -> float:
    height, depth = random.uniform(1.9, 2.95), random.uniform(1.5, 2.3)
    alike = random.uniform(0, 1) < 0.3
    thickness = float(random.uniform(0.15, 0.6))
    for _ in range(3 + int(random.integers(9))):
        if not alike:
            thickness = float(random.uniform(0.14, 0.7))
        size = (min(thickness * thicker, 4),
                float(min(3.05, height * (1 if alike else random.uniform(0.8, 1.12)))),
                float(min(2.6, depth * (1 if alike else random.uniform(0.85, 1.1)))))
        if x + size[0] > end:
            return end
        back = DEPTH - 0.3 - size[2] - float(random.uniform(0, 0.12))
        books.add(size, (x, y, back))
        x += size[0] + 0.012
    return lean_last(books, x, end, random) if random.uniform(0, 1) < 0.45 else x


def lean_last(books: Books, x: float, end: float, random: Random) -> float:
    """Lets one more book lean against the last."""
    thickness, height, depth = books.sizes[-1]
    _, y, back = books.corners[-1]
    lean = float(random.uniform(0.12, 0.26))
    size = thickness, height * float(random.uniform(0.85, 0.98)), depth
    reach = float(size[1] * sin(lean))
    room = x + reach + float(size[0] * cos(lean)) + 0.02
    if room > end:
        return end
    books.add(size, (x + reach, y, back), lean)
    return room


def lying_pile(books: Books, x: float, y: float, random: Random, thicker: float) -> None:
    """Books on their side: turned by a quarter, so the spine still shows."""
    y += 0.006
    for _ in range(2 + int(random.integers(4))):
        thickness = float(random.uniform(0.15, 0.4)) * min(thicker, 2)
        length, depth = random.uniform(2.0, 2.5), random.uniform(1.5, 1.9)
        shift = float(random.uniform(0, 0.15))
        books.add((thickness, float(length), float(depth)),
                  (x + shift + float(length), y, DEPTH - 0.3 - float(depth)), PI / 2)
        y += thickness + 0.01


def book_meshes(books: Books, fine: float) -> Array:
    """All books at a time."""
    size, corner, lean = (np.array(values) for values in (books.sizes, books.corners, books.leans))
    parts = upright_books(size, fine)
    turns = vectors.rotation(Z, lean)[:, np.newaxis, np.newaxis]
    return (vectors.transformed(parts, turns) + corner[:, np.newaxis, np.newaxis]).reshape(-1, 3, 3)


def upright_books(size: Array, fine: float) -> Array:
    """Meshes (books, triangles, 3, 3): lower left rear corner on the origin, spine at +z."""
    count = len(size)
    if fine < 0.2:
        hidden = ('back', 'bottom') if fine > COARSE else [f for f in FACES if f != 'front']
        low = np.zeros_like(size) + [0, 0.004, 0]
        return boxes(low, size, hidden).reshape(count, -1, 3, 3)
    thickness, height, depth = size.T
    zero, board = np.zeros(count), np.full(count, COVER)
    lift = np.full(count, 0.005)
    hinge = depth - 0.08

    def boards(x0: Array, x1: Array) -> Array:
        return boxes(np.stack([x0, lift, zero], -1), np.stack([x1, height, hinge], -1))

    pages = boxes(np.stack([board, lift + PAGES_INSET, zero + PAGES_INSET], -1),
                  np.stack([thickness - COVER, height - PAGES_INSET, hinge], -1),
                  ('front', 'left', 'right'))
    meshes = [boards(zero, board), boards(thickness - COVER, thickness), pages]
    return np.concatenate([mesh.reshape(count, -1, 3, 3) for mesh in meshes]
                          + [spines(thickness, height, hinge, fine)], axis=1)


def spines(thickness: Array, height: Array, hinge: Array, fine: float) -> Array:
    """Rounded backs, as arcs from board to board with the thickness of the cover."""
    count, segments = len(thickness), steps(8 * fine, 2)
    angle = np.arange(segments + 1) * (PI / segments)
    half = (thickness / 2)[:, np.newaxis]
    bow = np.minimum(0.16, 0.45 * thickness)[:, np.newaxis]

    def arc(inset: float) -> tuple[Array, Array]:
        return (half - (half - inset) * cos(angle),
                hinge[:, np.newaxis] + (bow - inset) * sin(angle))

    outer, inner = arc(0.0), arc(COVER)
    low = np.full_like(outer[0], 0.005)
    high = np.broadcast_to(height[:, np.newaxis], low.shape)
    ring = [np.stack([x, y, z], axis=-1) for (x, z), y in
            ((inner, low), (outer, low), (outer, high), (inner, high))]
    grid = np.stack(ring, axis=2)  # books, arc, corners of the section
    grids = grid.reshape(count, segments + 1, 4, 3)
    return np.stack([surface(points, closed_v=True) for points in grids])


def ornament(kind: int, fine: float) -> Array:
    makers = (tableware.vase, tableware.globe, tableware.carafe, file_box)
    return makers[kind](fine) * [0.82, 0.82, 0.82]


def file_box(_: float) -> Array:
    """Three magazine files with slanted fronts."""
    points = np.array([(0, 0.01, -1.2), (0, 0.01, 1.2), (0, 1.5, 1.2), (0, 3.1, -0.2),
                       (0, 3.1, -1.2)])
    file = surface(np.stack([points, points + [0.85, 0, 0]]), closed_v=True)
    sides = [np.array([points[0], points[i], points[i + 1]]) for i in range(1, 4)]
    one = joined(file, np.array(sides), np.array(sides) + [0.85, 0, 0])
    return joined([moved(one, x) for x in (-1.32, -0.44, 0.44)])


def bookcase(fine: float, seed: int) -> Array:
    random, books, ornaments = Random(seed), Books(), []
    thicker = 1 / min(1, 3 * fine)
    for column in range(COLUMNS):
        x = BOARD + column * (column_width() + BOARD)
        for row in range(ROWS):
            y = PLINTH + row * row_height() + BOARD
            fill_row(books, ornaments, x + 0.05, x + column_width() - 0.05, y, random, thicker)
    things = [placed(ornament(kind, fine), x, y, DEPTH / 2 + 0.2, 0.5 * kind)
              for x, y, kind in ornaments if fine > COARSE]
    return joined(carcass() if fine > COARSE else sheets(), book_meshes(books, fine), things)
