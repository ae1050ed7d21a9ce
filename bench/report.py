# SPDX-License-Identifier: GPL-3.0-only
"""Writes bench.pdf, bench.html and bench.csv from results; measures nothing."""

import csv
import io
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

import jinja2

import figures
import tables
from doubts import doubts, failures
from metrics import METRICS, Measured
from pictures import Difference, difference
from plan import RECORDER, REPLAY
from results import Result
from web import write_html

TEMPLATES = Path(__file__).resolve().parent / 'templates'
LATEX = [('pdflatex', 'texlive-latex-recommended and lmodern'),
         ('epstopdf', 'texlive-font-utils')]  # and the Debian packages that they are in


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
    """Compares the images with that of simple-bvh, or of the first kernel that has one."""
    runs = [run for kernel in measured.kernels if (run := measured.first(scene, kernel))
            and run.file('.exr').exists() and run.file('.png').exists()]
    runs.sort(key=lambda run: run.kernel != RECORDER)
    pictures = []
    for run in runs:
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
                                   [table(measured, scene) for table in tables.SCENE_TABLES]))
    return reports


def moment(measured: Measured) -> datetime:
    """SOURCE_DATE_EPOCH, or when the last run began: the same results make the same report."""
    given = os.environ.get('SOURCE_DATE_EPOCH')
    if given:
        return datetime.fromtimestamp(int(given), timezone.utc)
    return max(datetime.fromisoformat(result.bench['started']) for result in measured.results)


def commands(measured: Measured) -> list[str]:
    """What reproduces the results, and one command of each kernel."""
    done = [result for result in measured.results if result.done]
    commits = sorted({run.report['program']['commit'] for run in done})
    arguments = measured.results[-1].bench['arguments']
    lines = [*(f'git checkout {commit.removesuffix("-dirty")}' for commit in commits[:1]),
             'bench/setup.sh && scons && scons scenes', ' '.join(['bench/bench.py', *arguments])]
    for kernel in measured.kernels:
        first = next((run for run in done if run.kernel == kernel and run.kind != REPLAY), None)
        if first:
            lines.append(' '.join(Path(word).name if word.startswith('/') else word
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
        'summary': [table(measured) for table in tables.SUMMARY],
        'scenes': scene_reports(measured, folder),
        'overall': [table(measured) for table in tables.OVERALL_TABLES],
        'system': [table(measured) for table in tables.SYSTEM_TABLES],
        'commands': commands(measured),
    }


# ---- LaTeX --------------------------------------------------------------------------------------

LINE, CHARACTER, GAP = 495, 3.8, 8  # widths in a table: of all, of a character, of a gap, in points

SPECIAL = {'\\': r'\textbackslash{}', '~': r'\textasciitilde{}', '^': r'\textasciicircum{}',
           '-': '-{}', '\u2212': '$-$', '\u2013': '--', '\u2019': "'", '<': r'\textless{}',
           '>': r'\textgreater{}', '|': r'\textbar{}', '"': r'\textquotedbl{}',
           **{character: '\\' + character for character in '&%$#_{}'}}


def tex(text: str) -> str:
    """Text as LaTeX shows it. What Latin-1 does not have becomes a question mark."""
    latin = ''.join(c if c in SPECIAL or (c.isprintable() and ord(c) < 256) else '?' for c in text)
    return ''.join(SPECIAL.get(character, character) for character in latin)


def breakable(text: str) -> str:
    """The same with places where lines may break: in paths, flags and checksums."""
    pieces = []
    for position, character in enumerate(text):
        pieces.append(tex(character))
        if not character.isalnum() or position % 8 == 7:
            pieces.append(r'\allowbreak{}')
    return ''.join(pieces)


def fitting(table: tables.Table) -> list[tables.Table]:
    """Tables with some of the columns each, so that they fit the page; the first is in all."""
    def width(column: int) -> float:
        texts = [' '.join([row[column].text, row[column].error]).strip() for row in table.rows]
        return GAP + CHARACTER * max(map(len, [table.columns[column], *texts]))
    parts: list[list[int]] = [[]]
    for column in range(1, len(table.columns)):
        if parts[-1] and width(0) + sum(map(width, [*parts[-1], column])) > LINE:
            parts.append([])
        parts[-1].append(column)
    return [replace(table, columns=[table.columns[c] for c in [0, *part]],
                    rows=[[row[c] for c in [0, *part]] for row in table.rows]) for part in parts]


def run_quietly(command: list[str], folder: Path) -> None:
    result = subprocess.run(command, cwd=folder, check=False, stdin=subprocess.DEVNULL,
                            capture_output=True, text=True, errors='replace')
    if result.returncode:
        errors = [line for line in result.stdout.splitlines() if line.startswith('!')]
        raise ReportError(f"{command[0]}: {' '.join(errors) or result.stderr.strip()}")


def write_pdf(shown: dict[str, Any], drawn: Iterable[tuple[str, Any]], folder: Path) -> bytes:
    """Draws the figures as EPS, converts them by epstopdf, and typesets all by LaTeX."""
    names = []
    for name, figure in drawn:
        figure.savefig(folder / f'{name}.eps', bbox_inches='tight', pad_inches=0.02)
        names.append(name)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda name: run_quietly(['epstopdf', f'{name}.eps'], folder), names))
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), undefined=jinja2.StrictUndefined,
        block_start_string='<%', block_end_string='%>', variable_start_string='<<',
        variable_end_string='>>', comment_start_string='<#', comment_end_string='#>',
        trim_blocks=True, lstrip_blocks=True)
    environment.filters |= {'tex': tex, 'breakable': breakable, 'fitting': fitting}
    text = environment.get_template('bench.tex').render(shown | {'figures': set(names)})
    (folder / 'bench.tex').write_text(text, encoding='utf-8')
    for _ in range(2):  # the second time, long tables know their widths
        run_quietly(['pdflatex', '-interaction=nonstopmode', '-halt-on-error', '-no-shell-escape',
                     'bench.tex'], folder)
    return (folder / 'bench.pdf').read_bytes()


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
        writer.writerow([*(getattr(result, key) for key in keys), result.bench['started'],
                         result.report.get('triangles', ''),
                         *(_sample(metric, result) for metric in METRICS),
                         _intensity(result), _wrong(measured, result)])
    return text.getvalue()


def _sample(metric: Any, result: Result) -> str:
    if not result.done or (metric.kind == REPLAY) != (result.kind == REPLAY):
        return ''
    samples = sorted(metric.samples(result.report))
    return repr(samples[len(samples) // 2])


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


def require_output(base: Path) -> None:
    """What can be known before hours of measuring.

    @throws ReportError where LaTeX is not installed, or the folder cannot be written to
    """
    for program, package in LATEX:
        if shutil.which(program) is None:
            raise ReportError(f'{program} is missing: install the Debian packages {package}')
    folder = base.absolute().parent
    if not os.access(folder, os.W_OK):
        raise ReportError(f'{folder}: cannot be written to')


def write_report(measured: Measured, base: Path) -> list[Path]:
    """Writes BASE.csv, BASE.html and BASE.pdf; gives their paths.

    @throws ReportError where there are no results, or LaTeX fails; the other files are written then
    """
    if not measured.results:
        raise ReportError('there are no results to report')
    require_output(base)
    paths = [base.with_suffix(ending) for ending in ['.csv', '.html', '.pdf']]
    os.environ['SOURCE_DATE_EPOCH'] = str(int(moment(measured).timestamp()))
    os.environ['FORCE_SOURCE_DATE'] = '1'
    write_atomically(paths[0], write_csv(measured).encode())
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        shown = content(measured, folder)
        drawn = list(figures.draw_all(measured))
        write_atomically(paths[1], write_html(shown, drawn))
        write_atomically(paths[2], write_pdf(shown, drawn, folder))
    return paths
