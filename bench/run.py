# SPDX-License-Identifier: GPL-3.0-only
"""Makes the runs of a plan that are missing or out of date."""

import hashlib
import os
import shutil
import sys
import time
from datetime import datetime, timezone
from functools import cache
from pathlib import Path
from typing import Any

from tqdm import tqdm

import environment
from pictures import BadImage, check_images
from plan import RECORD, RECORDER, RENDER, CONTROL, REPLAY, ROOT, Plan, Run, Scene
from process import Limits, Outcome, run_process
from results import (DONE, NOT_MADE, Result, ResultsError, clear, locked, read_result,
                     write_result)
from runreport import BadReport, read_report

WARM_UP = ['--passes', '1', '--size', '64x48']
SPARE_BYTES = 2**24  # that have to be left on the disk before a run, besides its ray stream
BYTES_OF_A_QUESTION = 36  # of a ray stream


@cache
def _sha256(path: Path, _modified: int, _size: int) -> str:
    with open(path, 'rb') as stream:
        return hashlib.file_digest(stream, 'sha256').hexdigest()


def checksum(path: Path) -> str:
    """'none' where there is no file."""
    if not path.is_file():
        return 'none'
    status = path.stat()
    return _sha256(path, status.st_mtime_ns, status.st_size)


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
                 'triangles': scene.triangles}
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
        """The result in the folder, None where it is missing or out of date.

        A run that failed may do better within other limits.
        """
        result = read_result(self.folder / f'{run.name}.json')
        if result is None or result.fingerprint != self.fingerprint(run):
            return None
        limits = vars(self.limits)
        if not result.done and result.bench.get('limits', limits) != limits:
            return None
        if run.kind == RECORD and result.done and not self.stream(run.scene).exists():
            return None
        return result

    def is_needed(self, run: Run) -> bool:
        """What failed once in this way is not tried again with its further repeats.

        A ray stream is needed where a kernel is yet to replay it.
        """
        if run.kind == RECORD:
            return self.result_of(run) is None and any(
                self.is_needed(replay) for replay in self.plan.runs()
                if (replay.kind, replay.scene) == (REPLAY, run.scene))
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
        if self.writes_images(run):
            command += ['--output', str(output)]
        return command

    def writes_images(self, run: Run) -> bool:
        return run.kind == RENDER and run.repeat == 1 and run.threads == self.plan.threads

    def stream(self, scene: Scene) -> Path:
        assert self.plan.recorder
        return self.folder / f'{Run(RECORD, scene, self.plan.recorder, 1).name}.rays'

    def prepare(self, run: Run, unfinished: Path) -> Outcome:
        """What a run needs that is no measurement: a ray stream, and a warm-up."""
        if run.kind == REPLAY:
            assert self.plan.recorder
            record = self.result_of(Run(RECORD, run.scene, self.plan.recorder, 1))
            if record is None or not record.done:
                return Outcome(NOT_MADE, f'{RECORDER} recorded no rays')
        if run.scene.name not in self.warm:
            self.warm.add(run.scene.name)
            run_process([str(run.kernel.program), str(run.scene.file), '--batch', '--camera',
                         str(run.scene.camera), *WARM_UP], unfinished / 'warm-up.txt', self.limits)
            clear(unfinished)
        return Outcome(DONE)

    def make(self, run: Run, unfinished: Path) -> Result:
        """Makes one run and writes its result.

        @throws ResultsError where the disk is full
        """
        self.require_space(run)
        outcome = self.prepare(run, unfinished)
        output = unfinished / 'run'
        command = self.command(run, output)
        bench = {
            'scene': run.scene.name, 'kernel': run.kernel.name, 'kind': run.kind,
            'threads': run.threads, 'repeat': run.repeat, 'fingerprint': self.fingerprint(run),
            'scale': run.scene.scale, 'command': command, 'arguments': self.arguments,
            'session': self.session, 'started': datetime.now(timezone.utc).isoformat(),
            'machine': self.machine, 'limits': vars(self.limits)}
        clock = time.monotonic()
        disturbance = environment.Disturbance()
        if outcome.status == DONE:
            outcome = run_process(command, output.with_suffix('.txt'), self.limits)
        bench |= {'seconds': time.monotonic() - clock, 'disturbance': disturbance.end()}
        report: dict[str, Any] = {}
        if outcome.status == DONE:
            outcome, report = self.read(run, output)
        path = self.folder / run.name
        bench |= vars(outcome)
        write_result(path, report, bench, unfinished)
        result = read_result(path.with_name(path.name + '.json'))
        assert result
        return result

    def require_space(self, run: Run) -> None:
        stream = BYTES_OF_A_QUESTION * self.plan.extent.replay_rays if run.kind == RECORD else 0
        left = shutil.disk_usage(self.folder).free
        if left < SPARE_BYTES + stream:
            raise ResultsError(f'{self.folder}: only {left / 1e6:.1f} MB are left on its disk')

    def read(self, run: Run, output: Path) -> tuple[Outcome, dict[str, Any]]:
        """What a run wrote: its report and, for a look at them only, its images."""
        name, options = run.kernel.program.name.removeprefix('bwfirt-'), run.kernel.options
        asked = {'schema': 1, 'kernel': name, 'threads': run.threads,
                 'kernel_options': {key: value for key, _, value in
                                    (option.partition('=') for option in options)}}
        width, height = map(int, self.plan.extent.size.split('x'))
        if run.kind in (RENDER, CONTROL):
            asked |= {'passes': self.plan.extent.passes, 'width': width, 'height': height}
        try:
            report = read_report(output.with_suffix('.report'), run.kind, asked)
            if self.writes_images(run):
                check_images(output, width, height)
        except BadReport as bad:
            return Outcome(bad.status, bad.message), {}
        except BadImage as bad:
            return Outcome('unreadable image', str(bad)), {}
        return Outcome(DONE), report

    def measure(self) -> None:
        """Makes what is missing or out of date; prints a line for each run that was made."""
        with locked(self.folder) as unfinished:
            for scene in self.plan.growth:
                outcome = make_scene(scene, unfinished, self.limits)
                if outcome.status != DONE:
                    tqdm.write(f'{scene.name} is not made: {outcome.status} {outcome.message}')
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


def make_scene(scene: Scene, folder: Path, limits: Limits) -> Outcome:
    """Generates a scene of a growth curve where it is missing or older than its generator.

    @param folder for files that are not finished
    """
    name = scene.camera.stem
    generator = ROOT / 'scenes' / f'{name}.py'
    sources = [generator, *(ROOT / 'scenes' / 'model').glob('*.py'),
               *(ROOT / 'scenes' / f'{name}_parts').glob('*.py')]
    newest = max(source.stat().st_mtime for source in sources)
    if scene.file.exists() and scene.file.stat().st_mtime > newest:
        return Outcome(DONE)
    base = folder / scene.file.stem
    outcome = run_process([sys.executable, str(generator), str(base), '--scale', str(scene.scale)],
                          folder / 'generator.txt', limits)
    if outcome.status == DONE:
        scene.file.parent.mkdir(parents=True, exist_ok=True)
        for ending in ['.ra2', '.scene']:  # which names the one with the triangles
            os.replace(base.with_suffix(ending), scene.file.with_suffix(ending))
    clear(folder)
    return outcome


def remove(plan: Plan, folder: Path) -> None:
    """Removes all results of the plan's kernels on its scenes."""
    with locked(folder):
        for run in plan.runs():
            if run.kernel in plan.kernels:  # and not the recorder of the others
                shutil.rmtree((folder / run.name).parent, ignore_errors=True)
