# SPDX-License-Identifier: GPL-3.0-only
"""Triangles at the limits of single precision end in a finite image."""

from pathlib import Path

import numpy as np
import pytest

from box import box_triangles, replace_line, write_triangles
from image import read_exr
from program import render

pytestmark = pytest.mark.parametrize('program', ['simple-bvh', 'funky-kd'], indirect=True)

DENORMAL = 1e-41
EXTREMES = [1e-12, 1e17, 3e38, DENORMAL]


def assert_finite_image(folder: Path, report: dict) -> None:
    assert np.isfinite(report['average_intensity']).all()
    assert np.isfinite(report['standard_error']).all()
    assert np.isfinite(read_exr(folder / 'image.exr')).all()


@pytest.mark.parametrize('scale', EXTREMES)
def test_a_box_of_extreme_size_gives_a_finite_image(
        program: Path, folder: Path, scale: float) -> None:
    write_triangles(folder / 'box.ra2', scale * box_triangles())
    replace_line(folder / 'box.camera', 'position', 'position 0 0 0')
    assert_finite_image(folder, render(program, folder, '--passes', '3'))


@pytest.mark.parametrize('scale', [1e-12, 1e17, DENORMAL])
def test_a_box_of_extreme_size_keeps_its_normals(
        program: Path, folder: Path, scale: float) -> None:
    replace_line(folder / 'box.camera', 'position', 'position 0 0 0')
    expected = render(program, folder, '--view', 'normals')
    write_triangles(folder / 'box.ra2', scale * box_triangles())
    report = render(program, folder, '--view', 'normals')
    assert_finite_image(folder, report)
    assert report['average_intensity'] == pytest.approx(expected['average_intensity'], rel=1e-3)


@pytest.mark.parametrize('scale', EXTREMES)
def test_extreme_triangles_in_a_box_give_a_finite_image(
        program: Path, folder: Path, scale: float) -> None:
    random = scale * np.random.default_rng(1).uniform(-1, 1, (50, 3, 3))
    write_triangles(folder / 'box.ra2', np.concatenate([box_triangles(), random]))
    report = render(program, folder, '--passes', '3')
    assert_finite_image(folder, report)
    assert min(report['average_intensity']) > 0


@pytest.mark.parametrize('position', ['0 0 1e17', '0 0 3e38', '0 0 1e-310'])
def test_a_camera_at_an_extreme_position_gives_a_finite_image(
        program: Path, folder: Path, position: str) -> None:
    replace_line(folder / 'box.camera', 'position', f'position {position}')
    assert_finite_image(folder, render(program, folder))


@pytest.mark.parametrize('key, values', [
    ('direction', '0 0 -1e-30'), ('direction', '0 0 -1e30'), ('up', '0 1e-30 0'),
    ('up', '0 1e30 0'), ('depth', '1e30'), ('filmSizeY', '1e-30'),
])
def test_a_camera_of_extreme_but_legal_values_sees_the_box(
        program: Path, folder: Path, key: str, values: str) -> None:
    replace_line(folder / 'box.camera', key, f'{key} {values}')
    report = render(program, folder, '--view', 'normals')
    assert_finite_image(folder, report)
    assert min(report['average_intensity']) > 0


def test_many_identical_triangles_give_a_finite_image(program: Path, folder: Path) -> None:
    triangle = [[-1, -1, -0.5], [1, -1, -0.5], [0, 1, -0.5]]
    write_triangles(folder / 'box.ra2', np.array([triangle] * 20_000))
    replace_line(folder / 'box.scene', 'lights', 'lights 1 0 19999 10')
    report = render(program, folder)
    assert_finite_image(folder, report)
    assert min(report['average_intensity']) > 0


def test_one_huge_triangle_among_many_tiny_ones_gives_a_finite_image(
        program: Path, folder: Path) -> None:
    random = np.random.default_rng(1)
    tiny = random.uniform(-0.9, 0.9, (20_000, 1, 3)) + random.uniform(0, 1e-3, (20_000, 3, 3))
    huge = [[[-1e6, -0.99, -1e6], [0, -0.99, 1e6], [1e6, -0.99, -1e6]]]
    write_triangles(folder / 'box.ra2', np.concatenate([box_triangles(), huge, tiny]))
    report = render(program, folder)
    assert_finite_image(folder, report)
    assert min(report['average_intensity']) > 0


def test_triangles_that_are_not_finite_are_counted_and_do_not_change_the_image(
        program: Path, folder: Path) -> None:
    expected = render(program, folder)
    image = (folder / 'image.exr').read_bytes()
    broken = np.tile(box_triangles()[:1], (4, 1, 1))
    broken[0, 0, 0] = np.nan
    broken[1, 1, 1] = np.inf
    broken[2, 2, 2] = -np.inf
    broken[3] = np.nan
    write_triangles(folder / 'box.ra2', np.concatenate([broken[:2], box_triangles(), broken[2:]]))
    replace_line(folder / 'box.scene', 'lights', 'lights 1 14 15 10')
    report = render(program, folder)
    assert (folder / 'image.exr').read_bytes() == image
    assert report['rays'] | {'per_second': 0} == expected['rays'] | {'per_second': 0}
    assert expected['warnings'] == []
    warning, = report['warnings']
    assert warning.startswith('4 triangles') and 'NaN' in warning


@pytest.mark.parametrize('coordinate, count', [(128, 0), (-128, 0), (128.01, 1), (-500, 1)])
def test_a_coordinate_beyond_128_gives_a_warning(
        program: Path, folder: Path, coordinate: float, count: int) -> None:
    far = [[[0, 0, coordinate], [1, 0, coordinate], [0, 1, coordinate]]]
    write_triangles(folder / 'box.ra2', np.concatenate([box_triangles(), far]))
    warnings = render(program, folder)['warnings']
    assert len(warnings) == count and all('128' in warning for warning in warnings)
