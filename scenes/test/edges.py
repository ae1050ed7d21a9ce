# SPDX-License-Identifier: GPL-3.0-only
"""Whether a mesh is closed."""

import numpy as np


def open_edges(mesh: np.ndarray) -> int:
    """How many directed edges of a mesh, rounded to float32, are not met by exactly one that runs
    the other way: 0 for a closed, consistently oriented surface."""
    corners = mesh.astype(np.float32).reshape(-1, 3) + np.float32(0)  # no -0
    _, vertex = np.unique(corners, axis=0, return_inverse=True)
    a = vertex.reshape(-1, 3).astype(np.int64)
    b = np.roll(a, -1, axis=1)
    count = a.max() + 1
    forth, back = np.sort((a * count + b).ravel()), np.sort((b * count + a).ravel())
    met = np.isin(forth, back)
    unique = np.concatenate([[True], forth[1:] != forth[:-1]])
    return int((~met | ~unique).sum())
