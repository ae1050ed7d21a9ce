# SPDX-License-Identifier: GPL-3.0-only
"""Reads the image files that bwfirt writes, and no others."""

import struct
import zlib
from pathlib import Path

import numpy as np

EXR_ZIP = 3
ROWS_PER_ZIP_BLOCK = 16


def read_png(path: Path) -> np.ndarray:
    """Rows, columns and 8-bit RGB of a PNG that is not interlaced (W3C, PNG specification)."""
    data = path.read_bytes()
    assert data[:8] == b'\x89PNG\r\n\x1a\n'
    chunks, position = [], 8
    while position < len(data):
        length, kind = struct.unpack_from('>I4s', data, position)
        body = data[position + 8:position + 8 + length]
        checksum, = struct.unpack_from('>I', data, position + 8 + length)
        assert checksum == zlib.crc32(kind + body)
        chunks.append((kind, body))
        position += 12 + length
    assert chunks[0][0] == b'IHDR' and chunks[-1] == (b'IEND', b'')
    width, height, *layout = struct.unpack('>IIBBBBB', chunks[0][1])
    assert layout == [8, 2, 0, 0, 0], 'not RGB of 8 bits without interlacing'

    content = zlib.decompress(b''.join(body for kind, body in chunks if kind == b'IDAT'))
    lines = np.frombuffer(content, np.uint8).reshape(height, 1 + 3 * width)
    rows = np.zeros((height + 1, width + 1, 3), int)  # with zeros above and to the left
    for y, line in enumerate(lines, start=1):
        for x, filtered in enumerate(line[1:].reshape(width, 3).astype(int), start=1):
            left, above, corner = rows[y, x - 1], rows[y - 1, x], rows[y - 1, x - 1]
            prediction = [0, left, above, (left + above) // 2, paeth(left, above, corner)][line[0]]
            rows[y, x] = (filtered + prediction) % 256
    return rows[1:, 1:].astype(np.uint8)


def paeth(left: np.ndarray, above: np.ndarray, corner: np.ndarray) -> np.ndarray:
    estimate = left + above - corner
    to_left, to_above, to_corner = (abs(estimate - value) for value in (left, above, corner))
    return np.where((to_left <= to_above) & (to_left <= to_corner), left,
                    np.where(to_above <= to_corner, above, corner))


def read_exr(path: Path) -> np.ndarray:
    """Rows, columns and float RGB of an OpenEXR file of scan lines in ZIP compression."""
    data = path.read_bytes()
    assert struct.unpack_from('<II', data) == (20000630, 2)
    attributes, position = {}, 8
    while data[position] != 0:
        name, kind = data[position:].split(b'\0', 2)[:2]
        position += len(name) + len(kind) + 2
        size, = struct.unpack_from('<I', data, position)
        attributes[name] = data[position + 4:position + 4 + size]
        position += 4 + size
    assert attributes[b'compression'] == bytes([EXR_ZIP])
    float_channel = struct.pack('<IIII', 2, 0, 1, 1)
    assert attributes[b'channels'] == b''.join(
        name + b'\0' + float_channel for name in (b'B', b'G', b'R')) + b'\0'
    left, top, right, bottom = struct.unpack('<4i', attributes[b'dataWindow'])
    width, height = right - left + 1, bottom - top + 1

    blocks = -(-height // ROWS_PER_ZIP_BLOCK)
    image = np.zeros((height, 3, width), np.float32)
    for offset in struct.unpack_from(f'<{blocks}Q', data, position + 1):
        y, size = struct.unpack_from('<iI', data, offset)
        rows = image[y - top:y - top + ROWS_PER_ZIP_BLOCK]
        stored = data[offset + 8:offset + 8 + size]
        rows[:] = np.frombuffer(stored if size == rows.nbytes else unzip_exr(stored),
                                '<f4').reshape(rows.shape)
    return image[:, ::-1].transpose(0, 2, 1)


def unzip_exr(stored: bytes) -> bytes:
    """Undoes deflate, the differences between bytes, and their order: first even, then odd ones."""
    differences = np.frombuffer(zlib.decompress(stored), np.uint8).astype(int)
    differences[1:] -= 128
    halves = np.cumsum(differences).astype(np.uint8)
    half = (len(halves) + 1) // 2
    content = np.empty_like(halves)
    content[::2], content[1::2] = halves[:half], halves[half:]
    return content.tobytes()


def srgb(linear: np.ndarray) -> np.ndarray:
    """IEC 61966-2-1, from [0, 1] to 0…255, not rounded."""
    value = np.clip(linear.astype(float), 0, 1)
    return 255 * np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)
