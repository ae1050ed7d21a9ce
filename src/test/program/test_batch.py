# SPDX-License-Identifier: GPL-3.0-only
"""The run report of a batch run, as JSON and as text, and how a run can be ended."""

import os
import re
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from box import SCENE, box_triangles, replace_line, write_triangles
from program import batch_command, read_report, render, run

KEYS = {
    '': {'schema', 'program', 'system', 'kernel', 'kernel_options', 'scene', 'camera', 'triangles',
         'threads', 'in_flight', 'passes', 'width', 'height', 'seed', 'time', 'rays', 'memory',
         'average_intensity', 'standard_error', 'reference_average_intensity', 'squared_error',
         'warnings'},
    'program': {'version', 'commit', 'compiler', 'flags', 'kernel_flags', 'openmp'},
    'system': {'cpu', 'cores', 'threads_available', 'memory_bytes', 'os', 'date'},
    'time': {'load_s', 'initialize_s', 'render_s', 'total_s'},
    'rays': {'intersect', 'visibility', 'per_second'},
    'memory': {'kernel_peak_bytes', 'kernel_final_bytes', 'kernel_leaked_bytes',
               'process_peak_bytes', 'triangles_bytes'},
}


@pytest.mark.parametrize('program', ['simple-bvh', 'funky-kd', 'yourkernel'], indirect=True)
def test_the_report_has_the_keys_and_types_of_its_schema(program: Path, folder: Path) -> None:
    report = render(program, folder)
    assert report.keys() == KEYS['']
    for name, keys in KEYS.items():
        assert name == '' or report[name].keys() == keys
    assert (report['schema'], report['kernel']) == (1, program.name.removeprefix('bwfirt-'))
    assert report['kernel_options'] == {} and report['warnings'] == []
    assert report['program']['openmp'] is True
    for key in KEYS['program'] - {'openmp'}:
        assert isinstance(report['program'][key], str) and report['program'][key]
    for key in ['cpu', 'os', 'date']:
        assert isinstance(report['system'][key], str) and report['system'][key]
    counts = [report['system'][key] for key in ['cores', 'threads_available', 'memory_bytes']]
    counts += [report['rays']['intersect'], report['rays']['visibility']]
    assert all(isinstance(count, int) and count > 0 for count in counts)
    assert all(isinstance(value, float) and value >= 0 for value in report['time'].values())
    assert all(isinstance(value, int) and value >= 0 for value in report['memory'].values())
    assert isinstance(report['squared_error'], float)


def test_the_report_repeats_what_was_asked_for(program: Path, folder: Path) -> None:
    report = render(program, folder, '--threads', '3', '--passes', '5', '--size', '7x5',
                    '--seed', '18446744073709551615', '--in-flight', '4')
    asked = {'threads': 3, 'passes': 5, 'width': 7, 'height': 5, 'in_flight': 4,
             'seed': 2 ** 64 - 1, 'scene': 'box.scene', 'camera': 'box.camera', 'triangles': 14}
    assert {key: report[key] for key in asked} == asked


def test_the_threads_are_all_that_the_process_may_run_on_unless_given(
        program: Path, folder: Path) -> None:
    one = min(os.sched_getaffinity(0))
    result = run(program, '--batch', '--camera', 'box.camera', '--size', '4x4', 'box.scene',
                 cwd=folder, preexec_fn=lambda: os.sched_setaffinity(0, {one}))
    assert result.returncode == 0, result.stderr
    assert re.search(r'^threads +1$', result.stdout, re.M)


def test_the_view_stands_in_the_report(program: Path, folder: Path) -> None:
    report = render(program, folder, '--view', 'distance')
    assert report.keys() == KEYS[''] | {'view'} and report['view'] == 'distance'


@pytest.mark.parametrize('program', ['simple-bvh', 'funky-kd', 'yourkernel'], indirect=True)
def test_the_figures_of_the_report_agree_with_each_other(program: Path, folder: Path) -> None:
    report = render(program, folder, '--size', '40x30', '--passes', '4')
    seconds, rays, memory = report['time'], report['rays'], report['memory']
    assert seconds['total_s'] == pytest.approx(seconds['initialize_s'] + seconds['render_s'])
    assert rays['per_second'] == pytest.approx(
        (rays['intersect'] + rays['visibility']) / seconds['render_s'])
    assert rays['intersect'] >= 40 * 30 * 4
    assert rays['intersect'] >= rays['visibility']
    assert memory['kernel_leaked_bytes'] == 0
    assert memory['kernel_peak_bytes'] >= memory['kernel_final_bytes']
    assert memory['process_peak_bytes'] > memory['kernel_peak_bytes']
    assert memory['triangles_bytes'] == 14 * 36


def test_without_a_reference_the_error_is_the_square_of_the_average(
        program: Path, folder: Path) -> None:
    report = render(program, folder)
    assert report['reference_average_intensity'] is None
    assert report['squared_error'] == pytest.approx(
        np.sum(np.square(report['average_intensity'])))


def test_with_a_reference_the_error_is_the_square_of_the_difference(
        program: Path, folder: Path) -> None:
    with open(folder / 'box.camera', 'a') as file:
        file.write('referenceAverageIntensity (0.25 0.5 1.5)\n')
    report = render(program, folder)
    assert report['reference_average_intensity'] == [0.25, 0.5, 1.5]
    difference = np.subtract(report['average_intensity'], [0.25, 0.5, 1.5])
    assert report['squared_error'] == pytest.approx(np.sum(np.square(difference)))


def test_the_standard_error_is_unknown_after_one_pass(program: Path, folder: Path) -> None:
    assert render(program, folder, '--passes', '1')['standard_error'] == [None] * 3


def test_the_standard_error_is_that_of_the_averages_of_the_passes(
        program: Path, folder: Path) -> None:
    sums = [np.zeros(3)]
    for passes in range(1, 6):
        report = render(program, folder, '--passes', str(passes))
        sums.append(passes * np.array(report['average_intensity']))
    averages = np.diff(sums, axis=0)
    expected = np.std(averages, axis=0, ddof=1) / np.sqrt(len(averages))
    assert report['standard_error'] == pytest.approx(expected, rel=1e-6)


def leaves(report: dict, prefix: str = '') -> Iterator[tuple[str, object]]:
    for key, value in report.items():
        if isinstance(value, dict):
            yield from leaves(value, f'{prefix}{key}.')
        else:
            yield prefix + key, value


def test_the_text_holds_the_figures_of_the_report(program: Path, folder: Path) -> None:
    with open(folder / 'box.camera', 'a') as file:
        file.write('referenceAverageIntensity (0.25 0.5 1.5)\n')
    result = run(*batch_command(program, '--size', '40x30'), cwd=folder)
    report = read_report(folder)
    text = dict(line.split(maxsplit=1) for line in result.stdout.splitlines() if ' ' in line.strip())
    for key, value in leaves(report):
        if key.endswith('_s'):
            assert text[key] == f'{value:.3f} s'
        elif key == 'rays.per_second':
            assert text[key] == f'{value / 1e6:.4f} million'
        elif isinstance(value, list):
            assert [float(word) for word in text.get(key, '').split()] == value
        elif isinstance(value, str):
            assert text[key] == value
        elif value is True:
            assert text[key] == 'true'
        else:
            assert repr(value) in re.split(r'[ ()]', text[key])


def test_warnings_reach_report_text_and_standard_error(program: Path, folder: Path) -> None:
    write_triangles(folder / 'box.ra2', np.concatenate([box_triangles(), [np.full((3, 3), 500)]]))
    result = run(*batch_command(program), cwd=folder)
    prefix = f'{program.name}: warning: '
    line, = result.stderr.splitlines()
    assert result.returncode == 0 and line.startswith(prefix)
    assert line.removeprefix(prefix) in result.stdout
    assert line.removeprefix(prefix) in (folder / 'report.json').read_text()


def test_without_output_and_report_only_the_text_is_written(program: Path, folder: Path) -> None:
    before = sorted(folder.iterdir())
    result = run(program, '--batch', '--camera', 'box.camera', '--size', '4x4', '--passes', '1',
                 'box.scene', cwd=folder)
    assert result.returncode == 0 and 'average_intensity' in result.stdout
    assert sorted(folder.iterdir()) == before


def test_a_run_leaves_its_results_and_nothing_else(program: Path, folder: Path) -> None:
    before = {path.name for path in folder.iterdir()}
    render(program, folder)
    assert {path.name for path in folder.iterdir()} - before == {'image.exr', 'image.png',
                                                                'report.json'}


def test_paths_may_hold_spaces(program: Path, folder: Path) -> None:
    home = folder / 'my scenes # 1'
    home.mkdir()
    (folder / 'box.ra2').rename(home / 'the box #1.ra2')
    (folder / 'box.scene').rename(home / 'the box.scene')
    (folder / 'box.camera').rename(home / 'a camera')
    replace_line(home / 'the box.scene', 'triangles', 'triangles "the box #1.ra2"  # quoted')
    command = batch_command(program, '--camera', 'my scenes # 1/a camera', '--output', 'an image',
                            scene='my scenes # 1/the box.scene')
    result = run(*command, cwd=folder)
    assert result.returncode == 0, result.stderr
    assert (folder / 'an image.exr').exists() and (folder / 'an image.png').exists()


def test_the_locale_changes_neither_input_nor_output(program: Path, folder: Path) -> None:
    plain = render(program, folder)
    (folder / 'box.scene').write_text(SCENE.replace(' 10\n', ' 10.000\n').replace('0.5', '5e-1'))
    result = run(*batch_command(program), cwd=folder,
                 env=os.environ | {'LC_ALL': 'de_DE.UTF-8', 'LANG': 'de_DE.UTF-8'})
    assert result.returncode == 0, result.stderr
    assert ' '.join(repr(value) for value in plain['average_intensity']) in result.stdout
    assert ',' not in re.search(r'^time.*$', result.stdout, re.M).group()


@pytest.mark.parametrize('end', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_a_run_with_the_results_of_the_passes_done(
        program: Path, folder: Path, end: signal.Signals) -> None:
    command = batch_command(program, '--passes', '100000000', '--size', '32x32')
    with subprocess.Popen([str(word) for word in command], cwd=folder, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        try:
            time.sleep(1)
            assert process.poll() is None and not (folder / 'report.json').exists()
            process.send_signal(end)
            output, errors = process.communicate(timeout=20)
        finally:
            process.kill()
    assert process.returncode == 0, errors
    report = read_report(folder)
    passes = report['passes']
    assert 0 < passes < 100_000_000
    warning, = report['warnings']
    assert 'signal' in warning and str(passes) in warning
    assert errors == f'{program.name}: warning: {warning}\n' and warning in output

    image = (folder / 'image.exr').read_bytes()
    assert (folder / 'image.png').exists()
    again = render(program, folder, '--passes', str(passes), '--size', '32x32')
    assert (folder / 'image.exr').read_bytes() == image
    assert again['average_intensity'] == report['average_intensity']
