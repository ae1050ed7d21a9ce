# SPDX-License-Identifier: GPL-3.0-only
"""What all figures look like."""

from collections.abc import Callable

import matplotlib
from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from metrics import Measured, Spread

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


def row_height(measured: Measured) -> float:
    """In inches, so that the figures of a scene fit a page."""
    return 0.21 if len(measured.kernels) <= 4 else 0.13


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
