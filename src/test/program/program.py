# SPDX-License-Identifier: GPL-3.0-only
"""Runs an executable of bwfirt in batch mode."""

import json
import os
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[3]
BUILD = Path(os.environ.get('BWFIRT_BUILD', REPOSITORY / 'build')).resolve()
TIMEOUT_S = 60

DEFAULTS = {'--camera': 'box.camera', '--size': '16x12', '--passes': '2', '--threads': '2',
            '--output': 'image', '--report': 'report.json'}


def run(*command: str | Path, **process) -> subprocess.CompletedProcess[str]:
    """Runs a command to its end, with everything that it writes captured."""
    settings = {'capture_output': True, 'text': True, 'timeout': TIMEOUT_S,
                'stdin': subprocess.DEVNULL, 'check': False}
    return subprocess.run([str(word) for word in command], **(settings | process))


def batch_command(program: Path, *options: str | Path, scene: str | Path = 'box.scene') -> list:
    """The command of a batch run: DEFAULTS for every option that is not given."""
    defaults = [word for name, value in DEFAULTS.items() if name not in options
                for word in (name, value)]
    return [program, '--batch', *defaults, *options, scene]


def render(program: Path, folder: Path, *options: str | Path,
           scene: str | Path = 'box.scene', **process) -> dict:
    """The report of a batch run in the folder, which must succeed."""
    result = run(*batch_command(program, *options, scene=scene), cwd=folder, **process)
    assert result.returncode == 0, result.stderr
    return read_report(folder)


def wait_for_file(folder: Path, pattern: str, least_bytes: int = 0) -> None:
    """Until a file of this name and size is there, written by a process that runs meanwhile."""
    def bytes_of(path: Path) -> int:
        try:
            return path.stat().st_size
        except FileNotFoundError:  # it was there when the folder was listed
            return -1

    end = time.monotonic() + TIMEOUT_S
    while all(bytes_of(path) < least_bytes for path in folder.glob(pattern)):
        assert time.monotonic() < end, f'{pattern} has not come'
        time.sleep(0.01)


@contextmanager
def mounted_disk(folder: Path, size: str) -> Iterator[Path]:
    """A file system of that size, in a new folder."""
    disk = folder / 'disk'
    disk.mkdir()
    if run('mount', '-t', 'tmpfs', '-o', f'size={size}', 'tmpfs', disk).returncode != 0:
        pytest.skip('mounting a small file system needs rights that this process does not have')
    try:
        yield disk
    finally:
        run('umount', disk)


def read_report(folder: Path) -> dict:
    return json.loads((folder / 'report.json').read_text())


def snapshot(folder: Path) -> dict[str, tuple]:
    """What tells whether anything in the folder was written, made or removed."""
    return {path.name: (status.st_ino, status.st_size, status.st_mtime_ns)
            for path in folder.iterdir() for status in [path.lstat()]}


def complaint(result: subprocess.CompletedProcess[str], program: Path, status: int) -> str:
    """What a failed run says: one line after the program's name, besides warnings."""
    assert result.returncode == status, (result.returncode, result.stderr)
    lines = [line for line in result.stderr.splitlines()
             if not line.startswith(f'{program.name}: warning: ')]
    assert len(lines) == 1, result.stderr
    assert lines[0].startswith(f'{program.name}: ')
    return lines[0].removeprefix(f'{program.name}: ')


def refusal(program: Path, folder: Path, *options: str | Path, status: int = 1,
            scene: str | Path = 'box.scene', **process) -> str:
    """What a batch run says that must fail and leave the folder as it was."""
    before = snapshot(folder)
    result = run(*batch_command(program, *options, scene=scene), cwd=folder, **process)
    message = complaint(result, program, status)
    assert snapshot(folder) == before
    return message
