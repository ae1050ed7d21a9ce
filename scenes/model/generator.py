# SPDX-License-Identifier: GPL-3.0-only
"""The command line of the generators, and the files that they write."""

import argparse
import os
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

Array = np.ndarray
SCALES = (10**3, 10**7)  # how many triangles --scale may ask for
CLOSE_ENOUGH = 1.1  # by this factor a scene may have more or fewer triangles than --scale asks for
MOST_TRIALS = 8  # a scene whose triangles come in large steps may not come that close


@dataclass
class Model:
    """A scene before it is written. The triangles of lights come first in the file."""

    geometry: Array
    lights: list[tuple[Array, float]] = field(default_factory=list)  # mesh, radiant exitance
    reflectance: float = 0.7

    def meshes(self) -> list[Array]:
        """All parts in the order of the file."""
        return [mesh for mesh, _ in self.lights] + [self.geometry]

    def __len__(self) -> int:
        return sum(len(mesh) for mesh in self.meshes())


def run(description: str, build: Callable[[float], Model], scalable: bool = True,
        standard: float = 1e6) -> None:
    """Reads the command line and writes BASE.ra2 and BASE.scene.

    `build` makes the scene for a level of detail: 1 is the standard scene, and another level has
    about that many times its triangles. `standard` says roughly how many triangles that scene has,
    so that the search for a scale begins near its end.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument('base', type=Path, metavar='BASE', help='writes BASE.ra2 and BASE.scene')
    if scalable:
        parser.add_argument('--scale', type=_scale, metavar='TRIANGLES',
                            help='the same scene with about so many triangles, '
                                 f'{SCALES[0]:.0e} to {SCALES[1]:.0e}')
    arguments = parser.parse_args()
    scale = getattr(arguments, 'scale', None)
    model = build(1.0) if scale is None else _of_scale(build, scale, standard)
    try:
        _write(arguments.base, model)
    except OSError as error:
        sys.exit(f'{Path(sys.argv[0]).name}: {arguments.base}: {error.strerror}')


def _scale(text: str) -> float:
    triangles = float(text)
    if not SCALES[0] <= triangles <= SCALES[1]:
        raise ValueError
    return triangles


_scale.__name__ = 'number of triangles'  # what argparse calls it in its messages


def _of_scale(build: Callable[[float], Model], triangles: float, standard: float) -> Model:
    """The model that comes closest within a few corrections of the level of detail."""
    def error(model: Model) -> float:
        return max(len(model) / triangles, triangles / len(model))

    detail, best = triangles / standard, None
    for _ in range(MOST_TRIALS):
        model = build(detail)
        if best is None or error(model) < error(best):
            best = model
        if error(best) < CLOSE_ENOUGH:
            break
        detail *= triangles / len(model)
    return best


def _write(base: Path, model: Model) -> None:
    lights, first = [], 0
    for mesh, exitance in model.lights:
        lights.append(f'{first} {first + len(mesh) - 1} {exitance!r}')
        first += len(mesh)
    scene = (f'triangles {base.name}.ra2\nlights {len(lights)} {"  ".join(lights)}\n'
             f'reflectance {model.reflectance!r}\n')
    triangles = np.concatenate([mesh.astype('<f4') for mesh in model.meshes()])
    _replace(base.with_name(base.name + '.ra2'), triangles.tobytes())
    _replace(base.with_name(base.name + '.scene'), scene.encode())
    print(f'{base}.ra2: {len(triangles)} triangles')


def _replace(path: Path, content: bytes) -> None:
    """Writes a file as a whole, or leaves what was there."""
    with tempfile.NamedTemporaryFile(dir=path.parent, prefix=path.name, delete=False) as file:
        try:
            file.write(content)
            file.close()
            os.chmod(file.name, 0o644)
            os.replace(file.name, path)
        except BaseException:
            os.unlink(file.name)
            raise
