# SPDX-License-Identifier: GPL-3.0-only
"""Every camera of the standard scenes has a reference that rendering confirms."""

import re
from pathlib import Path

import pytest

from program import REPOSITORY, render

CAMERAS = sorted((REPOSITORY / 'scenes').glob('*.camera'))
REFERENCE = re.compile(r'^referenceAverageIntensity \((\S+) \1 \1\)  # simple-bvh, 640x480, '
                       r'(\d+) passes, seed \d+; standard error (\S+)$', re.M)


def by_name(camera: Path) -> str:
    return camera.stem


@pytest.mark.parametrize('camera', CAMERAS, ids=by_name)
def test_the_reference_is_exact_to_a_thousandth(camera: Path) -> None:
    found = REFERENCE.search(camera.read_text(encoding='utf-8'))
    assert found
    assert float(found[3]) < 1e-3 * float(found[1])


@pytest.mark.parametrize('program', ['funky-kd'], indirect=True)
@pytest.mark.parametrize('camera', CAMERAS, ids=by_name)
def test_rendering_confirms_the_reference(program: Path, camera: Path, tmp_path: Path) -> None:
    """Within five standard errors of this small image."""
    scene = camera.with_name(camera.stem.split('-')[0] + '.scene')
    report = render(program, tmp_path, '--camera', camera, '--size', '64x48', '--passes', '16',
                    scene=scene)
    difference = report['average_intensity'][0] - report['reference_average_intensity'][0]
    assert abs(difference) < 5 * report['standard_error'][0]
    assert report['warnings'] == []
