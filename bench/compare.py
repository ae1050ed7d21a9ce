# SPDX-License-Identifier: GPL-3.0-only
"""Two sets of results side by side."""

from doubts import percent
from figures import short
from metrics import METRICS, RATE, Measured, are_equal


def compare(measured: Measured, other: Measured) -> str:
    """A table: medians of both, their ratio, and whether it exceeds the noise of either."""
    lines = [('scene', 'kernel', 'figure', 'here', 'there', 'here / there', '')]
    for scene in measured.scenes:
        for kernel in measured.kernels:
            for metric in METRICS:
                here = measured.spread(metric, scene, kernel)
                there = other.spread(metric, scene, kernel)
                if not here or not there:
                    continue
                noise = max(measured.noise(metric) or 0, other.noise(metric) or 0)
                ratio = f'{here.median / there.median:.3f}' if there.median else '-'
                better = (here.median > there.median) == (metric.better == 'up')
                verdict = ('equal' if are_equal(here, there, noise)
                           else 'better' if better else 'worse')
                lines.append((scene, kernel, f'{metric.name} {metric.unit}'.strip(),
                              short(here.median), short(there.median), ratio, verdict))
    if len(lines) == 1:
        return 'the two sets have no kernel and scene in common'
    widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]))]
    table = ['  '.join(text.ljust(width) for text, width in zip(line, widths)).rstrip()
             for line in lines]
    noises = [percent(share) if (share := one.noise(RATE)) is not None else 'unknown'
              for one in (measured, other)]
    return '\n'.join([*table, f'noise of rays per second: {noises[0]} here, {noises[1]} there'])
