# SPDX-License-Identifier: GPL-3.0-only
"""Damaged and hostile models, wrong usage and full disks end an import with one line and no file."""

import json
import os
import resource
import signal
import struct
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import models
from importer import IMPORT, WRITTEN, import_model, imported, refusal_of
from models import FACES, VERTICES, glb, gltf, obj, write_gltf
from program import complaint, mounted_disk, run, wait_for_file


@pytest.fixture
def model(tmp_path: Path) -> Path:
    """A model that is right."""
    path = tmp_path / 'model.obj'
    path.write_text(obj())
    return path


# ---- Usage --------------------------------------------------------------------------------------


@pytest.mark.parametrize('options', [
    ['--scale', '0'], ['--scale', '-1'], ['--scale', 'nan'], ['--scale', '1e39'], ['--scale', ''],
    ['--up', 'w'], ['--up', '+z'], ['--light', '0,1,2,3'], ['--light', '0,1,2,3,4,5'],
    ['--light', '0,0,0,0,1'], ['--light', '0,0,0,1,0'], ['--light', '0,0,0,1,-1'],
    ['--light', '0,0,nan,1,1'], ['--light', '0;0;0;1;1'], ['--light'], ['--colour', '1'],
    ['another.obj'],
], ids=' '.join)
def test_a_wrong_option_is_a_usage_error(model: Path, options: list[str]) -> None:
    assert refusal_of(model, *options, status=2)


@pytest.mark.parametrize('words', [[], ['model.obj'], ['-o', 'scene'], ['model.obj', '-o', ''],
                                   ['model.obj', '-o', 'folder/'], ['', '-o', 'scene']])
def test_a_missing_or_empty_path_is_a_usage_error(model: Path, words: list[str]) -> None:
    complaint(run(IMPORT, *words, cwd=model.parent), IMPORT, 2)


# ---- Files --------------------------------------------------------------------------------------


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    assert refusal_of(tmp_path / 'model.obj') == 'model.obj: no such file'


@pytest.mark.parametrize('make', [Path.mkdir, os.mkfifo, Path.touch],
                         ids=['folder', 'FIFO', 'empty file'])
def test_what_is_no_file_with_content_is_refused(tmp_path: Path, make) -> None:
    make(tmp_path / 'model.obj')
    assert refusal_of(tmp_path / 'model.obj', timeout=10).startswith('model.obj: is ')


@pytest.mark.parametrize('content', [b'nothing that anyone knows', b'\0' * 1000,
                                     np.random.default_rng(1).bytes(4000)])
def test_a_file_of_no_known_format_is_refused(tmp_path: Path, content: bytes) -> None:
    (tmp_path / 'model.data').write_bytes(content)
    assert refusal_of(tmp_path / 'model.data') == 'model.data: is of no format that assimp reads'


@pytest.mark.parametrize('base, message', [('no-such-folder/scene', 'No such file'),
                                           ('taken', 'is a folder'),
                                           ('a "b', 'cannot hold the path')])
def test_outputs_that_cannot_be_written_are_known_before_the_model_is_read(
        model: Path, base: str, message: str) -> None:
    (model.parent / 'taken.scene').mkdir()
    model.write_text('no model at all')
    result = import_model(model, base=base)
    assert message in complaint(result, IMPORT, 1)
    assert sorted(path.name for path in model.parent.iterdir()) == ['model.obj', 'taken.scene']


def test_a_model_is_not_overwritten_by_its_scene(tmp_path: Path) -> None:
    (tmp_path / 'scene.scene').write_text(obj())
    assert 'overwritten' in refusal_of(tmp_path / 'scene.scene')


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of 64 kB."""
    with mounted_disk(tmp_path, '64k') as disk:
        yield disk


def test_a_full_disk_leaves_the_old_scene_as_it_was(small_disk: Path) -> None:
    for name in WRITTEN:
        (small_disk / name).write_text('old')
    faces = np.tile(FACES, (300, 1))
    (small_disk / 'model.ply').write_bytes(models.ply_binary('<', VERTICES, faces))
    message = refusal_of(small_disk / 'model.ply')
    assert message == 'scene.ra2: cannot be written: No space left on device'
    assert [(small_disk / name).read_text() for name in WRITTEN] == ['old'] * 3


def test_a_new_scene_replaces_the_old_one(model: Path) -> None:
    (model.parent / 'scene.scene').write_text('old')
    (model.parent / 'scene.ra2').write_bytes(b'old')
    assert len(imported(model).triangles) == len(FACES)


def test_a_full_standard_output_fails_and_writes_nothing(model: Path) -> None:
    with open('/dev/full', 'w') as full:
        result = import_model(model, capture_output=False, stdout=full, stderr=subprocess.PIPE)
    assert complaint(result, IMPORT, 1).startswith('standard output: ')
    assert list(model.parent.iterdir()) == [model]


def test_an_interrupt_leaves_nothing_behind(tmp_path: Path) -> None:
    with (tmp_path / 'model.obj').open('w') as file:
        for _ in range(200_000):
            file.write('v 1 2 3\nf -1 -1 -1\n')
    with subprocess.Popen([IMPORT, 'model.obj', '-o', 'scene'], cwd=tmp_path,
                          stderr=subprocess.PIPE, text=True) as process:
        wait_for_file(tmp_path, 'scene.*')
        process.send_signal(signal.SIGTERM)
        _, message = process.communicate(timeout=20)
    assert process.returncode == 1
    assert message == 'bwfirt-import: interrupted\n'
    assert [path.name for path in tmp_path.iterdir()] == ['model.obj']


# ---- Damage -------------------------------------------------------------------------------------


@pytest.mark.parametrize('name, content', [
    ('model.ply', models.ply_ascii()), ('model.ply', models.ply_binary('<')),
    ('model.ply', models.ply_binary('>')), ('model.stl', models.stl_ascii()),
    ('model.stl', models.stl_binary()), ('model.glb', glb(gltf()))],
    ids=['PLY ascii', 'PLY little endian', 'PLY big endian', 'STL ascii', 'STL binary', 'GLB'])
def test_a_truncated_model_is_refused_wherever_it_ends(
        tmp_path: Path, name: str, content: bytes) -> None:
    for length in np.linspace(1, len(content) - 16, 12, dtype=int):
        (tmp_path / name).write_bytes(content[:length].rstrip(b'\n'))
        assert refusal_of(tmp_path / name).startswith(f'{name}: ')


@pytest.mark.parametrize('value', ['nan', 'inf', '-inf', '1e39'])
@pytest.mark.parametrize('name', ['model.obj', 'model.ply', 'model.stl'])
def test_a_coordinate_that_is_not_finite_is_refused(tmp_path: Path, name: str, value: str) -> None:
    text = {'obj': obj().encode(), 'ply': models.ply_ascii(), 'stl': models.stl_ascii()}[name[-3:]]
    (tmp_path / name).write_bytes(text.replace(b'0.25', value.encode()))
    assert refusal_of(tmp_path / name).startswith(f'{name}: ')


@pytest.mark.parametrize('value', [np.nan, np.inf])
@pytest.mark.parametrize('name, write', [
    ('model.ply', lambda vertices: models.ply_binary('<', vertices)),
    ('model.stl', lambda vertices: models.stl_binary(vertices[FACES])),
    ('model.glb', lambda vertices: glb(gltf(), vertices.tobytes() + FACES.tobytes()))],
    ids=['PLY', 'STL', 'GLB'])
def test_a_coordinate_that_is_not_finite_is_counted_in_binary_files(
        tmp_path: Path, name: str, write, value: float) -> None:
    vertices = VERTICES.copy()
    vertices[4, 1] = value
    (tmp_path / name).write_bytes(write(vertices))
    assert refusal_of(tmp_path / name) == (
        f'{name}: 4 of its 6 triangles have an infinite or NaN coordinate')


@pytest.mark.parametrize('face', ['1 2 6', '1 2 0', '1 2 -6', '1 2 99999999999999999999'])
def test_an_index_out_of_range_is_refused_in_obj(tmp_path: Path, face: str) -> None:
    (tmp_path / 'model.obj').write_text(obj() + f'f {face}\n')
    assert refusal_of(tmp_path / 'model.obj').startswith('model.obj: ')


@pytest.mark.parametrize('index', [5, 2 ** 31, 2 ** 32 - 1])
@pytest.mark.parametrize('name', ['model.ply', 'model.glb'])
def test_an_index_out_of_range_is_refused_in_binary_files(
        tmp_path: Path, name: str, index: int) -> None:
    faces = FACES.copy()
    faces[3, 1] = index
    (tmp_path / name).write_bytes(models.ply_binary('<', VERTICES, faces) if name == 'model.ply'
                                  else glb(gltf(), VERTICES.tobytes() + faces.tobytes()))
    assert refusal_of(tmp_path / name).startswith(f'{name}: ')
    if name == 'model.glb':
        assert refusal_of(tmp_path / name) == (
            'model.glb: 1 of its 6 triangles refer to vertices that are not there')


@pytest.mark.parametrize('name, content', [
    ('model.obj', 'v 0 0 0\nv 1 0 0\nl 1 2\n'), ('model.obj', '# nothing here at all\n'),
    ('model.ply', models.ply_ascii(VERTICES, FACES[:0]).decode()),
    ('model.gltf', json.dumps(gltf(scenes=[{'nodes': []}]))),
    ('model.stl', 'solid nothing\nendsolid nothing\n')])
def test_a_model_without_triangles_is_refused(tmp_path: Path, name: str, content: str) -> None:
    (tmp_path / name).write_text(content)
    assert refusal_of(tmp_path / name).startswith(f'{name}: ')


@pytest.mark.parametrize('count', [4_000_000_000, 2 ** 64 - 1, 10 ** 30, -1])
@pytest.mark.parametrize('element', ['vertex', 'face'])
@pytest.mark.parametrize('kind', ['ascii', 'binary_little_endian'])
def test_an_absurd_count_is_refused_in_ply(
        tmp_path: Path, kind: str, element: str, count: int) -> None:
    content = models.ply_ascii() if kind == 'ascii' else models.ply_binary()
    old = {'vertex': 5, 'face': 6}[element]
    (tmp_path / 'model.ply').write_bytes(content.replace(f'element {element} {old}'.encode(),
                                                         f'element {element} {count}'.encode()))
    assert refusal_of(tmp_path / 'model.ply', timeout=20).startswith('model.ply: ')


@pytest.mark.parametrize('count', [7, 2 ** 32 - 1])
def test_an_absurd_count_is_refused_in_stl(tmp_path: Path, count: int) -> None:
    content = models.stl_binary()
    (tmp_path / 'model.stl').write_bytes(content[:80] + struct.pack('<I', count) + content[84:])
    assert refusal_of(tmp_path / 'model.stl').startswith('model.stl: ')


# ---- Hostility ----------------------------------------------------------------------------------


@pytest.mark.parametrize('children', [[[0]], [[1], [0]], [[1, 2], [2], [0]]],
                         ids=['itself', 'its parent', 'a longer way'])
def test_nodes_that_contain_themselves_are_refused(tmp_path: Path, children: list) -> None:
    nodes = [{'mesh': 0, 'children': indices} for indices in children]
    write_gltf(tmp_path / 'model.gltf', gltf(nodes=nodes))
    assert refusal_of(tmp_path / 'model.gltf').startswith('model.gltf: ')


def test_instances_without_number_are_refused(tmp_path: Path) -> None:
    nodes = [{'children': [i + 1, i + 1]} for i in range(40)] + [{'mesh': 0}]
    write_gltf(tmp_path / 'model.gltf', gltf(nodes=nodes))

    def small() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (400_000_000, 400_000_000))

    assert refusal_of(tmp_path / 'model.gltf', preexec_fn=small).startswith('model.gltf: ')


def test_a_crash_of_the_reader_is_told_in_one_line(tmp_path: Path) -> None:
    """assimp descends to the children of a node by recursion, here beyond the end of the stack."""
    nodes = [{'children': [i + 1]} for i in range(50_000)] + [{'mesh': 0}]
    write_gltf(tmp_path / 'model.gltf', gltf(nodes=nodes))
    assert refusal_of(tmp_path / 'model.gltf').startswith(
        'model.gltf: crashes its reader: signal 11')


def test_nodes_of_some_depth_are_no_trouble(tmp_path: Path) -> None:
    nodes = [{'children': [i + 1], 'translation': [1, 0, 0]} for i in range(1000)] + [{'mesh': 0}]
    write_gltf(tmp_path / 'model.gltf', gltf(nodes=nodes))
    result = imported(tmp_path / 'model.gltf', '--scale', '1')
    np.testing.assert_allclose(result.triangles, models.TRIANGLES + [1000, 0, 0], atol=1e-3)


@pytest.mark.parametrize('name', ['fifo', '/dev/zero', 'model.obj', 'folder', 'missing.mtl'])
def test_a_material_library_that_is_no_file_of_materials_is_left_out(
        tmp_path: Path, name: str) -> None:
    os.mkfifo(tmp_path / 'fifo')
    (tmp_path / 'folder').mkdir()
    (tmp_path / 'model.obj').write_text(f'mtllib {name}\nusemtl lamp\n{obj()}')
    result = imported(tmp_path / 'model.obj', timeout=20)
    assert len(result.triangles) == len(FACES)


def test_a_buffer_that_is_a_device_is_refused(tmp_path: Path) -> None:
    model = gltf()
    model['buffers'][0]['uri'] = '/dev/zero'
    (tmp_path / 'model.gltf').write_text(json.dumps(model))
    assert refusal_of(tmp_path / 'model.gltf', timeout=20).startswith('model.gltf: ')


@pytest.mark.parametrize('change', [
    {'nodes': [{'mesh': 7}]}, {'scenes': [{'nodes': [7]}]}, {'scene': 7},
    {'nodes': [{'mesh': -1}]}, {'meshes': 'none'}, {'accessors': []}, {'bufferViews': []},
    {'buffers': [{'byteLength': 10 ** 12}]}, {'nodes': [{'mesh': 0, 'matrix': [1e300] * 16}]},
    {'nodes': [{'mesh': 0, 'scale': [1e38, 1e38, 1e38], 'children': []}]},
], ids=str)
def test_gltf_that_contradicts_itself_ends_in_a_scene_or_one_line(
        tmp_path: Path, change: dict) -> None:
    write_gltf(tmp_path / 'model.gltf', gltf(**change))
    result = import_model(tmp_path / 'model.gltf', timeout=20)
    if result.returncode != 0:
        complaint(result, IMPORT, 1)
        assert [path.name for path in tmp_path.iterdir()] == ['model.gltf']


def test_a_scale_beyond_single_precision_is_refused(model: Path) -> None:
    assert '--scale' in refusal_of(model, '--scale', '3e38')


def test_a_light_that_vanishes_is_refused(model: Path) -> None:
    assert '--light' in refusal_of(model, '--light', '1,1,1,1e-30,1')
