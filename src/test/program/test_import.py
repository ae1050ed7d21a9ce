# SPDX-License-Identifier: GPL-3.0-only
"""Models become scenes: every format gives the same triangles, placed, lit and seen as promised."""

import os
from pathlib import Path

import numpy as np
import pytest

import models
from importer import IMPORT, WRITTEN, imported
from models import FACES, TRIANGLES, VERTICES, gltf, obj, write_gltf
from program import render, run

EVERY_FORMAT = pytest.mark.parametrize('name, content', [
    ('model.obj', models.obj().encode()),
    ('model.ply', models.ply_ascii()),
    ('model.PLY', models.ply_binary('<')),
    ('model.ply', models.ply_binary('>')),
    ('model.stl', models.stl_ascii()),
    ('model.stl', models.stl_binary()),
    ('model.glb', models.glb(gltf())),
], ids=['OBJ', 'PLY ascii', 'PLY little endian', 'PLY big endian', 'STL ascii', 'STL binary',
        'GLB'])


@EVERY_FORMAT
def test_every_format_gives_the_same_triangles_to_the_bit(
        tmp_path: Path, name: str, content: bytes) -> None:
    (tmp_path / name).write_bytes(content)
    result = imported(tmp_path / name, '--scale', '1')
    np.testing.assert_array_equal(result.triangles, TRIANGLES)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([name, *WRITTEN])


@pytest.mark.parametrize('write', [models.write_gltf, models.write_gltf_and_bin])
def test_gltf_with_its_buffer_inside_or_beside_gives_the_same(tmp_path: Path, write) -> None:
    write(tmp_path / 'model.gltf', gltf())
    result = imported(tmp_path / 'model.gltf', '--scale', '1')
    np.testing.assert_array_equal(result.triangles, TRIANGLES)


def test_polygons_become_triangles_that_cover_them(tmp_path: Path) -> None:
    corners = np.array([[0, 0, 0], [4, 0, 0], [4, 3, 0], [2, 1, 0], [0, 3, 0]])  # not convex
    (tmp_path / 'model.obj').write_text(obj(corners, np.array([[0, 1, 2, 3, 4]])))
    triangles = imported(tmp_path / 'model.obj', '--scale', '1').triangles.astype(float)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2
    assert len(triangles) == 3
    np.testing.assert_allclose(normals.sum(axis=0), [0, 0, 8])
    assert (normals[:, 2] > 0).all()


def test_degenerate_triangles_are_kept_and_counted(tmp_path: Path) -> None:
    faces = np.concatenate([FACES, [[0, 0, 1], [2, 2, 2]]])
    (tmp_path / 'model.obj').write_text(obj(faces=faces))
    result = imported(tmp_path / 'model.obj', '--scale', '1')
    np.testing.assert_array_equal(result.triangles, VERTICES[faces])
    assert result.summary('triangles') == '8, of which 2 have no area and are never hit'


def test_points_and_lines_are_skipped_and_counted(tmp_path: Path) -> None:
    (tmp_path / 'model.obj').write_text(obj() + 'l 1 2\nl 2 3\np 4\n')
    result = imported(tmp_path / 'model.obj')
    assert len(result.triangles) == len(FACES)
    assert result.summary('skipped') == '3 points and lines'


def test_instances_take_the_transforms_of_all_nodes_above_them(tmp_path: Path) -> None:
    model = gltf(scenes=[{'nodes': [0, 3]}], nodes=[
        {'children': [1, 2], 'translation': [10, 20, 30], 'scale': [2, 2, 2]},
        {'mesh': 0},
        {'mesh': 0, 'translation': [1, 0, 0], 'rotation': [0, 0.5 ** 0.5, 0, 0.5 ** 0.5]},
        {'mesh': 0, 'matrix': [1, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 0, 0, -5, 1]}])
    write_gltf(tmp_path / 'model.gltf', model)
    result = imported(tmp_path / 'model.gltf', '--scale', '1')
    turned = TRIANGLES[..., [2, 1, 0]] * [1, 1, -1]  # by 90 degrees about y
    expected = [2 * TRIANGLES + [10, 20, 30], 2 * (turned + [1, 0, 0]) + [10, 20, 30],
                TRIANGLES * [1, 3, 1] + [0, 0, -5]]
    np.testing.assert_allclose(result.triangles, np.concatenate(expected), rtol=1e-6, atol=1e-5)


@pytest.mark.parametrize('size, factor', [(1, 32), (100 / 1.5, 1), (100, 0.5), (1e-3, 2 ** 16),
                                          (1e7, 2 ** -18), (1e-30, 2 ** 106), (1e30, 2 ** -94)])
def test_models_are_scaled_by_the_power_of_two_that_makes_them_fit(
        tmp_path: Path, size: float, factor: float) -> None:
    vertices = (VERTICES * np.float32(size)).astype('f4')
    (tmp_path / 'model.ply').write_bytes(models.ply_binary('<', vertices))
    result = imported(tmp_path / 'model.ply')
    assert 50 < np.abs(result.triangles).max() <= 100
    scale = np.abs(result.triangles).max() / np.abs(vertices).max()
    assert np.log2(scale) == round(np.log2(scale))
    np.testing.assert_array_equal(result.triangles, vertices[FACES] * np.float32(scale))
    if 1 <= size <= 100:
        assert scale == (64 if size == 1 else factor)
    assert result.summary('coordinates').startswith(result.comments[1])
    assert result.comments[0].startswith('made from model.ply by bwfirt-import ')


def test_a_model_far_from_the_origin_is_moved_there(tmp_path: Path) -> None:
    vertices = (VERTICES + [4e5, 100, -3e5]).astype('f4')
    (tmp_path / 'model.ply').write_bytes(models.ply_binary('<', vertices))
    result = imported(tmp_path / 'model.ply')
    centre = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    np.testing.assert_array_equal(result.triangles, (vertices - centre)[FACES] * 64)
    assert result.comments[1] == 'scene = 64 * (model - (4e+05, 100.75, -3e+05))'


def test_with_a_scale_of_its_own_a_model_is_not_moved(tmp_path: Path) -> None:
    vertices = (VERTICES + [400, 100, -300]).astype('f4')
    (tmp_path / 'model.ply').write_bytes(models.ply_binary('<', vertices))
    result = imported(tmp_path / 'model.ply', '--scale', '2.5e-1')
    np.testing.assert_array_equal(result.triangles, vertices[FACES] * np.float32(0.25))
    assert result.comments[1] == 'scene = 0.25 * model'


def test_emissive_materials_become_lights_with_contiguous_triangles(tmp_path: Path) -> None:
    (tmp_path / 'model.mtl').write_text('newmtl wall\nKd 1 1 1\n'
                                        'newmtl warm\nKe 4 2 1\nnewmtl cold\nKe 0 0 3\n')
    order = ['warm', 'wall', 'cold', 'warm', 'wall', 'warm']
    faces = ''.join(f'o part{i}\nusemtl {name}\nf ' + ' '.join(str(j + 1) for j in face) + '\n'
                    for i, (name, face) in enumerate(zip(order, FACES.tolist())))
    (tmp_path / 'model.obj').write_text('mtllib model.mtl\n' + obj(faces=FACES[:0]) + faces)
    result = imported(tmp_path / 'model.obj', '--scale', '1')

    def triangles_of(name: str) -> np.ndarray:
        return TRIANGLES[[i for i, other in enumerate(order) if other == name]]

    np.testing.assert_array_equal(result.triangles[:2], triangles_of('wall'))
    exitances = {'warm': np.pi * (0.2126 * 4 + 0.7152 * 2 + 0.0722), 'cold': np.pi * 0.0722 * 3}
    found = {}
    for first, last, exitance in result.lights:
        name, = (name for name, value in exitances.items() if np.isclose(value, exitance))
        found[name] = result.triangles[first:last + 1]
        assert f"triangles {first} to {last}, exitance {exitance:.3g}, material '{name}'" \
            in result.output
    assert set(found) == set(exitances)
    for name, triangles in found.items():
        np.testing.assert_array_equal(triangles, triangles_of(name))


def test_emission_of_gltf_is_read_and_that_by_texture_is_said_to_be_skipped(tmp_path: Path) -> None:
    primitive = {'attributes': {'POSITION': 0}, 'indices': 1}
    model = gltf(meshes=[{'primitives': [primitive | {'material': i} for i in range(3)]}],
                 materials=[{'name': 'lamp', 'emissiveFactor': [1, 1, 1]}, {'name': 'wall'},
                            {'name': 'screen', 'emissiveFactor': [1, 1, 1],
                             'emissiveTexture': {'index': 0}}],
                 textures=[{'source': 0}], images=[{'uri': 'screen.png'}])
    write_gltf(tmp_path / 'model.gltf', model)
    result = imported(tmp_path / 'model.gltf')
    (first, last, exitance), = result.lights
    assert (first, last) == (12, 17)
    assert exitance == pytest.approx(np.pi)
    assert "emissive texture of material 'screen'" in result.summary('skipped')


def test_an_emissive_material_without_area_is_no_light(tmp_path: Path) -> None:
    (tmp_path / 'model.mtl').write_text('newmtl wall\nnewmtl lamp\nKe 1 1 1\n')
    (tmp_path / 'model.obj').write_text('mtllib model.mtl\nusemtl wall\n' + obj()
                                        + 'usemtl lamp\nf 1 1 2\n')
    assert imported(tmp_path / 'model.obj').lights == []


def test_a_scene_without_lights_says_how_to_get_one(tmp_path: Path) -> None:
    (tmp_path / 'model.obj').write_text(obj())
    text = imported(tmp_path / 'model.obj').summary('lights')
    assert text.startswith('none, and batch runs need one.')
    option, value = text[text.index('--light'):].split()[:2]
    assert 'viewer' in text and 'Ctrl+S' in text
    assert len(imported(tmp_path / 'model.obj', option, value).lights) == 1


@pytest.mark.parametrize('up, axis', [('y', 1), ('-y', 1), ('z', 2), ('-x', 0)])
def test_light_options_add_squares_across_the_up_axis(
        tmp_path: Path, up: str, axis: int) -> None:
    (tmp_path / 'model.obj').write_text(obj())
    result = imported(tmp_path / 'model.obj', '--up', up, '--light', '-1,2,0.5,0.5,20',
                      '--light', '1,2,3,1e-1,3', '--scale', '2')
    assert result.lights == [(6, 7, 20), (8, 9, 3)]
    for (first, last, _), size, centre in zip(result.lights, [0.5, 0.1],
                                              [[-1, 2, 0.5], [1, 2, 3]]):
        square = result.triangles[first:last + 1].reshape(-1, 3).astype(float)
        np.testing.assert_allclose((square.min(axis=0) + square.max(axis=0)) / 2,
                                   2 * np.array(centre), rtol=1e-6)
        np.testing.assert_allclose(np.ptp(square, axis=0),
                                   2 * size * (np.arange(3) != axis), atol=1e-6)


def test_the_camera_of_the_file_is_taken_with_its_nodes(tmp_path: Path) -> None:
    model = gltf(cameras=[{'type': 'perspective', 'perspective': {
        'yfov': 0.8, 'znear': 0.1, 'aspectRatio': 1.7}}])
    model['nodes'] += [{'children': [2], 'translation': [0, 1, 8]},
                       {'camera': 0, 'rotation': [0, 0, 0.5 ** 0.5, 0.5 ** 0.5],
                        'translation': [0.5, 0, 0]}]
    model['scenes'][0]['nodes'] = [0, 1]
    write_gltf(tmp_path / 'model.gltf', model)
    result = imported(tmp_path / 'model.gltf', '--scale', '2')
    np.testing.assert_allclose(result.camera['position'], [1, 2, 16], atol=1e-6)
    np.testing.assert_allclose(result.camera['direction'], [0, 0, -1], atol=1e-6)
    np.testing.assert_allclose(result.camera['up'], [-1, 0, 0], atol=1e-6)
    assert result.camera['filmSizeY'][0] / (2 * result.camera['depth'][0]) == pytest.approx(
        np.tan(0.4), rel=1e-6)
    assert result.summary('camera').startswith('the first one of the file')


COLLADA_CAMERA = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Z_UP</up_axis></asset>
<library_cameras><camera id="c" name="c"><optics><technique_common><perspective>
<xfov>60</xfov><aspect_ratio>1.5</aspect_ratio><znear>1</znear><zfar>9</zfar>
</perspective></technique_common></optics></camera></library_cameras>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 0 1</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
<node id="n"><instance_geometry url="#g"/></node>
<node id="m"><translate>0 -5 2</translate><instance_camera url="#c"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
"""


def test_collada_gives_a_horizontal_field_of_view_and_turns_z_to_y(tmp_path: Path) -> None:
    (tmp_path / 'model.dae').write_text(COLLADA_CAMERA)
    result = imported(tmp_path / 'model.dae', '--scale', '1')
    np.testing.assert_allclose(result.triangles, [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], atol=1e-7)
    np.testing.assert_allclose(result.camera['position'], [0, 2, 5], atol=1e-6)
    assert result.camera['filmSizeY'][0] / 2 == pytest.approx(np.tan(np.pi / 6) / 1.5, rel=1e-6)


@pytest.mark.parametrize('up', ['x', 'y', 'z', '-x', '-y', '-z'])
def test_a_file_without_camera_gets_one_that_frames_the_model(tmp_path: Path, up: str) -> None:
    (tmp_path / 'model.obj').write_text(obj())
    result = imported(tmp_path / 'model.obj', '--up', up)
    camera = {key: np.array(value) for key, value in result.camera.items()}
    forward = camera['direction'] / np.linalg.norm(camera['direction'])
    right = np.cross(forward, camera['up'])
    right /= np.linalg.norm(right)
    seen = result.triangles.reshape(-1, 3) - camera['position']
    depth = seen @ forward
    half = camera['filmSizeY'] / camera['depth'] / 2
    across = np.abs(seen @ right) / depth / (half * 640 / 480)
    along = np.abs(seen @ np.cross(right, forward)) / depth / half
    assert (depth > 0).all()
    assert 0.6 < max(across.max(), along.max()) < 1
    axis = {'x': 0, 'y': 1, 'z': 2}[up[-1]]
    above = -1 if up[0] == '-' else 1
    assert camera['up'][axis] == above
    assert camera['position'][axis] * above > (result.triangles[..., axis] * above).max()
    assert result.summary('camera').startswith('frames the model')


def test_an_orthographic_camera_is_passed_over(tmp_path: Path) -> None:
    model = gltf(cameras=[{'type': 'orthographic', 'orthographic': {
        'xmag': 1, 'ymag': 1, 'znear': 0.1, 'zfar': 10}}])
    model['nodes'][0]['camera'] = 0
    write_gltf(tmp_path / 'model.gltf', model)
    assert imported(tmp_path / 'model.gltf').summary('camera').startswith('frames the model')


def test_an_imported_scene_renders_as_bright_as_its_light(tmp_path: Path) -> None:
    """From inside a closed furnace of reflectance 0.7 every path sees L / (1 - 0.7)."""
    cube = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4],
                      [1, 5, 7, 3]])
    (tmp_path / 'model.mtl').write_text('newmtl lamp\nKe 0.5 0.5 0.5\n')
    (tmp_path / 'model.obj').write_text('mtllib model.mtl\nusemtl lamp\n' + obj(cube, quads))
    result = imported(tmp_path / 'model.obj')
    assert len(result.lights) == 1 and len(result.triangles) == 12
    camera = tmp_path / 'scene.camera'
    camera.write_text(''.join('position 0 0 0\n' if line.startswith('position') else line + '\n'
                              for line in camera.read_text().splitlines()))
    report = render(IMPORT.with_name('bwfirt-funky-kd'), tmp_path, '--camera', 'scene.camera',
                    '--size', '64x48', '--passes', '16', scene='scene.scene')
    assert report['average_intensity'][0] == pytest.approx(
        0.5 / 0.3, abs=5 * report['standard_error'][0])


def test_the_locale_does_not_matter(tmp_path: Path) -> None:
    (tmp_path / 'model.obj').write_text(obj())
    german = os.environ | {'LC_ALL': 'de_DE.UTF-8', 'LANG': 'de_DE.UTF-8'}
    result = imported(tmp_path / 'model.obj', '--scale', '1.5', '--light', '0,2.5,0,0.5,1.5',
                      env=german)
    np.testing.assert_array_equal(result.triangles[:6], TRIANGLES * np.float32(1.5))
    assert result.lights == [(6, 7, 1.5)]


def test_help_and_version_succeed() -> None:
    text = run(IMPORT, '--help').stdout
    for word in ['MODEL', 'BASE', '--scale', '--up', '--light', 'x,y,z,size,exitance']:
        assert word in text
    assert run(IMPORT, '--version').stdout.startswith('bwfirt-import ')
