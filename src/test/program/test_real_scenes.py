# SPDX-License-Identifier: GPL-3.0-only
"""Kernels agree on real scenes, which the environment variable BWFIRT_SCENES points to: a folder
with NAME.scene and NAME.camera."""

import os
from pathlib import Path

import pytest

from program import BUILD, render

SCENES = os.environ.get('BWFIRT_SCENES')


def average_intensity(kernel: str, name: str, folder: Path) -> list[float]:
    scene = Path(SCENES).resolve() / name
    return render(BUILD / f'bwfirt-{kernel}', folder, '--camera', f'{scene}.camera', '--size',
                  '80x60', scene=f'{scene}.scene')['average_intensity']


@pytest.mark.skipif(not SCENES, reason='the environment variable BWFIRT_SCENES is not set')
@pytest.mark.parametrize('name', ['sponza', 'conference'])
def test_simple_bvh_and_funky_kd_agree(tmp_path: Path, name: str) -> None:
    if not (Path(SCENES) / f'{name}.scene').exists():
        pytest.skip(f'there is no {name}.scene in the folder BWFIRT_SCENES')
    expected = average_intensity('simple-bvh', name, tmp_path)
    assert min(expected) > 0
    assert average_intensity('funky-kd', name, tmp_path) == pytest.approx(expected, rel=1e-4)
