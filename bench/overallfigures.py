# SPDX-License-Identifier: GPL-3.0-only
"""The graphs over all scenes, one function each, which gives None where nothing was measured."""

import math
from collections.abc import Callable
from functools import partial

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, MaxNLocator

from metrics import BYTES_PER_TRIANGLE, FINAL, INITIALIZE, OVERALL, RATE, Measured, Spread
from style import (BLANK, COLOURS, ERROR_BARS, HATCHES, LINES, MARKERS, WIDTH, label_powers,
                   range_of, row_height)
from texts import named, plain, short, si


def geometric_means(measured: Measured) -> Figure | None:
    """Geometric means over the scenes, by the reference kernel."""
    shown = [metric for metric in OVERALL
             if any(measured.relative(metric, kernel) for kernel in measured.kernels)]
    if not shown or len(measured.kernels) < 2:
        return None
    rows = math.ceil(len(shown) / 2)
    figure = Figure(figsize=(2 * WIDTH, 0.5 + (0.4 + row_height(measured) *
                                               len(measured.kernels)) * rows))
    all_axes = list(figure.subplots(rows, 2, squeeze=False).flat)
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
    for axes in all_axes[len(shown):]:
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
