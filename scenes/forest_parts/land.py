# SPDX-License-Identifier: GPL-3.0-only
"""The lie of the land: rolling ground, a winding path, and stones."""

import numpy as np

from model import vectors
from model.noise import fractal_noise
from model.portable import PI, Random, cos, exp, log, sin, smoothstep
from model.shapes import sphere, surface

Array = np.ndarray

RADIUS = 76.0  # of the ground, about the origin
EYE = np.array([0.0, 44.0])  # x and z of the camera that looks along the path
PATH_WIDTH = 3.0
STONE_SHAPES = 5
LOG = np.array([[-9.0, 35.5], [0.6, 31.6]])  # x and z of the ends of a fallen stem
LOG_RADIUS = 0.62


def path_x(z: Array) -> Array:
    """Where the middle of the path runs."""
    return 6.5 * sin((EYE[1] - z) / 19) - 0.02 * (EYE[1] - z)


def beside_path(x: Array, z: Array) -> Array:
    """Horizontal distance from the middle of the path."""
    return np.abs(x - path_x(z))


def height(x: Array, z: Array) -> Array:
    x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float))
    at = np.stack([x, np.zeros_like(x), z], axis=-1)
    beside = beside_path(x, z)
    far = smoothstep(35, 80, np.sqrt(x * x + z * z))
    bank = 1.1 * smoothstep(1, 16, beside)
    rut = 0.35 * (1 - smoothstep(0.5 * PATH_WIDTH - 0.7, 0.5 * PATH_WIDTH + 0.7, beside))
    rough = 0.05 + 0.10 * smoothstep(1, 3, beside)
    return (2.6 * fractal_noise(at / 34 + 0.37, 2, seed=1) + rough * fractal_noise(at / 1.7, 3, 2)
            + bank - rut + 7 * far)


def on_ground(x: Array, z: Array) -> Array:
    return np.stack(np.broadcast_arrays(x, height(x, z), z), axis=-1)


def under_log(x: Array, z: Array) -> Array:
    """Whether something would stand in the fallen stem."""
    along = LOG[1] - LOG[0]
    dx, dz = x - LOG[0, 0], z - LOG[0, 1]
    squared = along[0] * along[0] + along[1] * along[1]
    t = np.clip((dx * along[0] + dz * along[1]) / squared, 0, 1)
    dx, dz = dx - t * along[0], dz - t * along[1]
    return dx * dx + dz * dz < (1.6 * LOG_RADIUS)**2


def ground(triangles: float) -> Array:
    """A polar grid about the eye, so that its cells grow with the distance."""
    nearest = 1.2
    round_about = max(8, int(np.sqrt(triangles / 1.4)))
    outwards = max(3, int(triangles / 2 / round_about))
    angle = np.arange(round_about) * (2 * PI / round_about)
    direction = np.stack([cos(angle), -sin(angle)], axis=-1)
    along = direction[:, 0] * EYE[0] + direction[:, 1] * EYE[1]
    reach = -along + np.sqrt(along * along + RADIUS * RADIUS - EYE[0]**2 - EYE[1]**2)
    share = np.arange(outwards + 1) / outwards
    distance = nearest * exp(log(reach / nearest)[:, np.newaxis] * share)
    distance[:, 0] = 0
    at = EYE + distance[..., np.newaxis] * direction[:, np.newaxis]
    return surface(on_ground(at[..., 0], at[..., 1]), closed_u=True)


def stone(segments: int, seed: int) -> Array:
    """About a unit large, flattened, with broken edges."""
    mesh = sphere(1, segments)
    bumps = fractal_noise(mesh * 0.8 + 7.3 * seed, 2, seed)
    bumps += 0.12 * fractal_noise(mesh * 4, 3, seed)
    facets = 0.25 * np.abs(fractal_noise(mesh * 1.3 - 3.1 * seed, 1, seed + 50))
    return mesh * (1 + 0.45 * bumps - facets)[..., np.newaxis] * np.array([1.0, 0.62, 0.85])


def stones(detail: float) -> Array:
    """Boulders in the wood, and pebbles along the path."""
    random = Random(71)
    meshes = []
    for largest, count, spread, shift in ((1.7, 16, 17.0, 4.0), (0.45, 90, 3.0, 1.2),
                                          (0.14, 500, 1.6, 0.0)):
        count = int(count * min(1, 60 * detail) + 0.5)
        draws = random.uniform(0, 1, (count, 6))
        ahead = 3.5 + 75 * draws[:, 0] * draws[:, 0]
        z = EYE[1] - ahead
        side = np.where(draws[:, 1] < 0.5, -1, 1) * (shift + spread * draws[:, 2])
        x = path_x(z) + side
        size = largest * (0.35 + 0.65 * draws[:, 3] * draws[:, 3])
        turn = vectors.rotation(np.array([0, 1.0, 0]), 2 * PI * draws[:, 4])
        fineness = 26 * np.sqrt(detail * largest)
        shapes = [stone(int(min(64, max(4, fineness))), seed) for seed in range(STONE_SHAPES)]
        position = on_ground(x, z) + np.array([0, 0.12, 0]) * size[:, np.newaxis]
        for i in range(count):
            meshes.append(vectors.transformed(shapes[i % STONE_SHAPES], turn[i] * size[i])
                          + position[i])
    return np.concatenate(meshes) if meshes else np.empty((0, 3, 3))
