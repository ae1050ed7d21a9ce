# SPDX-License-Identifier: GPL-3.0-only
"""Two tiers of stands: steps, stairs, entrances and railings. Seats are in seats.py."""

from dataclasses import dataclass

import numpy as np

from model.meshes import joined
from model.shapes import steps, tubes

from . import plan

Array = np.ndarray

STAIR_WIDTH = 1.1
GANGWAY = 1.6  # in front of the first row of the upper tier
CONCOURSE = 3.6
SOFFIT = 12.0  # height of the underside of the upper tier
PARAPET = 0.85  # height of walls to lean on
ENTRANCE = (0.33, 0.67)  # sides of an entrance, as fractions of a bay
HEADROOM = 1.9
WALL = 0.12
TUNNEL = 5.0  # from an entrance into the dark
RAIL_RADIUS = 0.035


@dataclass
class Tier:
    """Rows of steps on which seats stand."""

    offset: float  # of the first row from the edge of the arena
    height: float
    depth: float  # of all rows
    rise: float  # from the first row to what is behind the last
    rows: int
    entrance_row: int
    entrance_bays: Array

    def row_offset(self, row: Array | int) -> Array | float:
        return self.offset + self.depth * row / self.rows

    def row_height(self, row: Array | int) -> Array | float:
        return self.height + self.step_height() * row

    def step_height(self) -> float:
        return self.rise / self.rows

    def profile(self) -> list[tuple[float, float]]:
        """From the front edge of the first row to the back edge of the last."""
        points = []
        for row in range(self.rows):
            points += [(self.row_offset(row), self.row_height(row)),
                       (self.row_offset(row + 1), self.row_height(row))]
        return points

    def entrance_rows(self) -> tuple[int, int]:
        """The first row that an entrance takes, and the first one above its door."""
        needed = int(HEADROOM / self.step_height()) + 1
        return self.entrance_row, min(self.entrance_row + needed, self.rows - 1)


def tiers(coarseness: float, furnished: bool) -> tuple[Tier, Tier]:
    """The lower and the upper tier; rows are that many times as deep as they should be."""
    lower, upper = steps(20 / coarseness, 2), steps(19 / coarseness, 3)
    bays = np.arange(plan.BAYS if furnished else 0)
    return (Tier(1.9, 0.9, 16.6, 7.6, lower, lower // 3, bays[0::2]),
            Tier(18.8, 13.0, 16.6, 11.4, upper, upper // 5, bays[1::2]))


def directions(segments: int) -> Array:
    """Where the rings have corners: also at the sides of all entrances."""
    low, high = ENTRANCE
    parts = [np.arange(segments) * (low / segments),
             low + np.arange(segments) * ((high - low) / segments),
             high + np.arange(segments) * ((1 - high) / segments)]
    return plan.bays(np.concatenate(parts).tolist()).reshape(-1)


def steps_of(tier: Tier, angles: Array) -> Array:
    """Treads and risers, with holes for the entrances."""
    cells = plan.ring(tier.profile(), angles)
    kept = np.ones(cells.shape[:2], dtype=bool)
    if len(tier.entrance_bays):
        first, last = tier.entrance_rows()
        in_bay = len(angles) // plan.BAYS
        column = np.arange(len(angles))
        open_column = (np.isin(column // in_bay, tier.entrance_bays)
                       & (column % in_bay * 3 // in_bay == 1))
        kept[open_column, 2 * first:2 * last] = False
    return cells[kept].reshape(-1, 3, 3)


def stairs(tier: Tier) -> Array:
    """A step of half the height between each two rows."""
    angles = plan.bays([0]).reshape(-1)
    rise, depth = tier.step_height(), tier.depth / tier.rows
    return joined(plan.bent_boxes(
        angles, STAIR_WIDTH, (tier.row_height(row) - 0.02, tier.row_height(row) + rise / 2),
        (tier.row_offset(row) + depth / 2, tier.row_offset(row + 1) + 0.02))
        for row in range(tier.rows - 1))


def entrances(tier: Tier) -> Array:
    """Walls at both sides with sloping tops, one above the door, and a tunnel behind it."""
    first, last = tier.entrance_rows()
    front, back = tier.row_offset(first), tier.row_offset(last)
    floor, top = tier.row_height(first), tier.row_height(last) + PARAPET
    door, end, thick = floor + HEADROOM, back + TUNNEL, back + WALL
    left, right = plan.bays(list(ENTRANCE))[tier.entrance_bays].T
    meshes = [
        plan.quads((left, floor, front), (right, floor, front), (right, floor, end),
                   (left, floor, end)),
        plan.quads((left, door, back), (right, door, back), (right, top, back), (left, top, back)),
        plan.quads((left, top, back), (right, top, back), (right, top, thick), (left, top, thick)),
        plan.quads((left, door, thick), (right, door, thick), (right, top, thick),
                   (left, top, thick)),
        plan.quads((left, door, back), (right, door, back), (right, door, end), (left, door, end)),
        plan.quads((left, floor, end), (right, floor, end), (right, door, end), (left, door, end))]
    for side, outer in ((left, left - WALL / plan.radius(left, back)),
                        (right, right + WALL / plan.radius(right, back))):
        meshes += [
            plan.quads((side, floor, front), (side, floor, back), (side, top, back),
                       (side, floor + PARAPET, front)),
            plan.quads((outer, floor - WALL, front), (outer, floor - WALL, thick),
                       (outer, top, thick), (outer, floor + PARAPET, front)),
            plan.quads((side, floor + PARAPET, front), (side, top, thick), (outer, top, thick),
                       (outer, floor + PARAPET, front)),
            plan.quads((side, floor - WALL, front), (side, floor + PARAPET, front),
                       (outer, floor + PARAPET, front), (outer, floor - WALL, front)),
            plan.quads((outer, floor, thick), (side, floor, thick), (side, top, thick),
                       (outer, top, thick)),
            plan.quads((side, floor, back), (side, floor, end), (side, door, end),
                       (side, door, back))]
    return joined(meshes)


def front_wall(lower: Tier) -> list[tuple[float, float]]:
    """Profile of the arena's edge, with the gangway in front of the first row."""
    top = lower.height + PARAPET
    return [(0, -0.1), (0, top), (0.2, top), (0.2, lower.height), (lower.offset, lower.height)]


def between_tiers(lower: Tier, upper: Tier) -> list[tuple[float, float]]:
    """Profile from the last row of the lower tier to the first row of the upper one, by way of the
    concourse, its back wall, and the front of the upper tier."""
    back, floor = lower.row_offset(lower.rows), lower.row_height(lower.rows)
    edge, top = upper.offset - GANGWAY, upper.height + PARAPET
    return [(back, floor - lower.step_height()), (back, floor),
            (back + CONCOURSE, floor), (back + CONCOURSE, SOFFIT),
            (edge + 1.2, SOFFIT), (edge + 0.3, SOFFIT + 0.35), (edge, SOFFIT + 0.5), (edge, top),
            (edge + 0.2, top), (edge + 0.2, upper.height), (upper.offset, upper.height)]


def back_wall(upper: Tier) -> list[tuple[float, float]]:
    """Profile behind the last row of the upper tier, and of the outer face of the stadium."""
    back, floor = upper.row_offset(upper.rows), upper.row_height(upper.rows)
    top = floor + PARAPET
    return [(back, floor - upper.step_height()), (back, floor), (back + 1.2, floor),
            (back + 1.2, top), (back + 1.5, top), (back + 1.5, 0)]


def without_small(profile: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """A profile with fewer corners, but the same ends."""
    kept = [profile[0]]
    for x, y in profile[1:-1]:
        if max(abs(x - kept[-1][0]), abs(y - kept[-1][1])) > 0.9:
            kept.append((x, y))
    return kept + profile[-1:]


def box_fronts(lower: Tier) -> Array:
    """Posts and low walls of the boxes at the back of the concourse."""
    back, floor = lower.row_offset(lower.rows), lower.row_height(lower.rows)
    count = plan.BAYS * 4
    return joined(
        plan.bent_boxes(plan.evenly(count), 0.18, (floor - 0.1, SOFFIT + 0.1),
                        (back + CONCOURSE - 0.7, back + CONCOURSE - 0.2)),
        plan.bent_boxes(plan.evenly(count, start=0.5), 1.7, (floor - 0.1, floor + 0.7),
                        (back + CONCOURSE - 0.6, back + CONCOURSE - 0.4)))


def handrail(offset: float, height: float, angles: Array) -> Array:
    """A tube on posts."""
    path = plan.at(np.append(angles, angles[0]), height + 0.35, offset)
    posts = plan.bent_boxes(plan.evenly(plan.BAYS * 3, offset), 2 * RAIL_RADIUS,
                            (height - 0.05, height + 0.35),
                            (offset - RAIL_RADIUS, offset + RAIL_RADIUS))
    return joined(tubes(path, RAIL_RADIUS, 5, closed_ends=False), posts)


def stands(both: tuple[Tier, Tier], angles: Array, furnished: bool) -> Array:
    """All but seats; the rings have corners at these angles, and few others if unfurnished."""
    lower, upper = both
    profiles = [front_wall(lower), between_tiers(lower, upper), back_wall(upper)]
    if not furnished:
        profiles = [without_small(profile) for profile in profiles]
    parts = [plan.ring(profile, angles).reshape(-1, 3, 3) for profile in profiles]
    parts += [steps_of(tier, angles) for tier in both]
    if furnished:
        for tier in both:
            parts += [stairs(tier), entrances(tier)]
        parts += [box_fronts(lower), handrail(0.1, lower.height + PARAPET, angles),
                  handrail(upper.offset - GANGWAY + 0.1, upper.height + PARAPET, angles)]
    return joined(parts)
