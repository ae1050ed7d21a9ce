# SPDX-License-Identifier: GPL-3.0-only
"""The graphs of the report, one function each, which gives None where nothing was measured."""

import math
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import matplotlib
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

from metrics import (BYTES_PER_TRIANGLE, FINAL, INITIALIZE, OVERALL, PEAK, RATE, RATE_H,
                     RATE_IN_FLIGHT, RATE_MIXED, RATE_V, SQUARED_ERROR, TOTAL, Measured, Metric,
                     Spread)
from process import end_with_parent

matplotlib.use('Agg')
matplotlib.rcParams.update({
    'font.family': 'serif', 'font.serif': ['STIXGeneral'], 'mathtext.fontset': 'stix',
    'font.size': 9, 'axes.titlesize': 9, 'axes.labelsize': 9, 'legend.fontsize': 8,
    'xtick.labelsize': 8, 'ytick.labelsize': 8, 'text.parse_math': False,
    'ps.fonttype': 42, 'svg.hashsalt': 'bwfirt', 'svg.fonttype': 'path',
    'axes.spines.top': False, 'axes.spines.right': False, 'legend.frameon': False,
    'hatch.linewidth': 0.5, 'figure.constrained_layout.use': True,
})
WIDTH = 3.35  # inches, half the width of the text

# Okabe and Ito's colours, which colour-blind people tell apart, but for a darker yellow, and four
# more; in an order in which neighbours differ in grey, too. Markers, lines and hatches tell apart
# the rest. Hatches are of lines alone: dots and circles would make most of the bytes of an SVG.
COLOURS = ['#0072B2', '#E69F00', '#009E73', '#DDCC33', '#D55E00', '#56B4E9', '#CC79A7', '#777777',
           '#332288', '#999933', '#882255', '#BBBBBB']
HATCHES = ['', '////', '||||', 'xxxx', '\\\\\\\\', '++++', '//', '----', '||', 'xx',
           '\\\\', '++']
MARKERS = 'osD^vP*X<>pd'
LINES = ['-', '--', '-.', ':', (0, (5, 1)), (0, (3, 1, 1, 1)), (0, (1, 1)), (0, (7, 3)),
         (0, (9, 2, 2, 2)), (0, (2, 4)), (0, (5, 1, 1, 1, 1, 1)), (0, (9, 1))]
DARK = '#333333'
BLANK = {'facecolor': 'white', 'edgecolor': 'none', 'pad': 1}  # behind a text across lines
ERROR_BARS = {'ecolor': 'black', 'error_kw': {'elinewidth': 0.8, 'capsize': 2, 'capthick': 0.8}}


def short(x: float) -> str:
    """Three significant digits, without an exponent where that is short."""
    if x == 0:
        return '0'
    if not 1e-3 <= abs(x) < 1e6:
        return f'{x:.2g}'
    return f'{x:.3g}' if abs(x) < 1000 else f'{x:.0f}'


def si(x: float, _: object = None) -> str:
    """1000 as 1k and so on."""
    for factor, letter in [(1e12, 'T'), (1e9, 'G'), (1e6, 'M'), (1e3, 'k')]:
        if abs(x) >= factor:
            return f'{x / factor:.3g}{letter}'
    return f'{x:.3g}'


def row_height(measured: Measured) -> float:
    """In inches, so that the figures of a scene fit a page."""
    return 0.21 if len(measured.kernels) <= 4 else 0.13


def ppm_wrong(wrong: float) -> str:
    """Of wrong answers in a million."""
    return f'{si(wrong)} ppm wrong'


def with_errors(measured: Measured, scene: str, kernel: str, text: str) -> str:
    """A figure with the kernel's wrong answers, where there are any."""
    wrong = measured.wrong_per_million(scene, kernel)
    return f'{text}, {ppm_wrong(wrong)}' if wrong else text


def named(measured: Measured, kernel: str) -> str:
    """A kernel with its wrong answers on the worst scene, where there are any."""
    wrong = max((measured.wrong_per_million(scene, kernel) or 0 for scene in measured.scenes),
                default=0)
    return f'{kernel}, {ppm_wrong(wrong)}' if wrong else kernel


def range_of(spread: Spread, middle: float) -> list[list[float]]:
    """From the middle down to the lowest and up to the highest, as matplotlib takes it."""
    return [[middle - spread.lowest], [spread.highest - middle]]


def label_powers(axis: Axis, text: Callable[[float, object], str], by_125: bool = False) -> None:
    """Labels of a logarithmic axis, without those between them.

    @param by_125 at 1, 2, 5, 10, ..., for axes that span few powers of ten
    """
    if by_125:
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(text))
    axis.set_minor_formatter(NullFormatter())


def plain(x: float, _: object = None) -> str:
    return f'{x:g}'


# ---- Of one scene -------------------------------------------------------------------------------


Text = Callable[[str, Spread], str]  # of a kernel and its figure


def _bars(axes: Axes, measured: Measured, scene: str, metric: Metric, below: Metric | None,
          text: Text) -> None:
    """A bar for each kernel, with its range, its value and the kernel's name.

    @param below a metric that is a part of the other one, and is drawn dark
    """
    bars = [(kernel, spread) for kernel in measured.kernels
            if (spread := measured.spread(metric, scene, kernel))]
    for place, (kernel, spread) in enumerate(bars):
        index = measured.kernels.index(kernel) % len(COLOURS)
        axes.barh(place, spread.median, height=0.7, color=COLOURS[index], hatch=HATCHES[index],
                  edgecolor='black', linewidth=0.5, xerr=range_of(spread, spread.median),
                  **ERROR_BARS)
        if below:
            axes.barh(place, measured.median(below, scene, kernel), height=0.7, color=DARK)
        axes.annotate(text(kernel, spread), (spread.highest, place), xytext=(4, 0),
                      textcoords='offset points', va='center', fontsize=8)
    axes.set_yticks(range(len(bars)), [kernel for kernel, _ in bars])
    axes.set_ylim(len(bars) - 0.4, -0.6)
    axes.xaxis.set_major_locator(MaxNLocator(4))


def _bar_chart(measured: Measured, scene: str, metrics: Sequence[Metric], title: str, unit: str,
               below: Metric | None = None,
               text: Text = lambda _, spread: short(spread.median)) -> Figure | None:
    spreads = {metric: [(kernel, spread) for kernel in measured.kernels
                        if (spread := measured.spread(metric, scene, kernel))]
               for metric in metrics}
    shown = [metric for metric in metrics if spreads[metric]]
    if not shown:
        return None

    def written(kernel: str, spread: Spread) -> str:
        return with_errors(measured, scene, kernel, text(kernel, spread))
    bars = [bar for metric in shown for bar in spreads[metric]]
    figure = Figure(figsize=(WIDTH, 0.62 + 0.2 * len(shown) + row_height(measured) * len(bars)))
    all_axes = figure.subplots(len(shown), sharex=True, squeeze=False)[:, 0]
    for axes, metric in zip(all_axes, shown):
        _bars(axes, measured, scene, metric, below, written)
        if len(metrics) > 1:
            axes.set_title(metric.name, loc='left', fontsize=8, style='italic', pad=2)
    highest = max(spread.highest for _, spread in bars)
    room = 1 + 0.042 * max(len(written(kernel, spread)) for kernel, spread in bars)
    axes.set_xlim(0, room * highest or 1)
    axes.set_xlabel(unit)
    figure.suptitle(title, fontsize=9, fontweight='bold')
    return figure


def total_time(measured: Measured, scene: str) -> Figure | None:
    return _bar_chart(measured, scene, [TOTAL], 'Total running time',
                      'seconds (dark: of these, initialisation)', below=INITIALIZE)


def initialisation(measured: Measured, scene: str) -> Figure | None:
    return _bar_chart(measured, scene, [INITIALIZE], 'Initialisation', 'seconds')


def ray_rates(measured: Measured, scene: str) -> Figure | None:
    rates = [RATE, RATE_H, RATE_V, RATE_MIXED, RATE_IN_FLIGHT]
    return _bar_chart(measured, scene, rates, 'Rays per second',
                      'million per second')


def memory(measured: Measured, scene: str) -> Figure | None:
    def text(kernel: str, spread: Spread) -> str:
        report = measured.first(scene, kernel)
        assert report
        per_triangle = 1e6 * spread.median / report.report['triangles']
        return f'{short(spread.median)} ({short(per_triangle)} B/tri.)'
    return _bar_chart(measured, scene, [PEAK, FINAL], 'Memory of the kernel',
                      'MB (and bytes per triangle)', text=text)


def numerical_comparison(measured: Measured, scene: str) -> Figure | None:
    """Beside the squared error that the finite number of passes alone makes likely."""
    kernels = [k for k in measured.kernels if measured.first(scene, k)]
    if not kernels:
        return None
    runs = [run for k in kernels if (run := measured.first(scene, k))]
    figure = Figure(figsize=(WIDTH, 0.85 + row_height(measured) * len(kernels)))
    axes = figure.subplots()
    values = [SQUARED_ERROR.value(run.report) for run in runs]
    variances = [sum(x * x for x in run.report['standard_error'] if x is not None) for run in runs]
    lowest = min([x for x in [*values, *variances] if x > 0], default=1e-12)
    highest = max([x for x in [*values, *variances] if x > 0], default=1)
    for place, (kernel, value) in enumerate(zip(kernels, values)):
        index = measured.kernels.index(kernel) % len(COLOURS)
        axes.plot(max(value, lowest / 3), place, MARKERS[index], color=COLOURS[index],
                  markeredgecolor='black', markeredgewidth=0.5)
        axes.annotate(with_errors(measured, scene, kernel, f'{value:.3g}'),
                      (max(value, lowest / 3), place), xytext=(7, 0),
                      textcoords='offset points', va='center', fontsize=8,
                      bbox=BLANK)
    if variances[0] > 0 and runs[0].report['reference_average_intensity']:
        axes.axvline(variances[0], color='black', linestyle='--', linewidth=0.8)
    axes.set_xscale('log')
    axes.set_xlim(lowest / 10, highest * 300)
    axes.xaxis.set_major_locator(LogLocator(numticks=6))
    label_powers(axes.xaxis, lambda value, _: f'{value:.0e}')
    axes.set_yticks(range(len(kernels)), kernels)
    axes.set_ylim(len(kernels) - 0.4, -0.6)
    axes.grid(axis='x', linewidth=0.3)
    if runs[0].report['reference_average_intensity']:
        axes.set_xlabel('squared error (dashed: its variance)')
    else:
        axes.set_xlabel('squared average, for want of a reference')
    figure.suptitle('Numerical comparison', fontsize=9, fontweight='bold')
    return figure


SCENE_FIGURES: dict[str, Callable[[Measured, str], Figure | None]] = {
    'total-time': total_time, 'initialisation': initialisation, 'ray-rates': ray_rates,
    'memory': memory, 'numerical-comparison': numerical_comparison}

# ---- Over all scenes ----------------------------------------------------------------------------


def geometric_means(measured: Measured) -> Figure | None:
    """Geometric means over the scenes, by the reference kernel."""
    shown = [metric for metric in OVERALL
             if any(measured.relative(metric, kernel) for kernel in measured.kernels)]
    if not shown or len(measured.kernels) < 2:
        return None
    rows = math.ceil(len(shown) / 2)
    figure = Figure(figsize=(2 * WIDTH, 0.5 + (0.4 + row_height(measured) *
                                               len(measured.kernels)) * rows))
    all_axes = figure.subplots(rows, 2, squeeze=False).flat
    for axes, metric in zip(all_axes, shown):
        ratios = [(kernel, spread) for kernel in measured.kernels
                  if (spread := measured.relative(metric, kernel))]
        for place, (kernel, spread) in enumerate(ratios):
            index = measured.kernels.index(kernel) % len(COLOURS)
            mean = spread.geometric_mean
            axes.barh(place, mean, height=0.7, color=COLOURS[index], hatch=HATCHES[index],
                      edgecolor='black', linewidth=0.5,
                      xerr=range_of(spread, mean), **ERROR_BARS)
            axes.annotate(short(mean), (spread.highest, place), xytext=(4, 0),
                          textcoords='offset points', va='center', fontsize=8, bbox=BLANK)
        axes.axvline(1, color='black', linewidth=0.8, linestyle='--')
        axes.set_yticks(range(len(ratios)), [named(measured, kernel) for kernel, _ in ratios])
        axes.set_ylim(len(ratios) - 0.4, -0.6)
        axes.set_xlim(0, 1.2 * max(1, *(spread.highest for _, spread in ratios)))
        better = {'up': 'more is better', 'down': 'less is better'}[metric.better]
        axes.set_title(f'{metric.name} ({better})', loc='left', fontsize=8, style='italic', pad=2)
    for axes in list(all_axes)[len(shown):]:
        axes.set_axis_off()
    figure.suptitle(f'Geometric means over all scenes, relative to {measured.reference}, with the '
                    'scenes of the least and the greatest ratio', fontsize=9, fontweight='bold')
    return figure


def _curves(axes: Axes, measured: Measured,
            curve: Callable[[str], list[tuple[float, Spread]]]) -> bool:
    """A line a kernel through its medians, with ranges. Returns whether there is one."""
    drawn = False
    for number, kernel in enumerate(measured.kernels):
        points = curve(kernel)
        if not points:
            continue
        index = number % len(COLOURS)
        spreads = [spread for _, spread in points]
        ranges = [[s.median - s.lowest for s in spreads], [s.highest - s.median for s in spreads]]
        axes.errorbar([x for x, _ in points], [s.median for s in spreads], yerr=ranges,
                      color=COLOURS[index], marker=MARKERS[index], linestyle=LINES[index],
                      markeredgecolor='black', markeredgewidth=0.5, markersize=5, linewidth=1.2,
                      ecolor='black', elinewidth=0.8, capsize=2, label=named(measured, kernel))
        drawn = True
    axes.grid(linewidth=0.3)
    return drawn


def _legend(figure: Figure) -> None:
    """Below the figure, whose bounding box has to grow by it."""
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc='upper center', bbox_to_anchor=(0.5, 0),
                  ncol=4 if figure.get_figwidth() > WIDTH else 2)


def speed_against_memory(measured: Measured) -> Figure | None:
    """Geometric means over the scenes, relative to the reference, and the range over the scenes."""
    figure = Figure(figsize=(WIDTH, 2.6))
    axes = figure.subplots()
    points = [(kernel, memory, speed) for kernel in measured.kernels
              if (memory := measured.relative(FINAL, kernel))
              and (speed := measured.relative(RATE, kernel))]
    if len(points) < 2:
        return None
    for kernel, memory, speed in points:
        index = measured.kernels.index(kernel) % len(COLOURS)
        x, y = memory.geometric_mean, speed.geometric_mean
        axes.errorbar(x, y, xerr=range_of(memory, x), yerr=range_of(speed, y), color=COLOURS[index],
                      marker=MARKERS[index], markeredgecolor='black', markeredgewidth=0.5,
                      markersize=7, linestyle='', ecolor='black', elinewidth=0.6, capsize=2,
                      label=named(measured, kernel))
    for set_scale, axis in [(axes.set_xscale, axes.xaxis), (axes.set_yscale, axes.yaxis)]:
        set_scale('log')
        label_powers(axis, plain, by_125=True)
    axes.margins(0.15)
    axes.grid(linewidth=0.3)
    axes.set_xlabel(f'final memory, {measured.reference} = 1')
    axes.set_ylabel(f'rays per second, {measured.reference} = 1')
    _legend(figure)
    figure.suptitle('Speed against memory', fontsize=9, fontweight='bold')
    return figure


def thread_scaling(measured: Measured) -> Figure | None:
    """Rays per second with more threads, by those of one."""
    scenes = [scene for scene in measured.scenes if any(
        measured.by_threads(RATE, scene, kernel).keys() - {measured.threads}
        for kernel in measured.kernels)]
    if not scenes:
        return None
    figure = Figure(figsize=(WIDTH, 2.2 * len(scenes) + 0.4))
    all_axes = figure.subplots(len(scenes), squeeze=False)[:, 0]
    for axes, scene in zip(all_axes, scenes):
        def curve(kernel: str, scene: str = scene) -> list[tuple[float, Spread]]:
            rates = measured.by_threads(RATE, scene, kernel)
            if 1 not in rates:
                return []
            one = rates[1].median
            return [(n, Spread(tuple(x / one for x in spread.samples)))
                    for n, spread in sorted(rates.items())]
        _curves(axes, measured, curve)
        most = measured.threads
        axes.plot([1, most], [1, most], color='black', linewidth=0.6)
        axes.annotate('ideal', (most, most), xytext=(-4, 0), textcoords='offset points',
                      ha='right', fontsize=8)
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.set_ylim(bottom=0)
        axes.set_title(scene, loc='left', fontsize=8, style='italic', pad=2)
        axes.set_ylabel('speed-up of rays per second')
    axes.set_xlabel('threads')
    _legend(figure)
    figure.suptitle('Thread scaling', fontsize=9, fontweight='bold')
    return figure


def growth(measured: Measured) -> Figure | None:
    """What becomes of a kernel as a scene grows."""
    metrics = [RATE, INITIALIZE, BYTES_PER_TRIANGLE]
    figure = Figure(figsize=(2 * WIDTH, 2.5))
    drawn = False
    for axes, metric in zip(figure.subplots(1, len(metrics)), metrics):
        drawn |= _curves(axes, measured, partial(measured.by_triangles, metric))
        axes.set_xscale('log')
        axes.set_yscale('log')
        label_powers(axes.xaxis, si)
        label_powers(axes.yaxis, plain, by_125=metric is not INITIALIZE)
        axes.set_xlabel('triangles')
        axes.set_title(f'{metric.name}, {metric.unit}', fontsize=8, style='italic')
    if not drawn:
        return None
    _legend(figure)
    figure.suptitle(f'Growth with the size of a scene ({measured.growth_scene})', fontsize=9,
                    fontweight='bold')
    return figure


def break_even(measured: Measured) -> Figure | None:
    """Time that kernels take for n rays, building included, by that of the fastest one for n."""
    scenes = [scene for scene in measured.scenes
              if sum(measured.first(scene, kernel) is not None for kernel in measured.kernels) > 1]
    if not scenes:
        return None
    columns = min(3 if len(scenes) <= 9 else 4, len(scenes))
    rows = math.ceil(len(scenes) / columns)
    figure = Figure(figsize=(2 * WIDTH, 0.6 + 1.45 * rows))
    all_axes = list(figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).flat)
    counts = [10**(3 + 0.1 * step) for step in range(71)]
    for axes, scene in zip(all_axes, scenes):
        def seconds(kernel: str, n: float, scene: str = scene) -> float:
            return (measured.median(INITIALIZE, scene, kernel) +
                    n / 1e6 / measured.median(RATE, scene, kernel))
        known = [kernel for kernel in measured.kernels if measured.first(scene, kernel)
                 and math.isfinite(seconds(kernel, 1))]
        fastest = [min(seconds(kernel, n) for kernel in known) for n in counts]
        for kernel in known:
            index = measured.kernels.index(kernel) % len(COLOURS)
            axes.plot(counts, [seconds(kernel, n) / best for n, best in zip(counts, fastest)],
                      color=COLOURS[index], linestyle=LINES[index], linewidth=1.4,
                      label=named(measured, kernel))
        axes.set_xscale('log')
        axes.set_yscale('log')
        axes.set_title(scene, loc='left', fontsize=8, style='italic', pad=2)
        axes.grid(linewidth=0.3)
        axes.xaxis.set_major_locator(LogLocator(numticks=5))
        label_powers(axes.xaxis, si)
        label_powers(axes.yaxis, plain, by_125=True)
    for axes in all_axes[len(scenes):]:
        axes.set_axis_off()
    _legend(figure)
    figure.supxlabel('rays traced', fontsize=9)
    figure.supylabel('time, fastest = 1', fontsize=9)
    figure.suptitle('Break-even between building and tracing', fontsize=9, fontweight='bold')
    return figure


OVERALL_FIGURES: dict[str, Callable[[Measured], Figure | None]] = {
    'relative': geometric_means, 'speed-against-memory': speed_against_memory,
    'thread-scaling': thread_scaling, 'growth': growth, 'break-even': break_even}


def _draw(name: str, draw: Callable[[], Figure | None], folder: Path) -> str | None:
    figure = draw()
    if figure is None:
        return None
    figure.draw_without_rendering()
    figure.set_layout_engine('none')  # it is laid out once, for both files
    box = figure.get_tightbbox().padded(0.02)
    figure.savefig(folder / f'{name}.eps', bbox_inches=box)
    figure.savefig(folder / f'{name}.svg', bbox_inches=box,
                   metadata={'Date': None, 'Creator': None})
    return name


def draw_all(measured: Measured, folder: Path) -> list[str]:
    """Writes NAME.eps and NAME.svg of all figures, and gives the names.

    Those of the scene number N begin with N.
    """
    of_scenes = {f'{number}-{name}': partial(draw, measured, scene)
                 for number, scene in enumerate(measured.scenes)
                 for name, draw in SCENE_FIGURES.items()}
    overall = {name: partial(draw, measured) for name, draw in OVERALL_FIGURES.items()}
    with ProcessPoolExecutor(initializer=end_with_parent) as pool:
        drawn = [pool.submit(_draw, name, draw, folder)
                 for name, draw in (of_scenes | overall).items()]
        try:
            return [name for figure in drawn if (name := figure.result())]
        except BaseException:  # a signal among others
            pool.shutdown(cancel_futures=True)
            raise
