# SPDX-License-Identifier: GPL-3.0-only
"""Makes the runs of a plan that are missing or out of date."""

import ctypes
import hashlib
import json
import math
import os
import resource
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from datetime import datetime, timezone
from functools import cache
from pathlib import Path
from typing import Any

from tqdm import tqdm

import environment
from metrics import METRICS
from plan import RECORD, RECORDER, RENDER, CONTROL, REPLAY, ROOT, Plan, Run, Scene
from results import DONE, Result, locked, read_result, write_result

PR_SET_PDEATHSIG = 1
CRASHES = {signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL}
WARM_UP = ['--passes', '1', '--size', '64x48']


@dataclass(frozen=True)
class Limits:
    """Of one process."""

    seconds: float
    bytes: int  # address space


@dataclass(frozen=True)
class Outcome:
    """How a process ended."""

    status: str
    message: str = ''


@cache
def sha256(path: Path) -> str:
    with open(path, 'rb') as stream:
        return hashlib.file_digest(stream, 'sha256').hexdigest()


def checksum(path: Path) -> str:
    return sha256(path) if path.is_file() else 'none'


def last_line(text: str) -> str:
    lines = text.strip().splitlines()
    return lines[-1][:300] if lines else ''


def _outcome(status: int, errors: str) -> Outcome:
    if status == 0:
        return Outcome(DONE)
    message = last_line(errors)
    if status < 0:
        name = signal.Signals(-status).name
        if 'bad_alloc' in errors:
            return Outcome('out of memory', message)
        if -status == signal.SIGKILL:
            return Outcome('killed', f'{name}, perhaps for want of memory')
        return Outcome('crashed' if -status in CRASHES else 'killed', f'{name} {message}'.strip())
    if 'memory' in message.lower():
        return Outcome('out of memory', message)
    return Outcome(f'exit status {status}', message)


def run_process(command: list[str], text: Path, limits: Limits) -> Outcome:
    """Runs a process with all that it prints in a file, and ends it and its children in time."""
    libc = ctypes.CDLL(None)

    def restrict() -> None:
        libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        resource.setrlimit(resource.RLIMIT_AS, (limits.bytes, limits.bytes))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    errors = text.with_suffix('.errors')
    try:
        with open(text, 'wb') as output, open(errors, 'wb') as error_output:
            try:
                process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output,
                                           stderr=error_output, start_new_session=True,
                                           preexec_fn=restrict)
            except OSError as error:
                return Outcome('not started', str(error))
            try:
                process.wait(limits.seconds)
            except subprocess.TimeoutExpired:
                return Outcome('timed out', f'after {limits.seconds:g} s')
            finally:
                try:
                    os.killpg(process.pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
                process.wait()
        return _outcome(process.returncode, errors.read_text(encoding='utf-8', errors='replace'))
    finally:
        with open(text, 'ab') as output:
            output.write(errors.read_bytes())
        errors.unlink()


def read_report(path: Path, run: Run, plan: Plan) -> tuple[Outcome, dict[str, Any]]:
    """A report is unreadable where it lacks a figure, or tells of another run than was asked for."""
    try:
        report = json.loads(path.read_text(encoding='utf-8'))
        asked = {'schema': 1, 'kernel': run.kernel.name.partition(':')[0], 'threads': run.threads}
        if run.kind in (RENDER, CONTROL):
            asked['passes'] = plan.extent.passes
        for key, expected in asked.items():
            if report[key] != expected:
                return Outcome('wrong report', f'{key} is {report[key]}, not {expected}'), {}
        for metric in METRICS:
            if metric.kind == (REPLAY if run.kind == REPLAY else RENDER) and run.kind != RECORD:
                if not all(math.isfinite(sample) for sample in metric.samples(report)):
                    return Outcome('wrong report', f'{metric.name} is not finite'), {}
    except FileNotFoundError:
        return Outcome('unreadable report', 'there is none'), {}
    except (OSError, ValueError) as error:
        return Outcome('unreadable report', str(error)), {}
    except (KeyError, TypeError, AttributeError, IndexError) as error:
        return Outcome('unreadable report', f'{type(error).__name__}: {error}'), {}
    return Outcome(DONE), report


class Measurement:
    """Makes the runs of a plan, and keeps their results in a folder."""

    def __init__(self, plan: Plan, folder: Path, limits: Limits, arguments: list[str]) -> None:
        """@param arguments of bench.py, for the record"""
        self.plan = plan
        self.folder = folder
        self.limits = limits
        self.arguments = arguments
        self.machine = environment.machine()
        self.session = datetime.now(timezone.utc).isoformat(timespec='seconds')
        self.warm: set[str] = set()  # names of scenes

    def fingerprint(self, run: Run) -> dict[str, Any]:
        """All that the measurement depends on but its repeat and its own number of threads."""
        extent = self.plan.extent
        scene = run.scene
        files = {'program': run.kernel.program, 'scene': scene.file, 'camera': scene.camera,
                 'triangles': scene.triangles if scene.file.exists() else scene.file}
        fingerprint: dict[str, Any] = {key: checksum(path) for key, path in files.items()}
        fingerprint |= {'size': extent.size, 'cpu': self.machine['cpu'],
                        'affinity': self.machine['affinity']}
        if run.kind in (RECORD, REPLAY):
            fingerprint['replay_rays'] = extent.replay_rays
        else:
            fingerprint['passes'] = extent.passes
        if run.kind == REPLAY:
            assert self.plan.recorder
            fingerprint |= {'recorder': checksum(self.plan.recorder.program),
                            'replay_seconds': extent.replay_seconds}
        if run.kind != RECORD:
            fingerprint['threads'] = self.plan.threads
        return fingerprint

    def result_of(self, run: Run) -> Result | None:
        """The result in the folder, None where it is missing or out of date."""
        result = read_result(self.folder / f'{run.name}.json')
        if result is None or result.fingerprint != self.fingerprint(run):
            return None
        if run.kind == RECORD and result.done and not self.stream(run.scene).exists():
            return None
        return result

    def is_needed(self, run: Run) -> bool:
        """What failed once in this way is not tried again with its further repeats.

        A ray stream is needed where a kernel is yet to replay it.
        """
        if run.kind == RECORD:
            replays = (Run(REPLAY, run.scene, kernel, self.plan.threads)
                       for kernel in self.plan.kernels)
            return self.result_of(run) is None and any(map(self.is_needed, replays))
        first = Run(run.kind, run.scene, run.kernel, run.threads)
        failed = (result := self.result_of(first)) is not None and not result.done
        return not failed and self.result_of(run) is None

    def missing(self) -> list[Run]:
        """The runs that are to be made, in their order."""
        return [run for run in self.plan.runs() if self.is_needed(run)]

    def command(self, run: Run, output: Path) -> list[str]:
        """@param output base of the names of the run's files"""
        extent = self.plan.extent
        command = [str(run.kernel.program), str(run.scene.file), '--threads', str(run.threads),
                   '--report', f'{output}.report']
        for option in run.kernel.options:
            command += ['--kernel-option', option]
        if run.kind == REPLAY:
            return [*command, '--replay', str(self.stream(run.scene)),
                    '--replay-seconds', str(extent.replay_seconds)]
        command += ['--batch', '--camera', str(run.scene.camera), '--size', extent.size]
        if run.kind == RECORD:
            return [*command, '--record', f'{output}.rays', '--rays', str(extent.replay_rays)]
        command += ['--passes', str(extent.passes)]
        if run.kind == RENDER and run.repeat == 1 and run.threads == self.plan.threads:
            command += ['--output', str(output)]
        return command

    def stream(self, scene: Scene) -> Path:
        assert self.plan.recorder
        return self.folder / f'{Run(RECORD, scene, self.plan.recorder, 1).name}.rays'

    def prepare(self, run: Run, unfinished: Path) -> Outcome:
        """What a run needs that is no measurement: a ray stream, and a warm-up."""
        if run.kind == REPLAY:
            assert self.plan.recorder
            record = self.result_of(Run(RECORD, run.scene, self.plan.recorder, 1))
            if record is None or not record.done:
                return Outcome('not made', f'{RECORDER} recorded no rays')
        if run.scene.name not in self.warm:
            self.warm.add(run.scene.name)
            run_process([str(run.kernel.program), str(run.scene.file), '--batch', '--camera',
                         str(run.scene.camera), *WARM_UP], unfinished / 'warm-up.txt', self.limits)
            (unfinished / 'warm-up.txt').unlink()
        return Outcome(DONE)

    def make(self, run: Run, unfinished: Path) -> Result:
        """Makes one run and writes its result."""
        outcome = self.prepare(run, unfinished)
        output = unfinished / 'run'
        command = self.command(run, output)
        started = datetime.now(timezone.utc)
        clock = time.monotonic()
        disturbance = environment.Disturbance()
        report: dict[str, Any] = {}
        if outcome.status == DONE:
            outcome = run_process(command, output.with_suffix('.txt'), self.limits)
        if outcome.status == DONE:
            outcome, report = read_report(output.with_suffix('.report'), run, self.plan)
        output.with_suffix('.report').unlink(missing_ok=True)
        bench = {
            'scene': run.scene.name, 'kernel': run.kernel.name, 'kind': run.kind,
            'threads': run.threads, 'repeat': run.repeat, 'status': outcome.status,
            'message': outcome.message, 'fingerprint': self.fingerprint(run),
            'scale': run.scene.scale, 'command': [str(word) for word in command],
            'arguments': self.arguments, 'session': self.session, 'started': started.isoformat(),
            'seconds': time.monotonic() - clock, 'machine': self.machine,
            'disturbance': disturbance.end(),
        }
        path = self.folder / run.name
        write_result(path, report, bench, unfinished)
        result = read_result(path.with_name(path.name + '.json'))
        assert result
        return result

    def measure(self) -> None:
        """Makes what is missing or out of date; prints a line for each run that was made."""
        with locked(self.folder) as unfinished:
            for scene in self.plan.growth:
                make_scene(scene)
            runs = self.missing()
            seconds: dict[tuple[str, str], float] = {}  # that a kernel took last, by scene
            with tqdm(total=len(runs), disable=not sys.stderr.isatty(), leave=False,
                      bar_format='{bar:20} {n_fmt}/{total_fmt} {desc}') as bar:
                for number, run in enumerate(runs):
                    bar.set_description_str(f'{run.name}{time_left(runs[number:], seconds)}')
                    if self.is_needed(run):  # until an earlier repeat failed
                        result = self.make(run, unfinished)
                        seconds[run.scene.name, run.kernel.name] = result.bench['seconds']
                        tqdm.write(f'{number + 1}/{len(runs)} {run.name}: '
                                   f'{result.status} {result.message}'.rstrip())
                    bar.update()


def time_left(runs: list[Run], seconds: dict[tuple[str, str], float]) -> str:
    """By the time that a kernel took last on a scene, or the mean of all."""
    if not seconds:
        return ''
    mean = sum(seconds.values()) / len(seconds)
    left = sum(seconds.get((run.scene.name, run.kernel.name), mean) for run in runs)
    return f', {left / 60:.0f} min left' if left >= 60 else f', {left:.0f} s left'


def make_scene(scene: Scene) -> None:
    """Generates a scene of a growth curve where it is missing or older than its generator."""
    name = scene.camera.stem
    generator = ROOT / 'scenes' / f'{name}.py'
    sources = [generator, *(ROOT / 'scenes' / 'model').glob('*.py'),
               *(ROOT / 'scenes' / f'{name}_parts').glob('*.py')]
    newest = max(source.stat().st_mtime for source in sources)
    if scene.file.exists() and scene.file.stat().st_mtime > newest:
        return
    scene.file.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, str(generator), str(scene.file.with_suffix('')),
                    '--scale', str(scene.scale)], check=True)


def remove(plan: Plan, folder: Path) -> None:
    """Removes all results of the plan's kernels on its scenes."""
    with locked(folder):
        for run in plan.runs():
            shutil.rmtree((folder / run.name).parent, ignore_errors=True)
