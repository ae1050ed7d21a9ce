# SPDX-License-Identifier: GPL-3.0-only
"""A result that cannot be written is one line and status 1; old files keep their content.

Where the fault can be known beforehand, the run ends before it renders: such tests ask for more
passes than could ever be rendered.
"""

import os
import resource
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from box import write_box
from program import batch_command, complaint, mounted_disk, refusal, run

FOR_EVER = ('--passes', '1000000000')
OUTPUTS = ['image.exr', 'image.png', 'report.json']


def limit_file_size() -> None:
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))


@pytest.mark.parametrize('option', ['--output', '--report'])
def test_a_missing_output_folder_is_refused_before_rendering(
        program: Path, folder: Path, option: str) -> None:
    message = refusal(program, folder, *FOR_EVER, option, 'missing/result', timeout=10)
    assert message.startswith('missing/result')


@pytest.mark.parametrize('option', ['--output', '--report'])
def test_a_file_in_place_of_the_output_folder_is_refused_before_rendering(
        program: Path, folder: Path, option: str) -> None:
    message = refusal(program, folder, *FOR_EVER, option, 'box.scene/result', timeout=10)
    assert message.startswith('box.scene/result')


@pytest.mark.parametrize('name', OUTPUTS)
def test_an_output_path_that_is_a_folder_is_refused_before_rendering(
        program: Path, folder: Path, name: str) -> None:
    (folder / name).mkdir()
    assert refusal(program, folder, *FOR_EVER, timeout=10).startswith(f'{name}: ')
    assert list((folder / name).iterdir()) == []


@pytest.mark.parametrize('option', ['--output', '--report'])
def test_a_read_only_output_folder_is_refused_before_rendering(
        program: Path, folder: Path, option: str) -> None:
    closed = folder / 'closed'
    closed.mkdir(mode=0o555)
    command = batch_command(program, *FOR_EVER, option, 'closed/result')
    if os.geteuid() == 0:  # root writes everywhere unless it gives that right up
        command = ['setpriv', '--bounding-set=-dac_override', *command]
        if run(*command[:2], 'true').returncode != 0:
            pytest.skip('root cannot give up its right to write everywhere here')
    result = run(*command, cwd=folder, timeout=10)
    assert complaint(result, program, 1).startswith('closed/result')
    assert list(closed.iterdir()) == []


def test_a_file_size_limit_leaves_nothing_behind(program: Path, folder: Path) -> None:
    message = refusal(program, folder, preexec_fn=limit_file_size)
    assert message.startswith('image.exr: ')


def test_a_file_size_limit_leaves_old_files_as_they_were(program: Path, folder: Path) -> None:
    for name in OUTPUTS:
        (folder / name).write_text('old')
    refusal(program, folder, preexec_fn=limit_file_size)
    assert [(folder / name).read_text() for name in OUTPUTS] == ['old'] * 3


def test_a_report_beyond_the_file_size_limit_leaves_nothing_behind(
        program: Path, folder: Path) -> None:
    command = [program, '--batch', '--camera', 'box.camera', '--size', '4x4', '--passes', '1',
               '--report', 'report.json', 'box.scene']
    result = run(*command, cwd=folder, preexec_fn=limit_file_size)
    assert complaint(result, program, 1).startswith('report.json: ')
    assert sorted(path.name for path in folder.iterdir()) == ['box.camera', 'box.ra2', 'box.scene']


def test_a_full_standard_output_fails(program: Path, folder: Path) -> None:
    with open('/dev/full', 'w') as full:
        result = run(*batch_command(program), cwd=folder, capture_output=False, stdout=full,
                     stderr=subprocess.PIPE)
    assert complaint(result, program, 1).startswith('standard output: ')


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of 32 kB with the box on it."""
    with mounted_disk(tmp_path, '32k') as disk:
        write_box(disk)
        yield disk


def test_a_full_disk_leaves_nothing_behind(program: Path, small_disk: Path) -> None:
    message = refusal(program, small_disk, '--size', '160x120')
    assert message.startswith('image.exr: ')


def test_a_full_disk_leaves_old_files_as_they_were(program: Path, small_disk: Path) -> None:
    for name in OUTPUTS:
        (small_disk / name).write_text('old')
    refusal(program, small_disk, '--size', '160x120')
    assert [(small_disk / name).read_text() for name in OUTPUTS] == ['old'] * 3
