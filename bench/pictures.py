# SPDX-License-Identifier: GPL-3.0-only
"""Images of kernels beside each other."""

import math
import struct
from dataclasses import dataclass
from pathlib import Path

import imageio
import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

EXR_MAGIC = b'v/1\x01'
EXR_ROWS_PER_BLOCK = [1, 1, 1, 16, 32, 16, 32, 32, 32, 256]  # by compression
PNG_END = b'IEND\xaeB`\x82'
BRIGHTEST = 0.5  # of a difference image, in linear intensity
FEW = 0.01  # differing pixels of all: they could hardly be seen, and are drawn larger,
SPOTS = 50  # so that as many fit side by side


class BadImage(Exception):
    """An image that is missing, unreadable or of another size."""


@dataclass(frozen=True)
class Difference:
    """How an image differs from the one that it is compared with."""

    pixels: int  # that differ at all
    of: int  # pixels in the image
    largest: float  # absolute difference of a channel, linear
    factor: float  # by which the difference image is brighter than the difference, a power of two
    is_enlarged: bool  # whether pixels are drawn larger, because they are few


def read_linear(path: Path) -> NDArray[np.float32]:
    """The RGB values of an OpenEXR file, as (height, width, 3)."""
    return np.asarray(imageio.imread(path, format='EXR-FI'))[..., :3]


def check_images(base: Path, width: int, height: int) -> None:
    """Whether BASE.exr and BASE.png can be shown.

    @throws BadImage
    """
    for ending, image_format in [('.exr', 'EXR-FI'), ('.png', 'PNG-PIL')]:
        name = f'{base.name}{ending}'
        try:
            data = Path(f'{base}{ending}').read_bytes()
            if ending == '.exr':
                _check_whole(data)
            elif not data.endswith(PNG_END):
                raise ValueError('ends too early')
            found = imageio.imread(f'{base}{ending}', format=image_format).shape
        except FileNotFoundError:
            raise BadImage(f'{name}: there is none') from None
        except Exception as error:  # of any type, depending on the library that reads the image
            raise BadImage(f'{name}: {error}') from None
        if found != (height, width, 3):
            raise BadImage(f'{name} has the shape {found}, not {(height, width, 3)}')


def _check_whole(exr: bytes) -> None:
    """Whether all blocks of scan lines are there: FreeImage never returns from half a file.

    @throws struct.error, ValueError or IndexError otherwise
    """
    if exr[:4] != EXR_MAGIC:
        raise ValueError('is no OpenEXR file')
    position, attributes = 8, {}
    while exr[position] != 0:  # name, type, size, value
        name, kind = exr[position:position + 512].split(b'\0', 2)[:2]
        position += len(name) + len(kind) + 2
        size, = struct.unpack_from('<I', exr, position)
        attributes[name] = exr[position + 4:position + 4 + size]
        position += 4 + size
    _, top, _, bottom = struct.unpack('<4i', attributes[b'dataWindow'])
    blocks = math.ceil((bottom - top + 1) / EXR_ROWS_PER_BLOCK[attributes[b'compression'][0]])
    for offset in struct.unpack_from(f'<{blocks}Q', exr, position + 1):
        _, size = struct.unpack_from('<iI', exr, offset)
        if offset + 8 + size > len(exr):
            raise ValueError('ends too early')


def to_srgb(linear: NDArray[np.float32]) -> NDArray[np.uint8]:
    """IEC 61966-2-1, clipped to [0, 1]."""
    x = np.clip(linear, 0, 1)
    encoded = np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
    return np.rint(255 * encoded).astype(np.uint8)


def enlarged(image: NDArray[np.float32], width: int) -> NDArray[np.float32]:
    """Each pixel as a square of about this width; the brightest one where squares overlap."""
    radius = width // 2
    for axis in (0, 1):
        room = [(radius, radius) if axis == one else (0, 0) for one in range(3)]
        image = sliding_window_view(np.pad(image, room), 2 * radius + 1, axis).max(-1)
    return image


def difference(image: Path, reference: Path, output: Path) -> Difference:
    """Compares two OpenEXR files of a size; writes |a - b|, brightened, where they differ.

    @throws ValueError where their sizes differ
    """
    a, b = read_linear(image), read_linear(reference)
    if a.shape != b.shape:
        raise ValueError(f'{image} and {reference} differ in size')
    absolute = np.abs(np.nan_to_num(a) - np.nan_to_num(b))
    differing = int((a != b).any(axis=2).sum())
    largest = float(absolute.max())
    factor = float(2 ** np.floor(np.log2(BRIGHTEST / largest))) if largest > 0 else 1.0
    of = a.shape[0] * a.shape[1]
    are_few = differing < FEW * of
    if differing:
        shown = enlarged(absolute, a.shape[1] // SPOTS) if are_few else absolute
        imageio.imwrite(output, to_srgb(shown * max(factor, 1)))
    return Difference(differing, of, largest, max(factor, 1), are_few)
