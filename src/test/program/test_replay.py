# SPDX-License-Identifier: GPL-3.0-only
"""Rays of the path tracer are recorded to a file, and a kernel is asked them again."""

import signal
import subprocess
from pathlib import Path

import numpy as np
import pytest

from box import box_triangles, write_triangles
from image import read_exr
from program import (BUILD, batch_command, complaint, read_report, refusal, render, run, snapshot,
                     wait_for_file)

# As doc/file-formats describes them.
HEADER = np.dtype([('magic', 'S8'), ('version', '<u4'), ('record_bytes', '<u4'),
                   ('intersect', '<u8'), ('visibility', '<u8'), ('triangles', '<u8'),
                   ('triangles_checksum', '<u8'), ('kernel', 'S64'), ('records_checksum', '<u8'),
                   ('header_checksum', '<u8')])
RECORD = np.dtype([('a', '<f4', 3), ('b', '<f4', 3), ('distance', '<f4'), ('triangle', '<u4'),
                   ('bounce', '<u2'), ('question', 'u1'), ('answer', 'u1')])


def read_stream(path: Path) -> tuple[np.void, np.ndarray]:
    data = path.read_bytes()
    return (np.frombuffer(data, HEADER, 1)[0], np.frombuffer(data, RECORD, offset=HEADER.itemsize))


def replay(program: Path, *options: str, **process) -> subprocess.CompletedProcess[str]:
    return run(program, '--replay', 'box.rays', *options, 'box.scene', **process)


@pytest.fixture
def recorded(folder: Path) -> Path:
    """The folder with the box and a stream that simple-bvh recorded in it."""
    render(BUILD / 'bwfirt-simple-bvh', folder, '--size', '32x24', '--record', 'box.rays')
    return folder


def test_a_stream_holds_the_rays_and_answers_of_the_path_tracer(recorded: Path) -> None:
    header, records = read_stream(recorded / 'box.rays')
    rays = read_report(recorded)['rays']
    assert (header['magic'], header['version'], header['record_bytes']) == (b'bwfirays', 1, 36)
    assert (header['kernel'], header['triangles']) == (b'simple-bvh', 14)
    assert (header['intersect'], header['visibility']) == (rays['intersect'], rays['visibility'])
    of_h = records['question'] == 0
    assert np.count_nonzero(of_h) == rays['intersect']
    assert np.count_nonzero(records['question'] == 1) == rays['visibility']
    assert np.count_nonzero(of_h & (records['bounce'] == 0)) == 2 * 32 * 24
    assert (records['answer'] <= 1).all() and records['answer'][of_h].all(), 'the box is closed'
    assert np.linalg.norm(records['b'][of_h], axis=1) == pytest.approx(1, abs=1e-6)
    hits = records['a'][of_h] + records['distance'][of_h, None] * records['b'][of_h]
    corners = box_triangles()[records['triangle'][of_h]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    heights = np.sum((hits - corners[:, 0]) * normals, axis=1)
    assert heights == pytest.approx(0, abs=1e-5), 'hits lie on their triangles'


def test_recording_changes_neither_image_nor_ray_counts(program: Path, folder: Path) -> None:
    plain = render(program, folder)
    image = read_exr(folder / 'image.exr')
    report = render(program, folder, '--record', 'box.rays')
    assert (read_exr(folder / 'image.exr') == image).all()
    assert report['rays']['intersect'] == plain['rays']['intersect']
    assert report['threads'] == 1 and '--record' in ' '.join(report['warnings'])


def test_recording_ends_rendering_with_the_pass_in_which_it_has_enough_rays(
        program: Path, folder: Path) -> None:
    report = render(program, folder, '--passes', '1000', '--record', 'box.rays', '--rays', '1500')
    assert 1 < report['passes'] < 10
    assert len(read_stream(folder / 'box.rays')[1]) == 1500


def test_a_recording_that_is_ended_keeps_what_it_has(program: Path, folder: Path) -> None:
    command = batch_command(program, '--passes', '1000000', '--record', 'box.rays', '--rays',
                            '100000000')
    # Rays are written some ten thousand at a time: once there are any, a pass has ended.
    with subprocess.Popen([str(word) for word in command], cwd=folder, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL) as process:
        wait_for_file(folder, 'box.rays.*', least_bytes=HEADER.itemsize + RECORD.itemsize)
        process.send_signal(signal.SIGINT)
        assert process.wait(30) == 0
    assert read_report(folder)['rays']['intersect'] == read_stream(folder / 'box.rays')[0]['intersect']


@pytest.mark.parametrize('program', ['funky-kd'], indirect=True)
def test_a_replay_reports_rates_and_answers(program: Path, recorded: Path) -> None:
    result = replay(program, '--report', 'report.json', '--threads', '2', '--replay-seconds',
                    '0.05', cwd=recorded)
    assert result.returncode == 0
    report = read_report(recorded)
    figures = report['replay']
    assert figures['seconds_per_measurement'] == 0.05
    [warning] = report['warnings']
    assert '0.05 s' in warning and 'first look' in warning
    assert result.stderr == f'{program.name}: warning: {warning}\n'
    header, records = read_stream(recorded / 'box.rays')
    assert figures['rays'] == {'intersect': header['intersect'],
                               'visibility': header['visibility']}
    for rate in ['intersect_per_second', 'visibility_per_second', 'mixed_per_second']:
        measurements = figures['measurements'][rate]
        assert len(measurements) >= 3 and figures[rate] == np.median(measurements) > 1e4
    assert sum(bounce['intersect'] for bounce in figures['by_bounce']) == header['intersect']
    assert figures['by_bounce'][0]['intersect'] == 2 * 32 * 24
    answers = figures['answers']
    assert answers.keys() == {'missed', 'ghost', 'wrong_triangle', 'tie', 'false_visible',
                              'false_occluded', 'max_relative_distance_error'}
    assert answers.pop('tie') <= 5
    assert set(answers.values()) == {0}
    assert report['average_intensity'] == [None] * 3 and report['passes'] == 0
    assert report['rays']['per_second'] == pytest.approx(figures['mixed_per_second'])
    assert 'replay.answers.missed           0\n' in result.stdout


def test_a_measurement_takes_a_second_where_no_other_time_is_given(
        program: Path, folder: Path) -> None:
    render(program, folder, '--record', 'box.rays', '--rays', '1')
    result = replay(program, '--report', 'report.json', cwd=folder)
    assert (result.returncode, result.stderr) == (0, '')
    assert read_report(folder)['replay']['seconds_per_measurement'] == 1


def test_a_single_ray_is_asked_with_both_answers(program: Path, recorded: Path) -> None:
    _, records = read_stream(recorded / 'box.rays')
    for question, word in [(0, 'triangle'), (1, 'visible')]:
        index = int(np.flatnonzero((records['question'] == question) & (records['answer'] == 1))[0])
        result = replay(program, '--only', str(index), cwd=recorded)
        assert result.returncode == 0 and result.stderr == ''
        first, recorded_answer, own_answer = result.stdout.splitlines()
        assert first.startswith(f'ray {index}, bounce ')
        assert recorded_answer.strip().startswith(f'recorded by simple-bvh: {word}')
        assert own_answer.split(': ')[1] == recorded_answer.split(': ')[1]
        assert own_answer.strip().startswith('simple-bvh: ')


def replay_refusal(program: Path, folder: Path, *options: str, status: int = 1) -> str:
    before = snapshot(folder)
    message = complaint(replay(program, *options, cwd=folder), program, status)
    assert snapshot(folder) == before
    return message


def test_a_ray_beyond_the_end_is_refused(program: Path, recorded: Path) -> None:
    _, records = read_stream(recorded / 'box.rays')
    assert 'has no ray' in replay_refusal(program, recorded, '--only', str(len(records)))


def test_a_stream_of_another_scene_is_refused(program: Path, recorded: Path) -> None:
    write_triangles(recorded / 'box.ra2', 0.5 * box_triangles())
    assert 'other triangles' in replay_refusal(program, recorded)


@pytest.mark.parametrize('damage, complaint_words', [
    (lambda data: b'', 'is empty'),
    (lambda data: data[:100], 'too short'),
    (lambda data: data[:-1], 'size'),
    (lambda data: data + data[-36:], 'size'),
    (lambda data: b'x' + data[1:], 'not a ray stream'),
    (lambda data: data[:8] + b'\x02' + data[9:], 'version 2'),
    (lambda data: data[:20] + b'\xff' + data[21:], 'header'),
    (lambda data: data[:-1] + bytes([data[-1] ^ 1]), 'checksum'),
])
def test_a_damaged_stream_is_refused(program: Path, recorded: Path, damage,
                                     complaint_words: str) -> None:
    path = recorded / 'box.rays'
    path.write_bytes(damage(path.read_bytes()))
    assert complaint_words in replay_refusal(program, recorded)


def test_a_missing_stream_is_refused(program: Path, folder: Path) -> None:
    assert 'no such file' in replay_refusal(program, folder)


@pytest.mark.parametrize('options', [
    ('--rays', '10'), ('--only', '1'), ('--replay-seconds', '1'), ('--record', 'a', '--rays', '0'),
    ('--record', 'a', '--rays', 'x'), ('--record', 'a', '--view', 'normals'),
    ('--record', 'a', '--in-flight', '2'), ('--record', 'a', '--checkpoint', 'b'),
    ('--record', 'a', '--replay', 'b'), ('--replay', 'a', '--only', '-1'),
])
def test_wrong_usage_of_streams(program: Path, folder: Path, options: tuple[str, ...]) -> None:
    assert '--' in refusal(program, folder, *options, status=2)


@pytest.mark.parametrize('seconds', ['0', '-1', '0.0099', '3600.001', '1e9', 'nan', '-nan', 'inf',
                                     'soon', '1s', ' 1', '0x1', '1,5', ''])
def test_a_bad_time_of_measuring_is_wrong_usage(
        program: Path, recorded: Path, seconds: str) -> None:
    message = replay_refusal(program, recorded, '--replay-seconds', seconds, status=2)
    assert '--replay-seconds' in message


@pytest.mark.parametrize('seconds', ['0.01', '1e-2', '3600'])
def test_the_ends_of_the_range_are_right_usage(program: Path, recorded: Path, seconds: str) -> None:
    result = replay(program, '--replay-seconds', seconds, '--only', '0', cwd=recorded)
    assert (result.returncode, result.stderr) == (0, '')


def test_a_stream_that_cannot_be_written_is_told_before_rendering(
        program: Path, folder: Path) -> None:
    assert 'cannot be written' in refusal(program, folder, '--passes', '1000000', '--record',
                                          'no/such/folder/box.rays')
