# SPDX-License-Identifier: GPL-3.0-only
"""Runs bwfirt-import and reads what it wrote."""

import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from program import BUILD, complaint, run, snapshot

IMPORT = BUILD / 'bwfirt-import'
WRITTEN = ['scene.camera', 'scene.ra2', 'scene.scene']


@dataclass
class Imported:
    triangles: np.ndarray          # n x 3 x 3
    lights: list[tuple[int, int, float]]
    comments: list[str]            # of the scene file
    camera: dict[str, list[float]]
    output: str                    # what the program said

    def summary(self, key: str) -> str:
        """What stands behind the key, the lines that belong to it joined."""
        lines = [line for line in self.output.splitlines()]
        first = next(i for i, line in enumerate(lines) if line.startswith(key + ' '))
        last = next((i for i, line in enumerate(lines) if i > first and line[0] != ' '), len(lines))
        return ' '.join(line[13:] for line in lines[first:last])


def import_model(model: Path, *options: str, base: str = 'scene',
                 **process) -> subprocess.CompletedProcess[str]:
    """Runs the program in the model's folder."""
    return run(IMPORT, model.name, '-o', base, *options, cwd=model.parent, **process)


def imported(model: Path, *options: str, **process) -> Imported:
    """What the model becomes; the program must succeed."""
    result = import_model(model, *options, **process)
    assert result.returncode == 0, result.stderr
    assert result.stderr == ''
    folder = model.parent
    triangles = np.fromfile(folder / 'scene.ra2', '<f4').reshape(-1, 3, 3)
    scene = (folder / 'scene.scene').read_text().splitlines()
    words = ' '.join(line for line in scene if not line.startswith('#')).split()
    assert words[:2] == ['triangles', 'scene.ra2']
    count, start = int(words[3]), 4
    lights = [(int(words[i]), int(words[i + 1]), float(words[i + 2]))
              for i in range(start, start + 3 * count, 3)]
    camera = {key: [float(value) for value in values] for key, *values in
              map(str.split, (folder / 'scene.camera').read_text().splitlines()) if key != 'type'}
    return Imported(triangles, lights, [line[2:] for line in scene if line.startswith('#')],
                    camera, result.stdout)


def refusal_of(model: Path, *options: str, status: int = 1, **process) -> str:
    """What the program says of a model that it must refuse, leaving the folder as it was."""
    before = snapshot(model.parent)
    result = import_model(model, *options, **process)
    message = complaint(result, IMPORT, status)
    assert result.stdout == ''
    assert snapshot(model.parent) == before
    return message
