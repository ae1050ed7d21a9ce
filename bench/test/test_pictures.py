# SPDX-License-Identifier: GPL-3.0-only
"""Images of kernels are compared, and those that cannot be are told of."""

from pathlib import Path

import imageio
import numpy as np
import pytest

from pictures import BadImage, check_images, difference, to_srgb
from report import pictures_of
from stored import SIZE, Stored, write_images

WIDTH, HEIGHT = SIZE


def write_exr(path: Path, values: object) -> Path:
    imageio.imwrite(path, np.asarray(values, np.float32), format='EXR-FI')
    return path


def test_equal_images_differ_nowhere(tmp_path: Path) -> None:
    write_images(tmp_path / 'a')
    write_images(tmp_path / 'b')
    found = difference(tmp_path / 'a.exr', tmp_path / 'b.exr', tmp_path / 'c.png')
    assert (found.pixels, found.of, found.largest) == (0, WIDTH * HEIGHT, 0)
    assert not (tmp_path / 'c.png').exists()


def test_a_difference_is_counted_and_brightened(tmp_path: Path) -> None:
    """1/8 is brightened by 4, to 1/2."""
    a = np.zeros((2, 3, 3), np.float32)
    b = a.copy()
    b[0, 0] = (0.125, 0, 0)
    b[1, 2] = (0, 0, 0.0625)
    found = difference(write_exr(tmp_path / 'a.exr', a), write_exr(tmp_path / 'b.exr', b),
                       tmp_path / 'c.png')
    assert (found.pixels, found.of, found.factor) == (2, 6, 4)
    assert found.largest == 0.125
    shown = imageio.imread(tmp_path / 'c.png')
    assert np.argwhere(shown.any(axis=2)).tolist() == [[0, 0], [1, 2]]
    assert shown[0, 0].tolist() == [188, 0, 0]


def test_few_pixels_that_differ_are_drawn_larger(tmp_path: Path) -> None:
    """In 100 columns, of which 50 spots fill the width: squares of 3 pixels, cut at the edge."""
    a = np.zeros((20, 100, 3), np.float32)
    b = a.copy()
    b[10, 50] = b[0, 99] = 0.5
    found = difference(write_exr(tmp_path / 'a.exr', a), write_exr(tmp_path / 'b.exr', b),
                       tmp_path / 'c.png')
    assert (found.pixels, found.is_enlarged) == (2, True)
    shown = np.argwhere(imageio.imread(tmp_path / 'c.png').any(axis=2)).tolist()
    assert shown == [[0, 98], [0, 99], [1, 98], [1, 99],
                     *([row, column] for row in (9, 10, 11) for column in (49, 50, 51))]


def test_nan_is_a_difference(tmp_path: Path) -> None:
    a = np.ones((2, 2, 3), np.float32)
    b = a.copy()
    b[0, 0, 0] = np.nan
    found = difference(write_exr(tmp_path / 'a.exr', a), write_exr(tmp_path / 'b.exr', b),
                       tmp_path / 'c.png')
    assert found.pixels == 1


@pytest.mark.parametrize('linear, encoded', [(0, 0), (1, 255), (2, 255), (-1, 0), (0.5, 188),
                                             (0.0031308, 10)])
def test_srgb(linear: float, encoded: int) -> None:
    assert to_srgb(np.array([linear], np.float32)).tolist() == [encoded]


def test_images_of_the_right_size_are_good(tmp_path: Path) -> None:
    write_images(tmp_path / 'a')
    check_images(tmp_path / 'a', WIDTH, HEIGHT)


@pytest.mark.parametrize('ending', ['.exr', '.png'])
@pytest.mark.parametrize('how, message', [('missing', 'there is none'), ('empty', ''),
                                          ('half', ''), ('text', ''), ('short', '')])
def test_an_image_that_cannot_be_shown_is_refused(tmp_path: Path, ending: str, how: str,
                                                  message: str) -> None:
    write_images(tmp_path / 'a')
    path = tmp_path / f'a{ending}'
    content = path.read_bytes()
    path.unlink()
    if how != 'missing':
        path.write_bytes({'empty': b'', 'half': content[:len(content) // 2],
                          'text': b'no image', 'short': content[:-20]}[how])
    with pytest.raises(BadImage, match=f'^a{ending}: {message}'):
        check_images(tmp_path / 'a', WIDTH, HEIGHT)


def test_an_image_of_another_size_is_refused(tmp_path: Path) -> None:
    write_images(tmp_path / 'a')
    with pytest.raises(BadImage, match='has the shape'):
        check_images(tmp_path / 'a', WIDTH + 1, HEIGHT)


def test_each_kernel_is_compared_with_simple_bvh(tmp_path: Path) -> None:
    stored = Stored(tmp_path / 'results')
    for kernel, exposure in [('a', 1), ('simple-bvh', 1), ('wrong', 1.5), ('none', None)]:
        stored.run('box', kernel, exposure=exposure)
    pictures = pictures_of(stored.measured(), 'box', 0, tmp_path)
    assert [(picture.kernel, picture.difference and picture.difference.pixels)
            for picture in pictures] == [('simple-bvh', None), ('a', 0), ('wrong', 1)]
    assert [picture.kernel for picture in pictures if picture.difference_file] == ['wrong']


def test_images_of_another_size_are_not_compared(tmp_path: Path) -> None:
    """As where kernels were measured one after the other, with other options."""
    stored = Stored(tmp_path / 'results')
    stored.run('box', 'simple-bvh')
    large = stored.run('box', 'large', report={'width': 9, 'height': 9})
    write_exr(large.file('.exr'), np.zeros((9, 9, 3)))
    pictures = pictures_of(stored.measured(), 'box', 0, tmp_path)
    assert [picture.kernel for picture in pictures] == ['simple-bvh']
