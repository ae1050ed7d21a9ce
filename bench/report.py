# SPDX-License-Identifier: GPL-3.0-only
"""Writes bench.pdf, bench.html and bench.csv from results; measures nothing."""

import csv
import io
import os
import shlex
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from ctypes.util import find_library
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

import figures
import tables
from doubts import doubts, failures
from latex import require_latex, write_pdf
from metrics import METRICS, Measured, metrics_of
from pictures import Difference, difference
from plan import RECORDER, REPLAY
from results import Result
from web import write_html


class ReportError(Exception):
    """A report that cannot be made."""


@dataclass(frozen=True)
class Picture:
    """A kernel's image of a scene, and how it differs from that of the kernel compared with."""

    kernel: str
    file: Path
    difference: Difference | None  # None for the image that others are compared with
    difference_file: Path | None  # None where no pixel differs


@dataclass(frozen=True)
class SceneReport:
    """What there is to show of one scene."""

    number: int
    name: str
    run: dict[str, Any]  # the run report of the first kernel
    pictures: list[Picture]
    tables: list[tables.Table]

    @property
    def picture(self) -> Picture | None:
        """The one that others are compared with."""
        return next((picture for picture in self.pictures if picture.difference is None), None)


def pictures_of(measured: Measured, scene: str, number: int, folder: Path) -> list[Picture]:
    """Compares the images with that of simple-bvh, or of the first kernel that has one.

    Images of another size, which are results of another benchmark, are left out.
    """
    def size(run: Result) -> tuple[int, int]:
        return run.report['width'], run.report['height']
    runs = [run for kernel in measured.kernels if (run := measured.first(scene, kernel))
            and run.file('.exr').exists() and run.file('.png').exists()]
    runs.sort(key=lambda run: run.kernel != RECORDER)
    pictures = []
    for run in [run for run in runs if size(run) == size(runs[0])]:
        output = folder / f'{number}-difference-{measured.kernels.index(run.kernel)}.png'
        found = None
        if run is not runs[0]:
            found = difference(run.file('.exr'), runs[0].file('.exr'), output)
        png = folder / f'{number}-image-{measured.kernels.index(run.kernel)}.png'
        shutil.copy(run.file('.png'), png)
        pictures.append(Picture(run.kernel, png, found, output if output.exists() else None))
    return pictures


def scene_reports(measured: Measured, folder: Path) -> list[SceneReport]:
    reports = []
    for number, scene in enumerate(measured.scenes):
        first = next((run for kernel in measured.kernels if (run := measured.first(scene, kernel))),
                     None)
        reports.append(SceneReport(number, scene, first.report if first else {},
                                   pictures_of(measured, scene, number, folder),
                                   tables.of_scene(measured, scene)))
    return reports


def moment(measured: Measured) -> datetime:
    """SOURCE_DATE_EPOCH, or when the last run began: the same results make the same report.

    @throws ReportError where SOURCE_DATE_EPOCH is no number
    """
    given = os.environ.get('SOURCE_DATE_EPOCH')
    try:
        if given:
            return datetime.fromtimestamp(int(given), timezone.utc)
    except (ValueError, OverflowError):
        raise ReportError(f'SOURCE_DATE_EPOCH is {given}, not a number of seconds') from None
    return max(datetime.fromisoformat(result.bench['started']) for result in measured.results)


def commands(measured: Measured) -> list[str]:
    """What reproduces the results, and one command of each kernel."""
    done = [result for result in measured.results if result.done]
    commits = sorted({run.report['program']['commit'] for run in done})
    benches = dict.fromkeys(shlex.join(['bench/bench.py', *result.bench['arguments']])
                            for result in measured.results)
    lines = [*(f'git checkout {commit.removesuffix("-dirty")}' for commit in commits[:1]),
             'bench/setup.sh && scons && scons scenes', *benches]
    for kernel in measured.kernels:
        first = next((run for run in done if run.kernel == kernel and run.kind != REPLAY), None)
        if first:
            lines.append(shlex.join(Path(word).name if word.startswith('/') else word
                                    for word in first.bench['command']))
    return lines


def content(measured: Measured, folder: Path) -> dict[str, Any]:
    """All that both templates show. Pictures go to the folder."""
    date = moment(measured)
    done = [result for result in measured.results if result.done]
    last = measured.results[-1]
    rendered = next((result.fingerprint for result in reversed(measured.results)
                     if 'passes' in result.fingerprint), last.fingerprint)
    return {
        'date': date.strftime('%Y-%m-%d %H:%M UTC'),
        'version': done[-1].report['program']['version'] if done else '',
        'commit': done[-1].report['program']['commit'] if done else 'unknown',
        'cpu': last.bench['machine']['cpu'],
        'threads': measured.threads,
        'size': rendered['size'],
        'passes': rendered.get('passes', 0),
        'repeats': max((result.repeat for result in measured.results), default=0),
        'kernels': measured.kernels,
        'reference': measured.reference,
        'warnings': doubts(measured),
        'failures': tables.failure_table(measured) if failures(measured) else None,
        'summary': tables.summary(measured),
        'scenes': scene_reports(measured, folder),
        'overall': [table(measured) for table in tables.OVERALL_TABLES],
        'system': [table(measured) for table in tables.SYSTEM_TABLES],
        'commands': commands(measured),
    }


# ---- CSV ----------------------------------------------------------------------------------------


def write_csv(measured: Measured) -> str:
    """One row a run, done or failed."""
    keys = ['scene', 'kernel', 'kind', 'threads', 'repeat', 'status', 'message']
    text = io.StringIO()
    writer = csv.writer(text, lineterminator='\n')
    writer.writerow([*keys, 'started', 'triangles',
                     *(f'{metric.key} [{metric.unit}]' if metric.unit else metric.key
                       for metric in METRICS), 'average_intensity', 'wrong_per_million'])
    for result in measured.results:
        told = metrics_of(result.kind) if result.done else []
        writer.writerow([*(getattr(result, key) for key in keys), result.bench['started'],
                         result.report.get('triangles', ''),
                         *(repr(metric.value(result.report)) if metric in told else ''
                           for metric in METRICS),
                         _intensity(result), _wrong(measured, result)])
    return text.getvalue()


def _intensity(result: Result) -> str:
    values = result.report.get('average_intensity') or [None]
    return '' if values[0] is None else repr(values[0])


def _wrong(measured: Measured, result: Result) -> str:
    wrong = measured.wrong_per_million(result.scene, result.kernel)
    return '' if wrong is None else repr(wrong)


# ---- All ----------------------------------------------------------------------------------------


def write_atomically(path: Path, data: bytes) -> None:
    unfinished = path.with_name(f'.{path.name}.{os.getpid()}')
    try:
        unfinished.write_bytes(data)
        os.replace(unfinished, path)
    finally:
        unfinished.unlink(missing_ok=True)


@contextmanager
def dated(date: datetime) -> Iterator[None]:
    """Lets matplotlib and LaTeX write this date into files."""
    before = dict(os.environ)
    os.environ |= {'SOURCE_DATE_EPOCH': str(int(date.timestamp())), 'FORCE_SOURCE_DATE': '1'}
    try:
        yield
    finally:
        os.environ.clear()
        os.environ |= before


def require_output(base: Path) -> None:
    """What can be known before hours of measuring.

    @throws LatexError where LaTeX is not installed
    @throws ReportError where FreeImage is not, or the folder cannot be written to
    """
    require_latex()
    if find_library('freeimage') is None:
        raise ReportError('FreeImage is missing: install the Debian package libfreeimage3')
    folder = base.absolute().parent
    if not os.access(folder, os.W_OK):
        raise ReportError(f'{folder}: cannot be written to')


def write_report(measured: Measured, base: Path) -> list[Path]:
    """Writes BASE.csv, BASE.html and BASE.pdf; gives their paths.

    @throws ReportError where there are no results
    @throws LatexError where LaTeX fails; the other files are written then
    """
    if not measured.results:
        raise ReportError('there are no results to report')
    require_output(base)
    paths = [base.with_name(base.name + ending) for ending in ['.csv', '.html', '.pdf']]
    write_atomically(paths[0], write_csv(measured).encode(errors='replace'))
    with tempfile.TemporaryDirectory() as name, dated(moment(measured)):
        folder = Path(name)
        shown = content(measured, folder)
        names = figures.draw_all(measured, folder)
        write_atomically(paths[1], write_html(shown, names, folder))
        write_atomically(paths[2], write_pdf(shown, names, folder))
    return paths
