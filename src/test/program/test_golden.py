# SPDX-License-Identifier: GPL-3.0-only
"""Every kernel renders the Cornell box as it is stored in golden/cornell.png.

Bound: at most one pixel in a thousand may differ by more than one step of 255, and the average
intensity may differ by 1e-5 of itself, which leaves room for a kernel that answers a few rays at
edges differently. To renew the picture after a change that is meant to change it, run simple-bvh
with OPTIONS and look at what comes out.
"""

from pathlib import Path

import numpy as np
import pytest

from image import read_png
from program import BUILD, REPOSITORY, render

GOLDEN = Path(__file__).parent / 'golden' / 'cornell.png'
AVERAGE_INTENSITY = 0.27767052360860783
CAMERA = REPOSITORY / 'scenes' / 'cornell.camera'
SCENE = REPOSITORY / 'scenes' / 'cornell.scene'
OPTIONS = ['--camera', CAMERA, '--size', '80x60', '--passes', '16', '--seed', '1']
KERNELS = [path.name for path in sorted((REPOSITORY / 'src' / 'kernel').glob('*/'))
           if (BUILD / f'bwfirt-{path.name}').exists()]  # one without its library is not built


@pytest.mark.parametrize('program', KERNELS, indirect=True)
def test_the_cornell_box_looks_as_it_always_did(program: Path, tmp_path: Path) -> None:
    report = render(program, tmp_path, *OPTIONS, scene=SCENE)
    image = read_png(tmp_path / 'image.png').astype(int)
    golden = read_png(GOLDEN).astype(int)
    assert image.shape == golden.shape
    different = np.abs(image - golden).max(axis=2) > 1
    assert different.mean() <= 1e-3
    assert report['average_intensity'][0] == pytest.approx(AVERAGE_INTENSITY, rel=1e-5)
