# SPDX-License-Identifier: GPL-3.0-only
"""How numbers and kernels are written in tables and figures."""

from metrics import Measured


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


def plain(x: float, _: object = None) -> str:
    return f'{x:g}'


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
