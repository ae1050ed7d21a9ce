# SPDX-License-Identifier: GPL-3.0-only
"""A closed box with a light below its ceiling, as scene and camera files."""

from pathlib import Path

import numpy as np

CAMERA = """\
type pinhole
position 0 0 0.9
direction 0 0 -2
up 0 1 0.1
depth 1
filmSizeY 1.5
sensorResponse 1
"""

# The last two triangles of the box are its light.
SCENE = """\
triangles box.ra2
lights 1 12 13 10
reflectance 0.5
"""


def quad(corner: tuple, edge_u: tuple, edge_v: tuple) -> list[np.ndarray]:
    a, u, v = np.array(corner), np.array(edge_u), np.array(edge_v)
    return [np.array([a, a + u, a + u + v]), np.array([a, a + u + v, a + v])]


def box_triangles() -> np.ndarray:
    """Fourteen triangles: the cube [-1, 1]^3 around the origin, and the light."""
    triangles = []
    for low, high in [((-1, -1, -1), 1), ((1, 1, 1), -1)]:
        triangles += quad(low, (2 * high, 0, 0), (0, 2 * high, 0))
        triangles += quad(low, (0, 2 * high, 0), (0, 0, 2 * high))
        triangles += quad(low, (0, 0, 2 * high), (2 * high, 0, 0))
    triangles += quad((-0.4, 0.9, -0.4), (0.8, 0, 0), (0, 0, 0.8))
    return np.array(triangles)


def write_triangles(path: Path, triangles: np.ndarray) -> None:
    with np.errstate(over='ignore', under='ignore'):
        path.write_bytes(np.asarray(triangles).astype('<f4').tobytes())


def write_box(folder: Path) -> None:
    write_triangles(folder / 'box.ra2', box_triangles())
    (folder / 'box.scene').write_text(SCENE)
    (folder / 'box.camera').write_text(CAMERA)


def replace_line(path: Path, key: str, new_line: str) -> int:
    """Replaces the line that begins with the key; the number of that line."""
    lines = path.read_text().splitlines()
    number, = (i for i, line in enumerate(lines) if line.split()[0] == key)
    lines[number] = new_line
    path.write_text('\n'.join(lines) + '\n')
    return number + 1
