# SPDX-License-Identifier: GPL-3.0-only
"""Wrong usage ends with status 2 and one line that names the option."""

import json
import resource
from pathlib import Path

import numpy as np
import pytest

from box import box_triangles, write_triangles
from program import complaint, refusal, render, run

SIZES = ['0x0', '0x12', '16x0', '-16x12', '16x-12', '16', '16x', 'x12', 'x', '', '16x12x3', '16X12',
         '16 x 12', '16x12 ', '1.5x2', '1e2x1e2', 'nanxnan', 'wide', '99999999x99999999',
         '99999999999999999999x1', '16385x1', '1x16385']


@pytest.mark.parametrize('size', SIZES)
def test_a_bad_size_is_wrong_usage(program: Path, folder: Path, size: str) -> None:
    assert '--size' in refusal(program, folder, '--size', size, status=2)


@pytest.mark.parametrize('option, value', [
    ('--passes', '0'), ('--passes', '-1'), ('--passes', '1.5'), ('--passes', 'many'),
    ('--passes', '99999999999'),
    ('--threads', '0'), ('--threads', '-1'), ('--threads', '100000'), ('--threads', 'two'),
    ('--in-flight', '0'), ('--in-flight', '-1'), ('--in-flight', '1000000'), ('--in-flight', 'x'),
    ('--seed', '-1'), ('--seed', '1.5'), ('--seed', 'x'), ('--seed', '99999999999999999999'),
    ('--view', 'beauty'), ('--view', ''), ('--camera', ''), ('--output', ''), ('--report', ''),
    ('--checkpoint', ''), ('--record', ''), ('--replay', ''),
    ('--kernel-option', 'no-such-option=1'), ('--kernel-option', 'leaf-size'),
    ('--kernel-option', '=1'), ('--kernel-option', ''),
])
def test_a_bad_value_is_wrong_usage(program: Path, folder: Path, option: str, value: str) -> None:
    assert option in refusal(program, folder, option, value, status=2)


@pytest.mark.parametrize('program', ['funky-kd'], indirect=True)
@pytest.mark.parametrize('value', ['0', '-1', '65', 'x', '', '6 '])
def test_a_bad_value_of_a_kernel_option_is_wrong_usage(
        program: Path, folder: Path, value: str) -> None:
    message = refusal(program, folder, '--kernel-option', f'leaf-size={value}', status=2)
    assert 'leaf-size' in message


@pytest.mark.parametrize('program', ['funky-kd'], indirect=True)
def test_a_kernel_option_reaches_the_kernel_and_the_report(program: Path, folder: Path) -> None:
    corners = np.random.default_rng(1).uniform(-1, 1, (200, 1, 3))
    confetti = corners + np.random.default_rng(2).uniform(-0.05, 0.05, (200, 3, 3))
    write_triangles(folder / 'box.ra2', np.concatenate([box_triangles(), confetti]))
    small = render(program, folder, '--kernel-option', 'leaf-size=1')
    large = render(program, folder, '--kernel-option', 'leaf-size=64')
    assert small['kernel_options'] == {'leaf-size': '1'}
    assert large['kernel_options'] == {'leaf-size': '64'}
    assert small['memory']['kernel_final_bytes'] > large['memory']['kernel_final_bytes']


@pytest.mark.parametrize('option', ['--speed', '-x', '--passses=3', '--batch=maybe'])
def test_an_unknown_option_is_wrong_usage(program: Path, folder: Path, option: str) -> None:
    assert option.split('=')[0] in refusal(program, folder, option, status=2)


@pytest.mark.parametrize('option', ['--camera', '--passes', '--size', '--output', '--report'])
def test_an_option_without_its_value_is_wrong_usage(
        program: Path, folder: Path, option: str) -> None:
    assert option in complaint(run(program, '--batch', 'box.scene', option, cwd=folder), program, 2)


@pytest.mark.parametrize('option, value', [('--camera', 'box.camera'), ('--passes', '3'),
                                           ('--output', 'other')])
def test_an_option_given_twice_is_wrong_usage(
        program: Path, folder: Path, option: str, value: str) -> None:
    assert option in refusal(program, folder, option, value, option, value, status=2)


def test_batch_without_a_camera_is_wrong_usage(program: Path, folder: Path) -> None:
    result = run(program, '--batch', 'box.scene', cwd=folder)
    assert '--camera' in complaint(result, program, 2)


def test_a_missing_scene_is_wrong_usage(program: Path, folder: Path) -> None:
    result = run(program, '--batch', '--camera', 'box.camera', cwd=folder)
    assert 'SCENE' in complaint(result, program, 2)


def test_a_second_scene_is_wrong_usage(program: Path, folder: Path) -> None:
    assert 'box.scene' in refusal(program, folder, 'box.scene', status=2)


def test_wrong_usage_is_found_before_bad_files(program: Path, folder: Path) -> None:
    (folder / 'box.scene').unlink()
    assert '--passes' in refusal(program, folder, '--passes', '0', status=2)


def test_an_image_larger_than_the_memory_fails_with_one_line(program: Path, folder: Path) -> None:
    message = refusal(program, folder, '--size', '16384x16384', preexec_fn=lambda: resource.setrlimit(
        resource.RLIMIT_AS, (1_000_000_000, 1_000_000_000)))
    assert '16384x16384' in message and '1000000000' in message


@pytest.mark.parametrize('program', ['simple-bvh', 'funky-kd', 'yourkernel'], indirect=True)
def test_help_names_the_kernel_and_every_option(program: Path, tmp_path: Path) -> None:
    result = run(program, '--help', cwd=tmp_path)
    assert (result.returncode, result.stderr) == (0, '')
    assert program.name in result.stdout
    options = ['--batch', '--camera', '--threads', '--passes', '--size', '--seed', '--output',
               '--report', '--view', '--in-flight', '--replay', '--replay-seconds', '--kernel-option',
               '--help', '--version']
    assert [option for option in options if option not in result.stdout] == []


@pytest.mark.parametrize('program', ['simple-bvh', 'funky-kd', 'yourkernel'], indirect=True)
def test_version_names_the_kernel(program: Path, tmp_path: Path) -> None:
    result = run(program, '--version', cwd=tmp_path)
    assert (result.returncode, result.stderr) == (0, '')
    assert program.name in result.stdout and len(result.stdout.splitlines()) == 1


def test_options_may_follow_the_scene_and_take_an_equals_sign(program: Path, folder: Path) -> None:
    result = run(program, 'box.scene', '--batch', '--camera=box.camera', '--size=4x3', '--passes=3',
                 '--report=report.json', cwd=folder)
    assert result.returncode == 0, result.stderr
    report = json.loads((folder / 'report.json').read_text())
    assert (report['width'], report['height'], report['passes']) == (4, 3, 3)
