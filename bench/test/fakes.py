# SPDX-License-Identifier: GPL-3.0-only
"""Kernels that are none: scripts which take the command line of one and do what a test wants.

    bench = Bench(tmp_path)
    bench.kernel('good')
    bench.kernel('crashing', 'os.kill(os.getpid(), signal.SIGSEGV)')
    measured = bench.measure()
"""

import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

import run as bench_run
from metrics import Measured
from plan import Extent, Plan, built_kernels, find_kernels, find_scenes
from results import read_results
from run import Limits, Measurement
from stored import render_report, replay_report, write_images

BENCH = Path(bench_run.__file__).resolve().parent
SHORT = Extent(size='8x6', passes=16, repeats=3, controls=None, replay_rays=1000000,
               replay_seconds=1, replays_on_one_thread=True, growth=(),
               time_limit=20)
CAMERA = 'type pinhole\n'

# The code of a test runs where the report is known and nothing is written yet.
SCRIPT = '''\
#!/usr/bin/python3 -IS
import json, os, signal, sys, time

def given(option):
    return sys.argv[sys.argv.index(option) + 1] if option in sys.argv else None

NAME, IMAGE = __NAME__, __IMAGE__
KIND = next((kind for kind in ['record', 'replay'] if given(f'--{kind}')),
            'render' if given('--report') else 'warm-up')
SCENE = os.path.basename(sys.argv[1])

def note(text):
    """Appends a line to the file of all invocations."""
    line = os.open(__NOTES__, os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    os.write(line, f'{text}\\n'.encode())
    os.close(line)

note(f'{os.getpid()} {NAME} {KIND} {SCENE} {given("--threads")}')
report = json.loads(__REPLAY__ if KIND == 'replay' else __RENDER__)
options = [sys.argv[i + 1] for i, word in enumerate(sys.argv) if word == '--kernel-option']
report['kernel_options'] = dict(option.split('=') for option in options)
report['threads'] = int(given('--threads') or 0)
if KIND in ('render', 'warm-up'):
    report['passes'] = int(given('--passes'))
output = given('--output')

__CODE__

if output:
    for ending in ['.exr', '.png']:
        with open(IMAGE + ending, 'rb') as source, open(output + ending, 'wb') as copy:
            copy.write(source.read())
if given('--record'):
    with open(given('--record'), 'w') as stream:
        stream.write('rays')
if given('--report'):
    with open(given('--report'), 'w') as stream:
        json.dump(report, stream)
print('the report as text')
'''


class Bench:
    """A folder with kernels, scenes and results."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.build = folder / 'build'
        self.scenes = folder / 'scenes'
        self.results = folder / 'results'
        self.output = folder / 'report'
        self.notes = folder / 'invocations'
        if not self.build.exists():  # the folder is no copy
            for path in [self.build, self.scenes, self.build / 'images']:
                path.mkdir()
            self.scene('box')

    def copy(self, folder: Path) -> 'Bench':
        """With the results so far. Copied kernels still note in the old folder that they ran."""
        return Bench(shutil.copytree(self.folder, folder / 'copy'))

    def scene(self, name: str) -> None:
        (self.scenes / f'{name}.scene').write_text('triangles box.ra2\n')
        (self.scenes / f'{name}.camera').write_text(CAMERA)
        (self.scenes / 'box.ra2').write_bytes(bytes(36))

    def kernel(self, name: str, code: str = '', *, rate: float = 10,
               answers: dict[str, int] | None = None) -> Path:
        """Writes an executable.

        @param code     of Python; may change `report`, whose kind is KIND, or do something else
        @param rate     million rays per second, twice as many in the replay
        @param answers  of the replay, that are wrong, such as {'missed': 3}
        """
        image = self.build / 'images' / name
        write_images(image)
        script = SCRIPT
        for key, value in {'NOTES': str(self.notes), 'NAME': name, 'IMAGE': str(image),
                           'RENDER': json.dumps(render_report(name, rate=rate)),
                           'REPLAY': json.dumps(replay_report(name, rate=2 * rate,
                                                              answers=answers))}.items():
            script = script.replace(f'__{key}__', repr(value))
        path = self.build / f'bwfirt-{name}'
        path.unlink(missing_ok=True)
        path.write_text(script.replace('__CODE__', code))
        path.chmod(0o755)
        return path

    def plan(self, kernels: Sequence[str] = ('*',), scaling: Sequence[str] = (), threads: int = 2,
             control: str = 'funky-kd', replays: bool = True, **extent: Any) -> Plan:
        recorder = find_kernels(['simple-bvh'], self.build)[0] \
            if replays and 'simple-bvh' in built_kernels(self.build) else None
        return Plan(find_scenes([str(self.scenes)]), find_kernels(kernels, self.build), control, [],
                    list(scaling), threads, Extent(**{**vars(SHORT), **extent}), recorder)

    def measurement(self, plan: Plan | None = None, gigabytes: float = 4) -> Measurement:
        plan = plan or self.plan()
        return Measurement(plan, self.results, Limits(plan.extent.time_limit, int(1e9 * gigabytes)),
                           [])

    def measure(self, plan: Plan | None = None, gigabytes: float = 4) -> Measured:
        """Measures within this process."""
        self.measurement(plan, gigabytes).measure()
        return self.measured()

    def measured(self) -> Measured:
        return Measured(read_results(self.results))

    def command(self, *arguments: str | Path) -> list[str]:
        """Of bench.py, with its standard options where they are not given."""
        standard = {'--build': self.build, '--results': self.results, '--output': self.output,
                    '--scenes': self.scenes, '--kernels': '*', '--size': '8x6', '--threads': '2'}
        options = [str(word) for option, value in standard.items() if option not in arguments
                   for word in (option, value)]
        return [sys.executable, str(BENCH / 'bench.py'), *options, *map(str, arguments)]

    def run(self, *arguments: str | Path, timeout: float = 60, **process: Any
            ) -> subprocess.CompletedProcess[str]:
        """Runs bench.py to its end."""
        settings: dict[str, Any] = {'capture_output': True, 'text': True,
                                    'stdin': subprocess.DEVNULL, 'check': False}
        return subprocess.run(self.command(*arguments), timeout=timeout, **(settings | process))

    @contextmanager
    def started(self, *arguments: str | Path) -> Iterator[subprocess.Popen[str]]:
        """bench.py as it runs, which is killed in the end, if need be, with what it left behind."""
        process = subprocess.Popen(self.command(*arguments), stdin=subprocess.DEVNULL, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   start_new_session=True)
        try:
            yield process
        finally:
            process.kill()
            for pid in session(process.pid) - {process.pid}:
                os.kill(pid, signal.SIGKILL)
            process.communicate()

    def invocations(self, but: Sequence[str] = ('warm-up',)) -> list[str]:
        """'KERNEL KIND SCENE THREADS' of each run that began, in their order.

        @param but  kinds that are left out
        """
        lines = self.notes.read_text().splitlines() if self.notes.exists() else []
        words = [line.split(maxsplit=1)[1] for line in lines]
        return [line for line in words if line.split()[1] not in but]

    def processes(self) -> list[int]:
        """Of all kernels that have run: those that still do."""
        lines = self.notes.read_text().splitlines() if self.notes.exists() else []
        return [pid for line in lines if is_running(pid := int(line.split()[0]), line.split()[1])]


def is_running(pid: int, word: str) -> bool:
    """Whether there is a process, not a zombie, with that word on its command line."""
    try:
        return word in Path(f'/proc/{pid}/cmdline').read_text()
    except OSError:
        return False


def session(leader: int) -> set[int]:
    """Processes, not zombies, of the session of a process, itself included."""
    found = set()
    for path in Path('/proc').glob('[0-9]*/stat'):
        try:
            state, _, _, of_session = path.read_text().rpartition(')')[2].split()[:4]
        except OSError:  # it has ended
            continue
        if int(of_session) == leader and state != 'Z':
            found.add(int(path.parent.name))
    return found


def complaint(result: subprocess.CompletedProcess[str], status: int) -> str:
    """The one line in which bench.py says what is wrong."""
    assert result.returncode == status, (result.returncode, result.stderr)
    assert result.stderr.count('\n') == 1 and result.stderr.startswith('bench.py: '), result.stderr
    return result.stderr.removeprefix('bench.py: ').strip()


def files(folder: Path) -> set[str]:
    """All files in a folder of results, but for the lock."""
    return {str(path.relative_to(folder)) for path in folder.rglob('*')
            if path.is_file() and path.name != '.lock'}


def status_of(measured: Measured, kernel: str, kind: str = 'render') -> tuple[str, str]:
    """Status and message of the kernel's first run of a kind."""
    return next((result.status, result.message) for result in measured.results
                if (result.kernel, result.kind) == (kernel, kind))


def text_of(pdf: Path) -> str:
    """What one reads in a PDF, in one line."""
    result = subprocess.run(['pdftotext', '-layout', str(pdf), '-'], check=True, text=True,
                            capture_output=True)
    return ' '.join(result.stdout.split())


@contextmanager
def mounted_disk(folder: Path, megabytes: int) -> Iterator[Path]:
    """A file system of that size, in a new folder."""
    disk = folder / 'disk'
    disk.mkdir()
    command = ['mount', '-t', 'tmpfs', '-o', f'size={megabytes}m', 'tmpfs', str(disk)]
    if subprocess.run(command, check=False, stderr=subprocess.DEVNULL).returncode != 0:
        pytest.skip('mounting a small file system needs rights that this process does not have')
    try:
        yield disk
    finally:
        subprocess.run(['umount', str(disk)], check=True)


def clean_environment(**more: str) -> dict[str, str]:
    """Of this process, without what reports depend on."""
    kept = {key: value for key, value in os.environ.items()
            if key not in ('SOURCE_DATE_EPOCH', 'FORCE_SOURCE_DATE', 'BWFIRT_SCENES')}
    return kept | more
