# SPDX-License-Identifier: GPL-3.0-only
"""Bad scene, triangle and camera files end the run with one line that names file, line and key."""

import os
import resource
from pathlib import Path

import numpy as np
import pytest

from box import SCENE, box_triangles, replace_line, write_triangles
from program import batch_command, complaint, refusal, render, run

FILES = pytest.mark.parametrize('name', ['box.scene', 'box.camera', 'box.ra2'])
TEXT_FILES = pytest.mark.parametrize('name, key', [('box.scene', 'triangles'),
                                                   ('box.camera', 'type')])
BOTH_KERNELS = pytest.mark.parametrize('program', ['simple-bvh', 'funky-kd'], indirect=True)


@FILES
def test_a_missing_file_is_refused(program: Path, folder: Path, name: str) -> None:
    (folder / name).unlink()
    assert refusal(program, folder).startswith(f'{name}: ')


@FILES
def test_a_folder_in_place_of_a_file_is_refused(program: Path, folder: Path, name: str) -> None:
    (folder / name).unlink()
    (folder / name).mkdir()
    assert refusal(program, folder).startswith(f'{name}: ')


@FILES
def test_a_fifo_is_refused_without_waiting_for_a_writer(
        program: Path, folder: Path, name: str) -> None:
    (folder / name).unlink()
    os.mkfifo(folder / name)
    assert refusal(program, folder, timeout=10).startswith(f'{name}: ')


@FILES
def test_an_empty_file_is_refused(program: Path, folder: Path, name: str) -> None:
    (folder / name).write_bytes(b'')
    assert refusal(program, folder).startswith(f'{name}: ')


@FILES
def test_an_unreadable_file_is_refused(program: Path, folder: Path, name: str) -> None:
    (folder / name).chmod(0)
    command = batch_command(program)
    if os.geteuid() == 0:  # root reads everything unless it gives that right up
        command = ['setpriv', '--bounding-set=-dac_override,-dac_read_search', *command]
        if run(*command[:2], 'true').returncode != 0:
            pytest.skip('root cannot give up its right to read every file here')
    assert complaint(run(*command, cwd=folder), program, 1).startswith(f'{name}: ')
    assert not list(folder.glob('image*'))


@TEXT_FILES
def test_a_file_of_comments_alone_is_refused(
        program: Path, folder: Path, name: str, key: str) -> None:
    (folder / name).write_text('# nothing here\n')
    assert refusal(program, folder).startswith(f'{name}:1: {key}')


@TEXT_FILES
def test_a_file_of_random_bytes_is_refused(
        program: Path, folder: Path, name: str, key: str) -> None:
    (folder / name).write_bytes(np.random.default_rng(1).bytes(4000))
    assert refusal(program, folder).startswith(f'{name}:1: ')


@pytest.mark.parametrize('name, text, line, key', [
    ('box.scene', 'triangles', 1, 'triangles'),
    ('box.scene', 'triangles box.ra2\nlights 1 12', 2, 'lights'),
    ('box.scene', 'triangles "box.ra2', 1, ''),
    ('box.camera', 'type pinhole\nposition 0 0 0.9\ndirection 0 0', 3, 'direction'),
    ('box.camera', 'type pinhole\nposition 0 0 0.9\ndepth', 3, 'depth'),
])
def test_a_truncated_text_file_is_refused(
        program: Path, folder: Path, name: str, text: str, line: int, key: str) -> None:
    (folder / name).write_text(text)
    assert refusal(program, folder).startswith(f'{name}:{line}: {key}')


@pytest.mark.parametrize('size', [1, 35, 14 * 36 - 1, 14 * 36 + 4])
def test_a_triangle_file_whose_size_is_no_multiple_of_36_is_refused(
        program: Path, folder: Path, size: int) -> None:
    os.truncate(folder / 'box.ra2', size)
    message = refusal(program, folder)
    assert message.startswith('box.ra2: ')
    assert f'{size} ' in message and '36' in message


def test_a_triangle_file_cut_after_a_triangle_no_longer_holds_the_light(
        program: Path, folder: Path) -> None:
    os.truncate(folder / 'box.ra2', 13 * 36)
    assert refusal(program, folder).startswith('box.scene:2: lights')


# More than any machine has, with indices of 32 bits and beyond them.
@pytest.mark.parametrize('triangles', [4_000_000_000, 200_000_000_000])
def test_a_triangle_file_larger_than_the_memory_is_refused_with_the_numbers(
        program: Path, folder: Path, triangles: int) -> None:
    os.truncate(folder / 'box.ra2', 36 * triangles)
    message = refusal(program, folder)
    assert message.startswith('box.ra2: ')
    assert str(triangles) in message


@pytest.mark.parametrize('limit', [350_000_000, 396_100_000], ids=['smaller', 'as large'])
def test_a_triangle_file_larger_than_the_memory_limit_is_refused_with_the_numbers(
        program: Path, folder: Path, limit: int) -> None:
    triangles = 11_000_000  # 396 MB
    os.truncate(folder / 'box.ra2', 36 * triangles)
    message = refusal(program, folder, preexec_fn=lambda: resource.setrlimit(
        resource.RLIMIT_AS, (limit, limit)))
    assert message.startswith('box.ra2: ')
    assert str(36 * triangles) in message and str(limit) in message


@BOTH_KERNELS
def test_a_kernel_that_runs_out_of_memory_fails_with_one_line(program: Path, folder: Path) -> None:
    count = 200_000
    corners = np.random.default_rng(1).uniform(-0.9, 0.8, (count, 1, 3))
    extent = np.random.default_rng(2).uniform(0, 0.1, (count, 3, 3))
    write_triangles(folder / 'box.ra2', np.concatenate([box_triangles(), corners + extent]))

    failures = 0
    for megabytes in range(20, 120, 10):
        limit = megabytes * 1_000_000

        def lower_limit() -> None:
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

        if run(program, '--version', preexec_fn=lower_limit).returncode != 0:
            continue  # not even enough to load the program
        result = run(*batch_command(program, '--passes', '1', '--threads', '1'), cwd=folder,
                     preexec_fn=lower_limit)
        if result.returncode == 0:
            break
        complaint(result, program, 1)
        assert not list(folder.glob('image*'))
        failures += 1
    assert failures > 0


@pytest.mark.parametrize('lights', [
    pytest.param('1 12 14 10', id='last triangle beyond the end'),
    pytest.param('1 14 14 10', id='both triangles beyond the end'),
    pytest.param('1 12 99999999999 10', id='beyond 32 bits'),
    pytest.param('1 12 99999999999999999999 10', id='beyond 64 bits'),
    pytest.param('1 -1 13 10', id='first triangle negative'),
    pytest.param('1 -2 -1 10', id='both triangles negative'),
    pytest.param('1 13 12 10', id='reversed'),
    pytest.param('1 12.5 13 10', id='no whole number'),
    pytest.param('1 12 13 -10', id='exitance negative'),
    pytest.param('1 12 13 nan', id='exitance NaN'),
    pytest.param('1 12 13 inf', id='exitance infinite'),
    pytest.param('1 12 13 1e999', id='exitance beyond double precision'),
    pytest.param('1 12 13 bright', id='exitance no number'),
    pytest.param('1 12 13 0', id='the only exitance 0'),
    pytest.param('2 12 12 0 13 13 0', id='every exitance 0'),
    pytest.param('2 12 13 10 13 13 10', id='triangle in two lights'),
    pytest.param('2 13 13 10 12 13 10', id='triangle in two lights, not in order'),
    pytest.param('2 12 12 10 12 12 10', id='twice the same light'),
    pytest.param('-1 12 13 10', id='negative count'),
    pytest.param('1.5 12 13 10', id='count no whole number'),
])
def test_a_bad_light_is_refused(program: Path, folder: Path, lights: str) -> None:
    line = replace_line(folder / 'box.scene', 'lights', f'lights {lights}')
    assert refusal(program, folder).startswith(f'box.scene:{line}: lights: ')


def test_a_count_beyond_the_lights_that_follow_is_refused(program: Path, folder: Path) -> None:
    (folder / 'box.scene').write_text('triangles box.ra2\nlights 1000000000000000000 12 13 10\n')
    assert refusal(program, folder, timeout=10).startswith('box.scene:')


def test_many_lights_over_all_triangles_are_refused_at_once(program: Path, folder: Path) -> None:
    write_triangles(folder / 'box.ra2', np.tile(box_triangles(), (10_000, 1, 1)))
    line = replace_line(folder / 'box.scene', 'lights', 'lights 10000' + ' 0 139999 1' * 10_000)
    message = refusal(program, folder, timeout=10)
    assert message == f'box.scene:{line}: lights: triangle 0 belongs to two lights'


@pytest.mark.parametrize('path', ['box\x01.ra2', '"box\t.ra2"', '"box\r.ra2"', 'box.ra2\0x'],
                         ids=['byte 1', 'tab', 'carriage return', 'zero byte'])
def test_a_path_with_a_control_character_is_refused(
        program: Path, folder: Path, path: str) -> None:
    line = replace_line(folder / 'box.scene', 'triangles', f'triangles {path}')
    assert refusal(program, folder).startswith(f'box.scene:{line}: triangles: ')


def test_a_light_on_a_line_of_its_own_is_refused_with_that_line(
        program: Path, folder: Path) -> None:
    replace_line(folder / 'box.scene', 'lights', 'lights 2\n  12 12 10\n  13 14 10')
    assert refusal(program, folder).startswith('box.scene:4: lights: ')


@pytest.mark.parametrize('extra', [[[[0.5, 0.5, 0.5]] * 3], [[[0, 0, 0], [1, 0, 0], [2, 0, 0]]],
                                   [[[0, 0, 0], [0.5, 0, 0], [np.nan, 0, 0]]]],
                         ids=['a point', 'a line', 'NaN'])
def test_a_light_without_area_is_refused(program: Path, folder: Path, extra: list) -> None:
    write_triangles(folder / 'box.ra2', np.concatenate([box_triangles(), extra]))
    line = replace_line(folder / 'box.scene', 'lights', 'lights 2 12 13 10 14 14 10')
    assert refusal(program, folder).startswith(f'box.scene:{line}: lights: ')


def test_a_triangle_without_area_inside_the_range_of_a_light_is_skipped(
        program: Path, folder: Path) -> None:
    render(program, folder)
    expected = (folder / 'image.exr').read_bytes()
    write_triangles(folder / 'box.ra2',
                    np.concatenate([box_triangles(), [[[0, 0.5, 0], [0.1, 0.5, 0], [0.2, 0.5, 0]]]]))
    replace_line(folder / 'box.scene', 'lights', 'lights 1 12 14 10')
    render(program, folder)
    assert (folder / 'image.exr').read_bytes() == expected


@pytest.mark.parametrize('lights', ['lights 0', ''], ids=['count 0', 'no such key'])
def test_batch_refuses_a_scene_without_lights(program: Path, folder: Path, lights: str) -> None:
    (folder / 'box.scene').write_text(f'triangles box.ra2\n{lights}\n')
    message = refusal(program, folder)
    assert message.startswith('box.scene') and 'lights' in message


@pytest.mark.parametrize('line, key', [
    ('reflectance 1', 'reflectance'), ('reflectance -0.1', 'reflectance'),
    ('reflectance nan', 'reflectance'), ('reflectance 0,5', 'reflectance'),
    ('reflectance', 'reflectance'), ('brightness 3', 'brightness'), ('lights 0', 'lights'),
    ('triangles box.ra2', 'triangles'),
])
def test_a_bad_key_of_a_scene_is_refused(program: Path, folder: Path, line: str, key: str) -> None:
    (folder / 'box.scene').write_text(SCENE.replace('reflectance 0.5\n', line + '\n'))
    message = refusal(program, folder)
    assert message.startswith('box.scene:3: ') and key in message


CAMERA_LINES = [
    ('direction', '0 0 0'), ('direction', '-0 0 0'), ('direction', '0 0'), ('direction', '0 0 1 0'),
    ('direction', '0 nan 1'), ('direction', '0 inf 1'),
    ('up', '0 0 0'), ('up', '0 0 1'), ('up', '0 0 -7'), ('up', '0 nan 1'), ('up', 'nan nan nan'),
    ('position', '0 nan 0'), ('position', '0 -inf 0'), ('position', '0 0'), ('position', '0 0 x'),
    ('position', '0 0 0,9'), ('position', '0 0 1e999'),
    ('position', '0 0 1e300'), ('direction', '0 0 1e200'), ('up', '0 1e200 0'),
    ('depth', '1e200'), ('depth', '5e-324'), ('filmSizeY', '1e200'), ('sensorResponse', '1e300'),
    ('depth', '0'), ('depth', '-1'), ('depth', 'nan'), ('depth', '1 1'), ('depth', ''),
    ('filmSizeY', '0'), ('filmSizeY', '-1.5'), ('filmSizeY', 'nan'), ('filmSizeY', 'inf'),
    ('sensorResponse', '-1'), ('sensorResponse', 'nan'), ('type', 'fisheye'), ('type', ''),
]


@pytest.mark.parametrize('key, values', CAMERA_LINES)
def test_a_bad_value_of_a_camera_is_refused(
        program: Path, folder: Path, key: str, values: str) -> None:
    line = replace_line(folder / 'box.camera', key, f'{key} {values}')
    assert refusal(program, folder).startswith(f'box.camera:{line}: {key}: ')


@pytest.mark.parametrize('key', ['type', 'position', 'direction', 'up', 'depth', 'filmSizeY',
                                 'sensorResponse'])
def test_a_missing_key_of_a_camera_is_refused(program: Path, folder: Path, key: str) -> None:
    replace_line(folder / 'box.camera', key, '')
    message = refusal(program, folder)
    assert message.startswith('box.camera:') and f' {key}: ' in message


@pytest.mark.parametrize('line, key', [
    ('focus 3', 'focus'), ('Depth 1', 'Depth'), ('depth 1', 'depth'), ('up 0 1 0', 'up'),
    ('referenceAverageIntensity (1 2)', 'referenceAverageIntensity'),
    ('referenceAverageIntensity 1 2 3', 'referenceAverageIntensity'),
    ('referenceAverageIntensity (1 nan 3)', 'referenceAverageIntensity'),
])
def test_an_unknown_or_second_or_malformed_key_of_a_camera_is_refused(
        program: Path, folder: Path, line: str, key: str) -> None:
    with open(folder / 'box.camera', 'a') as file:
        file.write(line + '\n')
    message = refusal(program, folder)
    assert message.startswith('box.camera:8: ') and key in message
