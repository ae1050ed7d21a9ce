# SPDX-License-Identifier: GPL-3.0-only
"""The tables of the report, one function each."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from doubts import failures, percent
from metrics import (ALONE, ANSWERS, BYTES_PER_TRIANGLE, FINAL, INITIALIZE, OVERALL, PEAK,
                     PEAK_PER_TRIANGLE, RATE, RATE_H, RATE_IN_FLIGHT, RATE_MIXED, RATE_V, RENDERING,
                     TOTAL, Measured, Metric, Report, Spread)
from plan import CONTROL, RECORD
from texts import ppm_wrong, short, si


@dataclass(frozen=True)
class Cell:
    """Of a table. Numbers are aligned to the right."""

    text: str
    value: float | None = None  # what a reader sorts by; None for text
    is_best: bool = False
    error: str = ''  # shown beside the figure


@dataclass(frozen=True)
class Table:
    """Rows of cells under their columns' names."""

    title: str
    columns: list[str]
    rows: list[list[Cell]] = field(default_factory=list)
    note: str = ''


COMPARED = {RATE_MIXED: 'mixed', RATE_IN_FLIGHT: 'in flight'}  # with the best of the peers


def number(x: float, text: str | None = None, **more: object) -> Cell:
    return Cell(text if text is not None else short(x), x, **more)  # type: ignore[arg-type]


NOTHING = Cell('\u2013')


def wrong_answers(measured: Measured, scene: str, kernel: str) -> str:
    """Empty where nothing is known against them."""
    wrong = measured.wrong_per_million(scene, kernel)
    if wrong:
        return ppm_wrong(wrong)
    return '' if measured.is_right(scene, kernel) else 'answers not checked'


def figure_cell(measured: Measured, metric: Metric, scene: str, kernel: str,
                with_range: bool = False) -> Cell:
    """A median, or how the runs failed. Wrong answers have to be shown beside it."""
    spread = measured.spread(metric, scene, kernel)
    if spread is None:
        runs = measured.runs(scene, kernel, metric.kind, metric.threads)
        failed = [run for run in runs if not run.done]
        return Cell('', error=failed[0].status) if failed else NOTHING
    text = short(spread.median)
    if with_range and not metric.is_exact:
        text += f' ({short(spread.lowest)}\u2013{short(spread.highest)})'
    return number(spread.median, text, is_best=kernel in measured.best(metric, scene))


def kernel_cell(measured: Measured, scene: str, kernel: str) -> Cell:
    """Its name, with its wrong answers where there are any."""
    return Cell(kernel, error=wrong_answers(measured, scene, kernel))


def speed(measured: Measured) -> Table:
    noise = measured.noise(RATE)
    note = ('Bold: the best, and all that cannot be told from it because their ranges overlap or '
            'they differ by less than the noise' +
            (f', which is {percent(noise)} here' if noise is not None else '') +
            '. Kernels whose answers are wrong are not ranked.')

    def cell(scene: str, kernel: str) -> Cell:
        figure = figure_cell(measured, RATE, scene, kernel)
        return replace(figure, error=figure.error or wrong_answers(measured, scene, kernel))
    rows = [[Cell(scene), *(cell(scene, kernel) for kernel in measured.kernels)]
            for scene in measured.scenes]
    return Table('Million rays per second, gross: medians', ['scene', *measured.kernels], rows,
                 note)


def kernels(measured: Measured) -> Table:
    failed = failures(measured)

    def mean(metric: Metric, kernel: str) -> Cell:
        relative = measured.relative(metric, kernel)
        if relative is None:
            return NOTHING
        value, scenes = relative.geometric_mean, len(relative.samples)
        some = f' [{scenes}]' if scenes < len(measured.scenes) else ''
        return number(value, short(value) + some)

    def row(kernel: str) -> list[Cell]:
        wrong = [ppm for scene in measured.scenes
                 if (ppm := measured.wrong_per_million(scene, kernel)) is not None]
        count = sum(row[1] == kernel for row in failed)
        return [Cell(kernel), *(mean(metric, kernel) for metric in OVERALL),
                number(max(wrong), si(max(wrong))) if wrong else Cell('not checked'),
                number(count, str(count))]
    names = {RATE: 'rays', RATE_H: 'h', RATE_V: 'V', RATE_MIXED: 'h and V',
             RATE_IN_FLIGHT: 'in flight', TOTAL: 'total time', INITIALIZE: 'initialise',
             PEAK: 'peak mem.', FINAL: 'final mem.'}
    return Table(f'Geometric means over the scenes, relative to {measured.reference}',
                 ['kernel', *(names[metric] for metric in OVERALL), 'wrong ppm', 'failures'],
                 [row(kernel) for kernel in measured.kernels],
                 'Times and memory: less is better; rays, h, V (replayed): more is better. A '
                 'number in brackets tells of how many scenes a mean is, where it is not of '
                 'all. Wrong: answers in a million, on the worst scene.')


def kernels_alone(threads: int) -> str:
    return f"Kernels alone, {f'{threads} threads' if threads > 1 else 'one thread'}"


def by_peer(measured: Measured, threads: int) -> Table:
    def cell(metric: Metric, kernel: str) -> Cell:
        ratios = {scene: spread.median for scene in measured.scenes
                  if (spread := measured.by_peer(metric.alone(threads), scene, kernel))}
        if not ratios:
            return NOTHING
        least, greatest = (choose(ratios, key=ratios.__getitem__) for choose in (min, max))
        mean = Spread(tuple(ratios.values())).geometric_mean
        some = f' [{len(ratios)}]' if len(ratios) < len(measured.scenes) else ''
        return number(mean, f'{mean:.2f}{some} ({ratios[least]:.2f} {least}\u2013'
                            f'{ratios[greatest]:.2f} {greatest})')
    return Table(f'{kernels_alone(threads)}: geometric means over the scenes, by the peer',
                 ['kernel', *COMPARED.values()],
                 [[Cell(kernel), *(cell(metric, kernel) for metric in COMPARED)]
                  for kernel in measured.kernels],
                 'In parentheses: the scenes of the least and the greatest ratio. A number in '
                 'brackets tells of how many scenes a mean is, where it is not of all: a kernel '
                 'that answers wrongly on a scene has no ratio there. Peer: the fastest on the '
                 f"scene of these, wrong or right: {', '.join(measured.peers)}.")


def failure_table(measured: Measured) -> Table:
    return Table('Failures', ['scene', 'kernel', 'what', 'message'],
                 [[Cell(text) for text in row] for row in failures(measured)])


def times(measured: Measured, scene: str) -> Table:
    metrics = {INITIALIZE: 'initialise s', RENDERING: 'render s', TOTAL: 'total s',
               RATE: 'Mrays/s, gross'}
    rows = [[kernel_cell(measured, scene, kernel),
             *(figure_cell(measured, metric, scene, kernel, with_range=True)
               for metric in metrics)] for kernel in measured.kernels]
    return Table('Times and rates: medians (lowest\u2013highest)', ['kernel', *metrics.values()],
                 rows)


def alone(measured: Measured, scene: str, threads: int) -> Table:
    names = ['build s', 'peak B/tri.', 'final B/tri.', 'h', 'V', 'mixed', 'in flight']
    compared = {name: metric.alone(threads) for metric, name in COMPARED.items()}

    def ratio(metric: Metric, kernel: str) -> Cell:
        spread = measured.by_peer(metric, scene, kernel)
        return NOTHING if spread is None else number(
            spread.median, f'{spread.median:.2f} ({spread.lowest:.2f}\u2013{spread.highest:.2f})')

    def row(kernel: str) -> list[Cell]:
        return [kernel_cell(measured, scene, kernel),
                *(figure_cell(measured, metric.alone(threads), scene, kernel, with_range=True)
                  for metric in ALONE),
                *(ratio(metric, kernel) for metric in compared.values())]
    peers = ', '.join(f'{measured.leader(metric, scene, measured.peers) or "none"} ({name})'
                      for name, metric in compared.items())
    return Table(f'{kernels_alone(threads)}: medians (lowest\u2013highest)',
                 ['kernel', *names, *(f'{name} / peer' for name in compared)],
                 [row(kernel) for kernel in measured.kernels],
                 'h, V, mixed, in flight: million rays per second, replayed. B/tri.: bytes per '
                 'triangle. Ratios are those within a repeat, in which the kernels took turns; the '
                 f'peer is {peers}.')


def memory(measured: Measured, scene: str) -> Table:
    metrics = {PEAK: 'peak MB', FINAL: 'final MB', PEAK_PER_TRIANGLE: 'peak bytes per triangle',
               BYTES_PER_TRIANGLE: 'final bytes per triangle'}

    def row(kernel: str) -> list[Cell]:
        run = measured.first(scene, kernel)
        cells = [figure_cell(measured, metric, scene, kernel) for metric in metrics]
        process = run.report['memory']['process_peak_bytes'] / 1e6 if run else None
        return [kernel_cell(measured, scene, kernel), *cells,
                number(process) if process is not None else NOTHING]
    return Table('Memory of the kernel, and of the whole process',
                 ['kernel', *metrics.values(), 'process peak MB'],
                 [row(kernel) for kernel in measured.kernels])


def intensity(measured: Measured, scene: str) -> Table:
    def row(kernel: str) -> list[Cell]:
        run = measured.first(scene, kernel)
        if run is None:
            return [Cell(kernel), figure_cell(measured, RATE, scene, kernel), *[NOTHING] * 4]
        average = run.report['average_intensity'][0]
        error = run.report['standard_error'][0]
        reference = run.report['reference_average_intensity']
        off = (average - reference[0]) / error if reference and error else None
        return [Cell(kernel), number(average, f'{average:.9f}'),
                number(error, f'{error:.2g}') if error is not None else NOTHING,
                number(reference[0], f'{reference[0]:.9f}') if reference else NOTHING,
                number(off, f'{off:+.2f}') if off is not None else NOTHING,
                number(run.report['squared_error'], f"{run.report['squared_error']:.3g}")]
    return Table('Average intensity (red channel), and its squared error (of all)',
                 ['kernel', 'average', 'standard error (s.e.)', 'reference', 'off by, in s.e.',
                  'squared error'], [row(kernel) for kernel in measured.kernels])


def answers(measured: Measured, scene: str) -> Table:
    def row(kernel: str) -> list[Cell]:
        replay = measured.worst_replay(scene, kernel)
        if replay is None:
            failed = measured.replays(scene, kernel)
            status = failed[0].status if failed else 'not replayed'
            return [Cell(kernel), Cell('', error=status), *[NOTHING] * (len(ANSWERS) + 1)]
        report = replay.report['replay']
        asked = sum(report['rays'].values())
        distance = report['answers']['max_relative_distance_error']
        return [Cell(kernel), number(asked, str(asked)),
                *(number(count := report['answers'][name], str(count),
                         error='' if name == 'tie' or not count else '!') for name in ANSWERS),
                number(distance, f'{distance:.2g}')]
    recorders = {run.report['replay']['recorded_by'] for kernel in measured.kernels
                 if (run := measured.worst_replay(scene, kernel))}
    others = ', '.join(sorted(recorders)) or 'the recorder'
    return Table(f'Answers that differ from those of {others}',
                 ['kernel', 'questions', *(name.replace('_', ' ') for name in ANSWERS),
                  'distance error'], [row(kernel) for kernel in measured.kernels])


def control(measured: Measured) -> Table:
    metrics = [RATE, TOTAL, INITIALIZE, RENDERING]
    rows = []
    for result in measured.results:
        if result.kind == CONTROL and result.repeat == 1:
            ratios = [measured.control_ratio(metric, result.scene, result.kernel)
                      for metric in metrics]
            rows.append([Cell(result.scene), Cell(result.kernel),
                         *(number(ratio, f'{100 * (ratio - 1):+.2f} %') if ratio else NOTHING
                           for ratio in ratios)])
    noises = [measured.noise(metric) for metric in metrics]
    if rows:
        rows.append([Cell('noise'), Cell(''), *(number(noise, f'{100 * noise:.2f} %')
                                                if noise is not None else NOTHING
                                                for noise in noises)])
    return Table('Control: a kernel against itself', ['scene', 'kernel', 'rays per second',
                                                      'total time', 'initialise', 'render'], rows,
                 'The difference of medians of the same kernel, measured twice in each turn. Noise '
                 'is the largest of them, up or down; a smaller difference between kernels is '
                 'shown as none.')


def break_even(measured: Measured) -> Table:
    def cell(scene: str, kernel: str) -> Cell:
        ahead = measured.ahead(scene, kernel, measured.reference)
        if kernel == measured.reference or ahead is None:
            return NOTHING
        begin, end = ahead
        text = ('never' if begin == math.inf else f'up to {si(end)}' if end < math.inf
                else f'from {si(begin)} on' if begin else 'always')
        return number(begin, text, error=wrong_answers(measured, scene, kernel))
    return Table(f'Rays for which a kernel is done before {measured.reference}, building included',
                 ['scene', *measured.kernels],
                 [[Cell(scene), *(cell(scene, kernel) for kernel in measured.kernels)]
                  for scene in measured.scenes])


def scaling(measured: Measured) -> Table:
    def cell(scene: str, kernel: str) -> Cell:
        spread = measured.scaling(RATE_MIXED, scene, kernel)
        return NOTHING if spread is None else number(spread.median, f'{spread.median:.2f}')
    rows = [[Cell(scene), *(cell(scene, kernel) for kernel in measured.kernels)]
            for scene in measured.scenes if len(measured.replay_threads) > 1]
    return Table(f'Kernels alone, scaling: mixed on {measured.threads} threads by one',
                 ['scene', *measured.kernels], rows, 'Medians of the ratios within each repeat.')


def size(count: float) -> str:
    return f'{count / 2**30:.1f} GiB'


def system(measured: Measured) -> Table:
    """Of the newest run."""
    newest = measured.results[-1].bench['machine']
    unknown = 'not readable'
    rows = [('processor', newest['cpu'] + (', in a virtual machine' if newest['virtual'] else '')),
            ('caches', ', '.join(newest['caches']) or unknown),
            ('processors', str(newest['cores'])),
            ('used', ', '.join(map(str, newest['affinity']))),
            ('scaling governor', newest['governor'] or unknown),
            ('boost', newest['boost'] or unknown),
            ('memory', size(newest['memory_bytes'])),
            ('transparent huge pages', newest['transparent_huge_pages'] or unknown),
            ('huge pages reserved', newest['huge_pages'] or unknown),
            ('operating system', newest['os']),
            ('load average, before first and after last run',
             f"{measured.results[0].bench['disturbance']['load_before']:.2f}, "
             f"{measured.results[-1].bench['disturbance']['load_after']:.2f}"),
            ('others\u2019 share of processor time', _largest(measured, 'others')),
            ('share stolen by other virtual machines', _largest(measured, 'stolen'))]
    return Table('System', ['', ''], [[Cell(key), Cell(text)] for key, text in rows])


def _largest(measured: Measured, key: str) -> str:
    shares = [result.bench['disturbance'][key] for result in measured.results
              if result.kind != RECORD]
    return f'at most {percent(max(shares))} in a run' if shares else '\u2013'


def compilers(measured: Measured) -> Table:
    def row(kernel: str) -> list[Cell]:
        run = next((result for result in measured.results
                    if result.kernel == kernel and result.done), None)
        if run is None:
            return [Cell(kernel), *[NOTHING] * 4]
        program = run.report['program']
        return [Cell(kernel), *(Cell(program[key]) for key in ['commit', 'compiler', 'flags'])] + [
            Cell('the same' if program['kernel_flags'] == program['flags']
                 else program['kernel_flags'])]
    return Table('Compilers and flags', ['kernel', 'commit', 'compiler', 'flags of the framework',
                                         'flags of the kernel'],
                 [row(kernel) for kernel in measured.kernels])


def scenes(measured: Measured) -> Table:
    rows = []
    for scene in measured.scenes:
        run = next((run for kernel in measured.kernels if (run := measured.first(scene, kernel))),
                   None)
        if run:
            triangles: Report = run.report
            rows.append([Cell(scene), number(triangles['triangles'], f"{triangles['triangles']:,}"),
                         Cell(run.fingerprint['triangles']), Cell(run.fingerprint['camera'][:16])])
    return Table('Scenes', ['scene', 'triangles', 'SHA-256 of the triangles',
                            'SHA-256 of the camera begins'], rows)


def summary(measured: Measured) -> list[Table]:
    return [speed(measured), kernels(measured),
            *(by_peer(measured, threads) for threads in measured.replay_threads)]


def of_scene(measured: Measured, scene: str) -> list[Table]:
    return [*(alone(measured, scene, threads) for threads in measured.replay_threads),
            *(table(measured, scene) for table in [times, memory, intensity, answers])]


OVERALL_TABLES: list[Callable[[Measured], Table]] = [scaling, break_even, control]
SYSTEM_TABLES: list[Callable[[Measured], Table]] = [system, compilers, scenes]
