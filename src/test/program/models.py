# SPDX-License-Identifier: GPL-3.0-only
"""Writes models in the formats that people have them in: OBJ, PLY, STL, glTF and GLB."""

import base64
import copy
import json
import struct
from pathlib import Path

import numpy as np

# A pyramid over a square: five vertices, six triangles, no coordinate the same in all of them.
VERTICES = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1], [0.25, 1.5, 0]], '<f4')
FACES = np.array([[0, 1, 2], [0, 2, 3], [0, 4, 1], [1, 4, 2], [2, 4, 3], [3, 4, 0]], '<u4')
TRIANGLES = VERTICES[FACES]


def obj(vertices: np.ndarray = VERTICES, faces: np.ndarray = FACES) -> str:
    return ''.join(f'v {x!r} {y!r} {z!r}\n' for x, y, z in vertices.tolist()) + ''.join(
        'f ' + ' '.join(str(index + 1) for index in face) + '\n' for face in faces)


def ply_header(kind: str, vertices: int, faces: int) -> str:
    return (f'ply\nformat {kind} 1.0\nelement vertex {vertices}\nproperty float x\n'
            f'property float y\nproperty float z\nelement face {faces}\n'
            'property list uchar uint vertex_indices\nend_header\n')


def ply_ascii(vertices: np.ndarray = VERTICES, faces: np.ndarray = FACES) -> bytes:
    lines = [' '.join(map(repr, vertex)) for vertex in vertices.tolist()]
    lines += [' '.join(map(str, [len(face), *face])) for face in faces.tolist()]
    return (ply_header('ascii', len(vertices), len(faces)) + '\n'.join(lines) + '\n').encode()


def ply_binary(order: str = '<', vertices: np.ndarray = VERTICES,
               faces: np.ndarray = FACES) -> bytes:
    kind = {'<': 'binary_little_endian', '>': 'binary_big_endian'}[order]
    body = np.zeros(len(faces), [('count', 'u1'), ('indices', order + 'u4', faces.shape[1])])
    body['count'], body['indices'] = faces.shape[1], faces
    return (ply_header(kind, len(vertices), len(faces)).encode()
            + vertices.astype(order + 'f4').tobytes() + body.tobytes())


def stl_ascii(triangles: np.ndarray = TRIANGLES) -> bytes:
    text = 'solid model\n'
    for triangle in triangles.tolist():
        text += ' facet normal 0 0 0\n  outer loop\n'
        text += ''.join(f'   vertex {x!r} {y!r} {z!r}\n' for x, y, z in triangle)
        text += '  endloop\n endfacet\n'
    return (text + 'endsolid model\n').encode()


def stl_binary(triangles: np.ndarray = TRIANGLES) -> bytes:
    facets = np.zeros(len(triangles), [('normal', '<f4', 3), ('corners', '<f4', (3, 3)),
                                       ('attribute', '<u2')])
    facets['corners'] = triangles
    return b'\0' * 80 + struct.pack('<I', len(triangles)) + facets.tobytes()


# One mesh of the pyramid and one node; tests add to a deep copy of it.
GLTF = {
    'asset': {'version': '2.0'},
    'scene': 0,
    'scenes': [{'nodes': [0]}],
    'nodes': [{'mesh': 0}],
    'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1}]}],
    'accessors': [
        {'bufferView': 0, 'componentType': 5126, 'count': len(VERTICES), 'type': 'VEC3',
         'min': VERTICES.min(axis=0).tolist(), 'max': VERTICES.max(axis=0).tolist()},
        {'bufferView': 1, 'componentType': 5125, 'count': FACES.size, 'type': 'SCALAR'}],
    'bufferViews': [
        {'buffer': 0, 'byteOffset': 0, 'byteLength': VERTICES.nbytes},
        {'buffer': 0, 'byteOffset': VERTICES.nbytes, 'byteLength': FACES.nbytes}],
    'buffers': [{'byteLength': VERTICES.nbytes + FACES.nbytes}],
}
BUFFER = VERTICES.tobytes() + FACES.tobytes()


def gltf(**changes: object) -> dict:
    """A copy of GLTF, with other values for some of its keys."""
    return copy.deepcopy(GLTF) | changes


def write_gltf(path: Path, model: dict, buffer: bytes = BUFFER) -> None:
    """With the buffer inside, as base64."""
    model = copy.deepcopy(model)
    model['buffers'][0]['uri'] = ('data:application/octet-stream;base64,'
                                  + base64.b64encode(buffer).decode())
    path.write_text(json.dumps(model))


def write_gltf_and_bin(path: Path, model: dict, buffer: bytes = BUFFER) -> None:
    """With the buffer in a file of its own."""
    model = copy.deepcopy(model)
    model['buffers'][0]['uri'] = path.with_suffix('.bin').name
    path.with_suffix('.bin').write_bytes(buffer)
    path.write_text(json.dumps(model))


def glb(model: dict, buffer: bytes = BUFFER) -> bytes:
    text = json.dumps(model).encode()
    text += b' ' * (-len(text) % 4)
    chunks = (struct.pack('<I4s', len(text), b'JSON') + text
              + struct.pack('<I4s', len(buffer), b'BIN\0') + buffer)
    return struct.pack('<4sII', b'glTF', 2, 12 + len(chunks)) + chunks
