# SPDX-License-Identifier: GPL-3.0-only
"""Two sets of results side by side."""

from doubts import percent
from metrics import METRICS, RATE, Measured, Metric, are_equal
from texts import short

EXTENT = ['size', 'passes', 'threads', 'replay_rays', 'replay_seconds', 'cpu', 'affinity']


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
                ratio = f'{here.median / there.median:.3f}' if there.median else '-'
                lines.append((scene, kernel, f'{metric.name} {metric.unit}'.strip(),
                              short(here.median), short(there.median), ratio,
                              verdict(measured, other, metric, scene, kernel)))
    if len(lines) == 1:
        return 'the two sets have no kernel and scene in common'
    widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]))]
    table = ['  '.join(text.ljust(width) for text, width in zip(line, widths)).rstrip()
             for line in lines]
    noises = [percent(share) if (share := one.noise(RATE)) is not None else 'unknown'
              for one in (measured, other)]
    return '\n'.join([*table, *differences(measured, other),
                      f'noise of rays per second: {noises[0]} here, {noises[1]} there'])


def verdict(measured: Measured, other: Measured, metric: Metric, scene: str, kernel: str) -> str:
    """On a kernel that has the figure in both sets."""
    wrong = [where for one, where in [(measured, 'here'), (other, 'there')]
             if not one.is_right(scene, kernel)]
    if wrong:
        return f"wrong answers {' and '.join(wrong)}"
    here, there = measured.spread(metric, scene, kernel), other.spread(metric, scene, kernel)
    assert here and there
    if are_equal(here, there, max(measured.noise(metric) or 0, other.noise(metric) or 0)):
        return 'equal'
    return 'better' if (here.median > there.median) == (metric.better == 'up') else 'worse'


def differences(measured: Measured, other: Measured) -> list[str]:
    """A sentence where the two sets were not measured alike."""
    def values(one: Measured, key: str) -> set[str]:
        return {str(result.fingerprint[key]) for result in one.results if key in result.fingerprint}
    keys = [key for key in EXTENT if values(measured, key) != values(other, key)]
    return [f"the two sets differ in {', '.join(keys)}".replace('_', ' ')] if keys else []
