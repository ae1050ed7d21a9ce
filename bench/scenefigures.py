# SPDX-License-Identifier: GPL-3.0-only
"""The graphs of a scene, one function each, which gives None where nothing was measured."""

from collections.abc import Callable, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, MaxNLocator

from metrics import (FINAL, INITIALIZE, PEAK, RATE, RATE_H, RATE_IN_FLIGHT, RATE_MIXED, RATE_V,
                     SQUARED_ERROR, TOTAL, Measured, Metric, Spread)
from style import (BLANK, COLOURS, DARK, ERROR_BARS, HATCHES, MARKERS, WIDTH, label_powers,
                   range_of, row_height)
from texts import short, with_errors

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
