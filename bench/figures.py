# SPDX-License-Identifier: GPL-3.0-only
"""Draws the graphs of the report."""

from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

from matplotlib.figure import Figure

from metrics import Measured
from overallfigures import OVERALL_FIGURES
from process import end_with_parent
from scenefigures import SCENE_FIGURES


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
