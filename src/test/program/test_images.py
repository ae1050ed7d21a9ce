# SPDX-License-Identifier: GPL-3.0-only
"""The images of a batch run: their files, their content, and what they may not depend on."""

import struct
from pathlib import Path

import numpy as np
import pytest

from box import replace_line
from image import read_exr, read_png, srgb
from program import render

BOTH_KERNELS = pytest.mark.parametrize('program', ['simple-bvh', 'funky-kd'], indirect=True)


def image_bytes(program: Path, folder: Path, *options: str) -> bytes:
    render(program, folder, '--size', '70x50', '--passes', '18', *options)
    return (folder / 'image.exr').read_bytes()


def normals_seen(program: Path, folder: Path, direction: str, film_size: float,
                 size: str) -> np.ndarray:
    """The normals of the box as its centre sees them: from [-1, 1] to [0, 1]."""
    replace_line(folder / 'box.camera', 'position', 'position 0 0 0')
    replace_line(folder / 'box.camera', 'direction', f'direction {direction}')
    replace_line(folder / 'box.camera', 'up', 'up 0 1 0')
    replace_line(folder / 'box.camera', 'filmSizeY', f'filmSizeY {film_size}')
    render(program, folder, '--view', 'normals', '--size', size)
    return read_exr(folder / 'image.exr')


@pytest.mark.parametrize('width, height', [(16, 12), (1, 1), (33, 17), (5, 40)])
def test_both_image_files_have_the_size_that_was_asked_for(
        program: Path, folder: Path, width: int, height: int) -> None:
    render(program, folder, '--size', f'{width}x{height}')
    assert struct.unpack('>II', (folder / 'image.png').read_bytes()[16:24]) == (width, height)
    assert read_png(folder / 'image.png').shape == (height, width, 3)
    assert read_exr(folder / 'image.exr').shape == (height, width, 3)


def test_the_png_is_the_exr_in_srgb(program: Path, folder: Path) -> None:
    render(program, folder, '--size', '40x30', '--passes', '8')
    linear = read_exr(folder / 'image.exr')
    encoded = read_png(folder / 'image.png')
    assert np.abs(encoded - srgb(linear)).max() < 0.51
    assert encoded.std() > 10


def test_the_average_intensity_is_the_average_of_the_image(program: Path, folder: Path) -> None:
    report = render(program, folder, '--size', '40x30')
    average = read_exr(folder / 'image.exr').astype(float).mean(axis=(0, 1))
    assert report['average_intensity'] == pytest.approx(average, rel=1e-6)
    assert average.min() > 0


def test_grey_materials_give_a_grey_image(program: Path, folder: Path) -> None:
    render(program, folder)
    image = read_exr(folder / 'image.exr')
    assert (image[..., 0] == image[..., 1]).all() and (image[..., 0] == image[..., 2]).all()


def test_the_sensor_response_scales_the_image(program: Path, folder: Path) -> None:
    once = render(program, folder)['average_intensity']
    replace_line(folder / 'box.camera', 'sensorResponse', 'sensorResponse 4')
    assert render(program, folder)['average_intensity'] == pytest.approx(np.multiply(once, 4))


@BOTH_KERNELS
@pytest.mark.parametrize('options', [('--threads', '1'), ('--threads', '5'), ('--in-flight', '2'),
                                     ('--in-flight', '16'), ('--in-flight', '64'),
                                     ('--in-flight', '16', '--threads', '5')], ids=' '.join)
def test_threads_and_paths_in_flight_do_not_change_a_bit(
        program: Path, folder: Path, options: tuple[str, ...]) -> None:
    assert image_bytes(program, folder, *options) == image_bytes(program, folder)


def test_another_seed_gives_another_image(program: Path, folder: Path) -> None:
    images = {image_bytes(program, folder, '--seed', seed)
              for seed in ['0', '1', '2', '4294967297', '18446744073709551615']}
    assert len(images) == 5


def test_the_seed_is_1_unless_given(program: Path, folder: Path) -> None:
    assert image_bytes(program, folder) == image_bytes(program, folder, '--seed', '1')


def test_another_pass_has_other_samples(program: Path, folder: Path) -> None:
    render(program, folder, '--passes', '1')
    first = read_exr(folder / 'image.exr')
    render(program, folder, '--passes', '2')
    assert (read_exr(folder / 'image.exr') != first).mean() > 0.5




@BOTH_KERNELS
@pytest.mark.parametrize('view', ['normals', 'triangles', 'distance', 'queries'])
def test_every_view_shows_something(program: Path, folder: Path, view: str) -> None:
    render(program, folder, '--view', view)
    image = read_png(folder / 'image.png')
    assert image.reshape(-1, 3).max(axis=1).min() > 0, 'a pixel is black'
    assert len(np.unique(image.reshape(-1, 3), axis=0)) > 2


@pytest.mark.parametrize('direction, colour', [
    ('0 0 -1', (0.5, 0.5, 1)), ('0 0 1', (0.5, 0.5, 0)),
    ('3 0 0', (0, 0.5, 0.5)), ('-3 0 0', (1, 0.5, 0.5)),
])
def test_a_wall_that_faces_the_camera_has_the_colour_of_its_normal(
        program: Path, folder: Path, direction: str, colour: tuple) -> None:
    image = normals_seen(program, folder, direction, 0.5, '4x3')
    assert image == pytest.approx(np.broadcast_to(colour, (3, 4, 3)), abs=1e-6)


def test_the_first_row_is_the_top_and_direction_times_up_is_the_right(
        program: Path, folder: Path) -> None:
    image = normals_seen(program, folder, '0 0 -1', 4, '16x16')
    ceiling, floor, left, right = (0.5, 0, 0.5), (0.5, 1, 0.5), (1, 0.5, 0.5), (0, 0.5, 0.5)
    seen = [image[0, 8], image[15, 8], image[8, 0], image[8, 15]]
    assert np.array(seen) == pytest.approx(np.array([ceiling, floor, left, right]), abs=1e-6)


def test_the_film_is_as_wide_as_the_shape_of_the_image_demands(
        program: Path, folder: Path) -> None:
    blue = normals_seen(program, folder, '0 0 -1', 1, '64x16')[..., 2]
    assert (blue[:, 16:48] == 1).all(), 'the wall behind, 90 degrees wide'
    assert (blue[:, :16] == 0.5).all() and (blue[:, 48:] == 0.5).all(), 'the walls at its sides'
