# SPDX-License-Identifier: GPL-3.0-only
"""The results of runs: files in a folder, one JSON and one text file a run, and images.

The JSON file is the run report of the kernel (doc/file-formats) with one more key, 'bench', which
holds how the run went. It is written last, so that a run without one has not been made.
"""

import fcntl
import json
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

DONE = 'done'
NOT_MADE = 'not made'  # for want of what another run should have made
LOCK = '.lock'
UNFINISHED = '.unfinished'  # a folder for the files of the run under way
ENDINGS = ['.txt', '.exr', '.png', '.rays']  # of the files of a run that are kept, besides .json
KEYS = ['scene', 'kernel', 'kind', 'threads', 'repeat', 'status', 'message', 'fingerprint']
MORE_KEYS = ['scale', 'command', 'arguments', 'session', 'started', 'seconds', 'machine',
             'disturbance']


class ResultsError(Exception):
    """A folder of results that cannot be used."""


@dataclass(frozen=True)
class Result:
    """What came of one run."""

    folder: Path  # of the run's files
    name: str  # of the run's files, without an ending
    scene: str
    kernel: str
    kind: str  # plan.RENDER, CONTROL, RECORD or REPLAY
    threads: int
    repeat: int
    status: str  # DONE, or in what way it failed
    message: str  # what the failed run said
    fingerprint: dict[str, Any]  # of all that the measurement depends on
    bench: dict[str, Any]  # everything about the run
    report: dict[str, Any] = field(repr=False)  # of the kernel; empty where it failed

    @property
    def done(self) -> bool:
        return self.status == DONE

    def file(self, ending: str) -> Path:
        return self.folder / (self.name + ending)


def read_result(path: Path) -> Result | None:
    """None where the file is no result."""
    try:
        report = json.loads(path.read_text(encoding='utf-8'))
        bench = report.pop('bench')
        fields = {key: bench[key] for key in KEYS}
        if not all(key in bench for key in MORE_KEYS):
            return None
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None
    return Result(folder=path.parent, name=path.name.removesuffix('.json'), bench=bench,
                  report=report if bench['status'] == DONE else {}, **fields)


def read_results(folder: Path) -> list[Result]:
    """All results in a folder that are not out of date, in the order of their making.

    Where a kernel's runs on a scene have several fingerprints, because it has changed, or because
    something else was measured, only those are taken that fit the newest one of their kind, and, in
    what kinds have in common, the newest one of all.
    """
    results = [result for path in sorted(folder.glob('*/*/*.json'))
               if (result := read_result(path))]
    results.sort(key=lambda result: result.bench['started'])
    of_kind = {(result.scene, result.kernel, result.kind): result for result in results}
    of_all = {(result.scene, result.kernel): result for result in results}
    return [result for result in results
            if result.fingerprint == of_kind[result.scene, result.kernel, result.kind].fingerprint
            and fits(result, of_all[result.scene, result.kernel])]


def fits(result: Result, other: Result) -> bool:
    """Whether their fingerprints are the same where both have a value."""
    common = result.fingerprint.keys() & other.fingerprint.keys()
    return all(result.fingerprint[key] == other.fingerprint[key] for key in common)


def write_result(path: Path, report: dict[str, Any], bench: dict[str, Any], folder: Path) -> None:
    """Moves a run's files from a folder to PATH.*, and writes PATH.json last, in one step.

    Nothing remains of an older result, nor of other files in the folder.

    @param path without an ending
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    Path(f'{path}.json').unlink(missing_ok=True)
    for ending in ENDINGS:
        if (file := folder / f'run{ending}').is_file():
            os.replace(file, f'{path}{ending}')
        else:
            Path(f'{path}{ending}').unlink(missing_ok=True)
    unfinished = folder / 'result.json'
    with open(unfinished, 'w', encoding='utf-8') as stream:
        json.dump({**report, 'bench': bench}, stream, indent=2)
        stream.flush()
        os.fsync(stream.fileno())
    os.replace(unfinished, f'{path}.json')
    clear(folder)


def clear(folder: Path) -> None:
    """Removes all that is in it."""
    for path in folder.iterdir():
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink()


@contextmanager
def locked(folder: Path) -> Iterator[Path]:
    """Keeps others from measuring into the folder; gives a folder for the files of a run.

    @throws ResultsError where another process does so already
    """
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / LOCK, 'a+', encoding='utf-8') as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            lock.seek(0)
            raise ResultsError(f'{folder}: another bench.py, process {lock.read().strip()}, '
                               'measures there') from None
        lock.truncate(0)
        lock.write(str(os.getpid()))
        lock.flush()
        unfinished = folder / UNFINISHED
        shutil.rmtree(unfinished, ignore_errors=True)
        unfinished.mkdir()
        try:
            yield unfinished
        finally:
            shutil.rmtree(unfinished, ignore_errors=True)
