# SPDX-License-Identifier: GPL-3.0-only
"""The figures that kernels are compared by, and their statistics over repeated runs."""

import math
import statistics
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from plan import CONTROL, RECORDER, RENDER, REPLAY
from results import NOT_MADE, Result

Report = dict[str, Any]
REFERENCE = 'funky-kd'  # that others are measured by in means over scenes
WRONG_ANSWERS = ['missed', 'ghost', 'wrong_triangle', 'false_visible', 'false_occluded']
ANSWERS = [*WRONG_ANSWERS, 'tie']


@dataclass(frozen=True)
class Metric:
    """A figure of a run."""

    key: str
    name: str
    unit: str
    better: str  # 'up' or 'down'
    kind: str  # of the runs that it is taken from: plan.RENDER or REPLAY
    value: Callable[[Report], float]
    is_exact: bool = False  # the same in each run, so that each difference is one
    threads: int | None = None  # of these runs; None: as many as the benchmark uses

    def alone(self, threads: int) -> 'Metric':
        """The same figure of the kernel alone: one of ALONE, from replays on so many threads."""
        return replace(self, kind=REPLAY, threads=threads)


def replayed(rate: str) -> Callable[[Report], float]:
    """Of a replay: the median of its measurements, which depend on each other."""
    return lambda report: report['replay'][f'{rate}_per_second'] / 1e6


def megabytes(key: str) -> Callable[[Report], float]:
    return lambda report: report['memory'][key] / 1e6


def per_triangle(key: str) -> Callable[[Report], float]:
    return lambda report: report['memory'][key] / report['triangles']


TOTAL = Metric('total', 'Total running time', 's', 'down', RENDER,
               lambda report: report['time']['total_s'])
INITIALIZE = Metric('initialize', 'Initialisation', 's', 'down', RENDER,
                    lambda report: report['time']['initialize_s'])
RENDERING = Metric('render', 'Rendering', 's', 'down', RENDER,
                   lambda report: report['time']['render_s'])
RATE = Metric('rate', 'Rays, gross', 'Mrays/s', 'up', RENDER,
              lambda report: report['rays']['per_second'] / 1e6)
RATE_H = Metric('h', 'h, replayed', 'Mrays/s', 'up', REPLAY, replayed('intersect'))
RATE_V = Metric('V', 'V, replayed', 'Mrays/s', 'up', REPLAY, replayed('visibility'))
RATE_MIXED = Metric('mixed', 'h and V, replayed', 'Mrays/s', 'up', REPLAY, replayed('mixed'))
RATE_IN_FLIGHT = Metric('in_flight', 'h and V in flight, replayed', 'Mrays/s', 'up', REPLAY,
                        replayed('mixed_in_flight'))
PEAK = Metric('peak', 'Kernel memory, peak', 'MB', 'down', RENDER,
              megabytes('kernel_peak_bytes'), is_exact=True)
FINAL = Metric('final', 'Kernel memory, final', 'MB', 'down', RENDER,
               megabytes('kernel_final_bytes'), is_exact=True)
PEAK_PER_TRIANGLE = Metric('peak_per_triangle', 'Peak memory per triangle', 'bytes', 'down', RENDER,
                           per_triangle('kernel_peak_bytes'), is_exact=True)
BYTES_PER_TRIANGLE = Metric('bytes_per_triangle', 'Final memory per triangle', 'bytes', 'down',
                            RENDER, per_triangle('kernel_final_bytes'), is_exact=True)
SQUARED_ERROR = Metric('squared_error', 'Squared error of the average intensity', '', 'down',
                       RENDER, lambda report: report['squared_error'], is_exact=True)
METRICS = [TOTAL, INITIALIZE, RENDERING, RATE, RATE_H, RATE_V, RATE_MIXED, RATE_IN_FLIGHT, PEAK,
           FINAL, PEAK_PER_TRIANGLE, BYTES_PER_TRIANGLE, SQUARED_ERROR]
# Those in means over scenes.
OVERALL = [TOTAL, INITIALIZE, RATE, RATE_H, RATE_V, RATE_MIXED, RATE_IN_FLIGHT, PEAK, FINAL]
# Those that replays tell.
ALONE = [INITIALIZE, PEAK_PER_TRIANGLE, BYTES_PER_TRIANGLE, RATE_H, RATE_V, RATE_MIXED,
         RATE_IN_FLIGHT]


def metrics_of(kind: str) -> list[Metric]:
    """Those that a run of this kind tells."""
    return ALONE if kind == REPLAY else [metric for metric in METRICS if metric.kind == RENDER]


@dataclass(frozen=True)
class Spread:
    """Of repeated measurements of one figure, or of one figure over several scenes."""

    samples: tuple[float, ...]

    @property
    def median(self) -> float:
        return statistics.median(self.samples)

    @property
    def lowest(self) -> float:
        return min(self.samples)

    @property
    def highest(self) -> float:
        return max(self.samples)

    @property
    def geometric_mean(self) -> float:
        """Within the range, in spite of rounding."""
        return min(max(statistics.geometric_mean(self.samples), self.lowest), self.highest)

    @property
    def relative_range(self) -> float:
        """(highest - lowest) / median, 0 where all are 0."""
        return (self.highest - self.lowest) / self.median if self.median else 0


class Measured:
    """The results of a benchmark, to be asked by scene and kernel.

    Scenes are in the order of their triangles; kernels in that of their names, behind the two that
    others are compared with. So a kernel keeps its colour when it is measured again.
    """

    def __init__(self, results: Iterable[Result], names: set[tuple[str, str]] | None = None,
                 peers: Sequence[str] = ()) -> None:
        """@param names  of scene and kernel: the only ones to be taken
        @param peers  kernels of which the best is the measure of others where any is measured
        """
        self.results = [result for result in results
                        if names is None or (result.scene, result.kernel) in names]
        main = [result for result in self.results if result.bench['scale'] is None]
        triangles = {result.scene: result.report['triangles'] for result in main if result.done}
        self.scenes = sorted({result.scene for result in main},
                             key=lambda scene: (triangles.get(scene, 0), scene))
        self.growth_scene = next((result.scene.partition('@')[0] for result in self.results
                                  if result.bench['scale']), '')
        self.kernels = sorted(
            {result.kernel for result in self.results if result.kind in (RENDER, REPLAY)},
            key=lambda kernel: (kernel != RECORDER, kernel != REFERENCE, kernel))
        self.threads = max((result.fingerprint['threads'] for result in main
                            if 'threads' in result.fingerprint), default=0)
        self.reference = REFERENCE if REFERENCE in self.kernels else next(iter(self.kernels), '')
        self.peers = [kernel for kernel in peers if kernel in self.kernels] or [self.reference]
        self.replay_threads = sorted({result.threads for result in main if result.kind == REPLAY})
        self._runs: dict[tuple[str, str, str, int], list[Result]] = defaultdict(list)
        for result in self.results:
            self._runs[result.scene, result.kernel, result.kind, result.threads].append(result)

    def runs(self, scene: str, kernel: str, kind: str = RENDER,
             threads: int | None = None) -> list[Result]:
        """Of one kernel on one scene, done or not.

        @param threads None: as many as the benchmark uses
        """
        return self._runs.get((scene, kernel, kind, threads or self.threads), [])

    def first(self, scene: str, kernel: str) -> Result | None:
        """The first rendering that is done."""
        return next((result for result in self.runs(scene, kernel) if result.done), None)

    def spread(self, metric: Metric, scene: str, kernel: str) -> Spread | None:
        """None where there is no measurement, as in a run that failed once.

        A kernel that fails in one of its repeats has no figures.
        """
        return spread_of(metric, self.runs(scene, kernel, metric.kind, metric.threads))

    def median(self, metric: Metric, scene: str, kernel: str) -> float:
        """NaN where there is no measurement."""
        spread = self.spread(metric, scene, kernel)
        return spread.median if spread else math.nan

    def by_threads(self, metric: Metric, scene: str, kernel: str) -> dict[int, Spread]:
        """A figure for each number of threads."""
        counts = sorted({result.threads for result in self.results})
        return {n: spread for n in counts
                if (spread := self.spread(replace(metric, threads=n), scene, kernel))}

    def by_triangles(self, metric: Metric, kernel: str) -> list[tuple[float, Spread]]:
        """A figure for each size of the scene that is made for growth curves: triangles, figure."""
        runs: dict[str, list[Result]] = {}
        for result in self.results:
            if result.kernel == kernel and result.bench['scale']:
                runs.setdefault(result.scene, []).append(result)
        return sorted(((of_one[0].report['triangles'], spread) for of_one in runs.values()
                       if (spread := spread_of(metric, of_one))), key=lambda point: point[0])

    def replays(self, scene: str, kernel: str) -> list[Result]:
        """All of them, on one thread and on all, done or not."""
        return [run for threads in self.replay_threads
                for run in self.runs(scene, kernel, REPLAY, threads)]

    def worst_replay(self, scene: str, kernel: str) -> Result | None:
        """The one with most wrong answers; None if none is done."""
        return max((run for run in self.replays(scene, kernel) if run.done),
                   key=lambda run: count_wrong(run.report), default=None)

    def wrong_per_million(self, scene: str, kernel: str) -> float | None:
        """Wrong answers in a million questions of the scene's ray stream; None if not replayed."""
        replay = self.worst_replay(scene, kernel)
        if replay is None:
            return None
        return 1e6 * count_wrong(replay.report) / sum(replay.report['replay']['rays'].values())

    def is_right(self, scene: str, kernel: str) -> bool:
        """Whether nothing is known against its answers, as wrong ones or a replay that failed.

        Nothing is where nobody asked, for want of a ray stream.
        """
        return (all(run.done or run.status == NOT_MADE for run in self.replays(scene, kernel))
                and not self.wrong_per_million(scene, kernel))

    def noise(self, metric: Metric) -> float | None:
        """How far a kernel may differ from itself: the largest |ratio of medians - 1| over scenes.

        The ratio is that of the control to the same kernel, both measured in the same turns. None
        without a control, 0 for what is exact.
        """
        if metric.is_exact:
            return 0
        controls = {(result.scene, result.kernel) for result in self.results
                    if result.kind == CONTROL}
        ratios = [self.control_ratio(metric, scene, kernel) for scene, kernel in controls]
        known = [abs(math.log(ratio)) for ratio in ratios if ratio is not None]
        return math.expm1(max(known)) if known else None

    def control_ratio(self, metric: Metric, scene: str, kernel: str) -> float | None:
        """The control's median by that of the kernel itself."""
        if metric.kind != RENDER:
            return None
        itself = self.spread(metric, scene, kernel)
        control = self.spread(replace(metric, kind=CONTROL), scene, kernel)
        if not itself or not control or not itself.median * control.median > 0:
            return None
        return control.median / itself.median

    def is_equal(self, metric: Metric, scene: str, kernel: str, other: str) -> bool:
        """Whether two kernels cannot be told apart.

        They can if their ranges do not overlap and their medians differ by more than the noise.
        """
        a, b = self.spread(metric, scene, kernel), self.spread(metric, scene, other)
        if not a or not b:
            return False
        return are_equal(a, b, self.noise(metric) or 0)

    def leader(self, metric: Metric, scene: str, kernels: Iterable[str]) -> str | None:
        """The best by the median, None where none has a figure."""
        choose = max if metric.better == 'up' else min
        return choose((kernel for kernel in kernels if self.spread(metric, scene, kernel)),
                      key=lambda kernel: self.median(metric, scene, kernel), default=None)

    def best(self, metric: Metric, scene: str) -> list[str]:
        """The kernels that none is better than, of those that answer rightly."""
        right = [kernel for kernel in self.kernels if self.is_right(scene, kernel)]
        leader = self.leader(metric, scene, right)
        return [kernel for kernel in right
                if leader and self.is_equal(metric, scene, kernel, leader)]

    def ratio(self, metric: Metric, scene: str, kernel: str, other: str) -> Spread | None:
        """A kernel's figures by those of another in the same repeats, in which they took turns.

        None where one of them has none or answers wrongly.
        """
        return self._paired(metric, scene, kernel, other) if self.is_right(scene, other) else None

    def _paired(self, metric: Metric, scene: str, kernel: str, other: str) -> Spread | None:
        if not self.is_right(scene, kernel):
            return None
        return paired(metric, *(self.runs(scene, name, metric.kind, metric.threads)
                                for name in (kernel, other)))

    def by_peer(self, metric: Metric, scene: str, kernel: str) -> Spread | None:
        """Its ratio to the best of the peers on the scene, even where that one answers wrongly."""
        peer = self.leader(metric, scene, self.peers)
        return self._paired(metric, scene, kernel, peer) if peer else None

    def scaling(self, metric: Metric, scene: str, kernel: str) -> Spread | None:
        """Figures on as many threads as the benchmark uses by those on one, in the same repeats."""
        return paired(metric, self.runs(scene, kernel, metric.kind),
                      self.runs(scene, kernel, metric.kind, 1))

    def relative(self, metric: Metric, kernel: str) -> Spread | None:
        """A kernel's figures by those of the reference, one for each scene.

        Of the scenes where both have one and answer rightly. None where there is none.
        """
        ratios = tuple(spread.median for scene in self.scenes
                       if (spread := self.ratio(metric, scene, kernel, self.reference)))
        return Spread(ratios) if ratios else None

    def ahead(self, scene: str, kernel: str, other: str) -> tuple[float, float] | None:
        """For how many rays, from and to, a kernel is done before another, building included.

        Its time for n rays is initialize + n / rate. (0, inf): always; (inf, inf): never. None
        where one of them has no figures or answers wrongly.
        """
        build, rate = (self.median(metric, scene, kernel) for metric in (INITIALIZE, RATE))
        other_build, other_rate = (self.median(metric, scene, other)
                                   for metric in (INITIALIZE, RATE))
        if not all(map(math.isfinite, [build, rate, other_build, other_rate])):
            return None
        if not self.is_right(scene, kernel) or not self.is_right(scene, other):
            return None
        if build <= other_build and rate >= other_rate:
            return 0, math.inf
        if build >= other_build and rate <= other_rate:
            return math.inf, math.inf
        crossing = 1e6 * (build - other_build) / (1 / other_rate - 1 / rate)
        return (crossing, math.inf) if rate > other_rate else (0, crossing)


def spread_of(metric: Metric, runs: list[Result]) -> Spread | None:
    """None where there is no run, or one that failed."""
    if not runs or not all(result.done for result in runs):
        return None
    return Spread(tuple(metric.value(result.report) for result in runs))


def paired(metric: Metric, runs: list[Result], others: list[Result]) -> Spread | None:
    """The ratio of a figure to that of another run in the same repeat, one for each repeat.

    None where a run failed, or where no repeat has two figures above 0.
    """
    if not spread_of(metric, runs) or not spread_of(metric, others):
        return None
    by_repeat = {other.repeat: metric.value(other.report) for other in others}
    pairs = [(metric.value(run.report), by_repeat.get(run.repeat, 0)) for run in runs]
    ratios = tuple(a / b for a, b in pairs if a > 0 and b > 0)
    return Spread(ratios) if ratios else None


def count_wrong(report: Report) -> int:
    """Of a replay: those asked alone or in flight, whichever are more."""
    return max(sum(report['replay'][answers][name] for name in WRONG_ANSWERS)
               for answers in ['answers', 'answers_in_flight'])


def are_equal(a: Spread, b: Spread, noise: float) -> bool:
    """Whether ranges overlap, or medians differ by no more than the noise, relatively."""
    overlap = a.lowest <= b.highest and b.lowest <= a.highest
    if overlap or a.median == b.median:
        return True
    larger, smaller = max(a.median, b.median), min(a.median, b.median)
    return smaller > 0 and larger / smaller - 1 <= noise
