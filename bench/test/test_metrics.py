# SPDX-License-Identifier: GPL-3.0-only
"""Statistics, by values that are computed by hand."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from metrics import (BYTES_PER_TRIANGLE, FINAL, INITIALIZE, METRICS, PEAK, PEAK_PER_TRIANGLE, RATE,
                     RATE_H, RATE_MIXED, RATE_V, SQUARED_ERROR, TOTAL, Measured, Spread, are_equal)
from plan import CONTROL, RECORD, REPLAY
from stored import Stored


def measured_rates(folder: Path, rates: Mapping[str, Mapping[str, Sequence[float]]],
                   control: Mapping[str, Sequence[float]] = {}) -> Measured:
    """@param rates   by scene and kernel, one of each repeat
    @param control  of funky-kd, by scene
    """
    stored = Stored(folder)
    for scene, by_kernel in rates.items():
        for kernel, samples in by_kernel.items():
            for repeat, rate in enumerate(samples, start=1):
                stored.run(scene, kernel, repeat=repeat, rate=rate, exposure=None)
    for scene, samples in control.items():
        for repeat, rate in enumerate(samples, start=1):
            stored.run(scene, 'funky-kd', CONTROL, repeat=repeat, rate=rate)
    return stored.measured()


# ---- Of one kernel ------------------------------------------------------------------------------


@pytest.mark.parametrize('samples, median, lowest, highest, width', [
    ((4,), 4, 4, 4, 0), ((1, 4), 2.5, 1, 4, 1.2), ((5, 1, 2), 2, 1, 5, 2),
    ((1, 2, 3, 10), 2.5, 1, 10, 3.6), ((0, 0, 0), 0, 0, 0, 0)])
def test_median_and_range(samples: tuple[float, ...], median: float, lowest: float, highest: float,
                          width: float) -> None:
    spread = Spread(samples)
    assert (spread.median, spread.lowest, spread.highest) == (median, lowest, highest)
    assert spread.relative_range == pytest.approx(width)


def test_metrics_take_their_figures_from_the_reports(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    report = {'time.initialize_s': 2.0, 'time.render_s': 8.0, 'time.total_s': 10.0,
              'rays.per_second': 12.5e6, 'memory.kernel_peak_bytes': 3_000_000,
              'memory.kernel_final_bytes': 500_000, 'triangles': 2000, 'squared_error': 0.25}
    rates = {'replay.intersect_per_second': 2e6, 'replay.visibility_per_second': 4e6,
             'replay.mixed_per_second': 2.5e6, 'replay.mixed_in_flight_per_second': 7e6}
    stored.run('box', 'a', report=report)
    stored.run('box', 'a', REPLAY, report=rates)
    measured = stored.measured()
    values = {metric.key: measured.median(metric, 'box', 'a') for metric in METRICS}
    assert values == {'total': 10, 'initialize': 2, 'render': 8, 'rate': 12.5, 'h': 2, 'V': 4,
                      'mixed': 2.5, 'in_flight': 7, 'peak': 3, 'final': 0.5,
                      'peak_per_triangle': 1500, 'bytes_per_triangle': 250, 'squared_error': 0.25}


def test_each_repeat_is_a_sample_and_no_other_run_is(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    for repeat, rate in [(1, 10), (2, 30), (3, 11)]:
        stored.run('box', 'a', repeat=repeat, rate=rate)
        stored.run('box', 'a', CONTROL, repeat=repeat, rate=99)
        stored.run('box', 'a', repeat=repeat, rate=99, threads=1)
        stored.run('box', 'b', repeat=repeat, rate=99)
        stored.run('hall', 'a', repeat=repeat, rate=99)
    stored.run('box', 'a', RECORD, rate=99, threads=1)
    spread = stored.measured().spread(RATE, 'box', 'a')
    assert spread and spread.samples == (10, 30, 11)


@pytest.mark.parametrize('failed', [1, 2, 3])
def test_one_failed_repeat_takes_all_figures(tmp_path: Path, failed: int) -> None:
    stored = Stored(tmp_path)
    for repeat in (1, 2, 3):
        stored.run('box', 'a', repeat=repeat, status='crashed' if repeat == failed else 'done')
    measured = stored.measured()
    assert measured.spread(RATE, 'box', 'a') is None
    assert math.isnan(measured.median(RATE, 'box', 'a'))


# ---- Noise, and who is best ---------------------------------------------------------------------


@pytest.mark.parametrize('a, b, noise, equal', [
    ((1, 2, 3), (2.9, 4, 5), 0, True), ((1, 2, 3), (3.1, 4, 5), 0, False),
    ((1, 2, 3), (3, 4, 5), 0, True), ((10, 10), (11, 11), 0.11, True),
    ((10, 10), (11, 11), 0.09, False), ((11, 11), (10, 10), 0.11, True), ((0, 0), (1, 1), 9, False),
    ((0, 0), (0, 0), 0, True), ((1, 9), (2, 3), 0, True)])
def test_kernels_are_equal_where_ranges_overlap_or_noise_is_as_large(
        a: tuple[float, ...], b: tuple[float, ...], noise: float, equal: bool) -> None:
    assert are_equal(Spread(a), Spread(b), noise) is equal
    assert are_equal(Spread(b), Spread(a), noise) is equal


def test_noise_is_the_largest_difference_of_the_control_up_or_down(tmp_path: Path) -> None:
    """Ratios of medians: 1.02 on a, 1 / 1.25 on b, which is farther from 1 than 0.8 looks."""
    rates = {'a': {'funky-kd': [99, 100, 200]}, 'b': {'funky-kd': [10, 10, 10]}}
    measured = measured_rates(tmp_path, rates, {'a': [102, 102, 50], 'b': [8, 8, 8]})
    assert measured.control_ratio(RATE, 'a', 'funky-kd') == pytest.approx(1.02)
    assert measured.control_ratio(RATE, 'b', 'funky-kd') == pytest.approx(0.8)
    assert measured.noise(RATE) == pytest.approx(0.25)
    assert measured.noise(PEAK) == 0


def test_noise_is_unknown_without_a_control_that_is_done(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.run('box', 'funky-kd')
    assert stored.measured().noise(RATE) is None
    stored.run('box', 'funky-kd', CONTROL, status='crashed')
    assert stored.measured().noise(RATE) is None


@pytest.mark.parametrize('control, best', [([105, 105, 105], ['fast']),
                                           ([112, 112, 112], ['fast', 'close'])])
def test_what_the_noise_cannot_tell_from_the_best_is_best_too(
        tmp_path: Path, control: list[float], best: list[str]) -> None:
    rates = {'box': {'funky-kd': [100] * 3, 'fast': [200, 202, 201], 'close': [182, 183, 184],
                     'slow': [150] * 3}}
    measured = measured_rates(tmp_path, rates, {'box': control})
    assert set(measured.best(RATE, 'box')) == set(best)
    assert measured.best(RATE, 'nowhere') == []


def test_overlapping_ranges_are_equal_without_any_noise(tmp_path: Path) -> None:
    rates = {'box': {'funky-kd': [10] * 3, 'a': [20, 21, 30], 'b': [29, 31, 32]}}
    assert measured_rates(tmp_path, rates, {'box': [10] * 3}).best(RATE, 'box') == ['a', 'b']


def test_less_is_better_for_times_and_memory(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.run('box', 'a', report={'memory.kernel_peak_bytes': 10}, rate=10)
    stored.run('box', 'b', report={'memory.kernel_peak_bytes': 11}, rate=20)
    measured = stored.measured()
    assert measured.best(PEAK, 'box') == ['a']
    assert measured.best(TOTAL, 'box') == ['b']


@pytest.mark.parametrize('answers, best', [({'missed': 1}, ['slow']), ({'ghost': 1}, ['slow']),
                                           ({'wrong_triangle': 1}, ['slow']),
                                           ({'false_visible': 1}, ['slow']),
                                           ({'false_occluded': 1}, ['slow']),
                                           ({'tie': 1000000}, ['fast']), ({}, ['fast'])])
def test_a_single_wrong_answer_costs_the_rank_and_the_mean(
        tmp_path: Path, answers: dict[str, int], best: list[str]) -> None:
    stored = Stored(tmp_path)
    stored.benchmark(kernels=['slow', 'fast'], rates={'slow': 1, 'fast': 100},
                     answers={'fast': answers}, control=None)
    measured = stored.measured()
    for metric in METRICS[:-1]:
        if metric in (RATE, TOTAL, RATE_H, RATE_V, RATE_MIXED):
            assert measured.best(metric, 'box') == best
    is_wrong = best == ['slow']
    assert measured.wrong_per_million('box', 'fast') == is_wrong
    assert (measured.relative(RATE, 'fast') is None) == is_wrong
    assert (measured.ahead('box', 'slow', 'fast') is None) == is_wrong


def test_all_wrong_there_is_no_best(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark(kernels=['a', 'b'], answers={'a': {'missed': 1}, 'b': {'missed': 2}})
    assert stored.measured().best(RATE, 'box') == []


@pytest.mark.parametrize('scenes', [1, 2, 3])
def test_a_geometric_mean_is_within_its_range_in_spite_of_rounding(scenes: int) -> None:
    for thousandths in range(1, 1000):
        assert Spread(scenes * (thousandths / 1000,)).geometric_mean == thousandths / 1000


# ---- Over scenes --------------------------------------------------------------------------------


def test_geometric_mean_relative_to_the_reference(tmp_path: Path) -> None:
    """4 and 1/2 times as fast: sqrt(2)."""
    rates = {'a': {'funky-kd': [10], 'other': [40]}, 'b': {'funky-kd': [20], 'other': [10]},
             'c': {'funky-kd': [1]}}
    measured = measured_rates(tmp_path, rates)
    ratios = measured.relative(RATE, 'other')
    assert ratios and ratios.samples == (4, 0.5)
    assert ratios.geometric_mean == pytest.approx(math.sqrt(2))
    assert measured.relative(RATE, 'funky-kd') == Spread((1, 1, 1))
    assert measured.relative(RATE_H, 'other') is None


def test_a_scene_where_the_reference_is_wrong_is_in_no_mean(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark(['good'], rates={'funky-kd': 10, 'simple-bvh': 5})
    stored.benchmark(['bad'], rates={'funky-kd': 99, 'simple-bvh': 5},
                     answers={'funky-kd': {'missed': 4}})
    measured = stored.measured()
    assert measured.relative(RATE, 'simple-bvh') == Spread((0.5,))
    assert measured.relative(RATE, 'funky-kd') == Spread((1,))


def test_without_funky_kd_another_kernel_is_the_reference(tmp_path: Path) -> None:
    measured = measured_rates(tmp_path, {'a': {'x': [10], 'y': [40]}})
    assert measured.reference == 'x'
    assert measured.relative(RATE, 'y') == Spread((4,))


# ---- Kernels alone ------------------------------------------------------------------------------


def replayed(folder: Path, rates: Mapping[str, Sequence[float]], scene: str = 'box',
             threads: int = 4, **run: Any) -> Stored:
    """@param rates of h, million per second, by kernel, one of each repeat"""
    stored = Stored(folder)
    for kernel, samples in rates.items():
        for repeat, rate in enumerate(samples, start=1):
            stored.run(scene, kernel, REPLAY, repeat=repeat, rate=rate, threads=threads, **run)
    return stored


def test_a_replay_is_one_sample_whatever_it_measured_within(tmp_path: Path) -> None:
    """Its own measurements depend on each other: the range is that of the repeats."""
    stored = replayed(tmp_path, {'a': [10, 30, 11]}, report={
        'replay.measurements.intersect_per_second': [1e6, 99e6]})
    spread = stored.measured().spread(RATE_H, 'box', 'a')
    assert spread and spread.samples == (10, 30, 11)


def test_replays_on_one_thread_and_on_all(tmp_path: Path) -> None:
    replayed(tmp_path / 'results', {'a': [40, 44, 36]})
    stored = replayed(tmp_path / 'results', {'a': [20, 11, 12]}, threads=1,
                      report={'time.initialize_s': 7, 'memory.kernel_peak_bytes': 5000})
    stored.run('box', 'a', report={'time.initialize_s': 2})
    measured = stored.measured()
    assert measured.replay_threads == [1, 4]
    for threads, h, build, peak in [(1, (20, 11, 12), 7, 5), (4, (40, 44, 36), 0.001, 200)]:
        spread = measured.spread(RATE_H.alone(threads), 'box', 'a')
        assert spread and spread.samples == h
        assert measured.median(INITIALIZE.alone(threads), 'box', 'a') == pytest.approx(build)
        assert measured.median(PEAK_PER_TRIANGLE.alone(threads), 'box', 'a') == peak
    assert measured.median(RATE_H, 'box', 'a') == 40
    assert measured.median(INITIALIZE, 'box', 'a') == 2
    assert measured.spread(RATE_H.alone(2), 'box', 'a') is None


def test_the_ratio_is_that_of_repeats_and_not_of_medians(tmp_path: Path) -> None:
    """The machine slows down to a tenth within the second repeat, after the turn of funky-kd."""
    measured = replayed(tmp_path, {'a': [200, 20, 20], 'funky-kd': [100, 100, 10]}).measured()
    ratio = measured.ratio(RATE_H, 'box', 'a', 'funky-kd')
    assert ratio and ratio.samples == pytest.approx((2, 0.2, 2))
    assert measured.relative(RATE_H, 'a') == Spread((2,))
    assert measured.median(RATE_H, 'box', 'a') / measured.median(RATE_H, 'box', 'funky-kd') == 0.2


def test_a_ratio_is_of_repeats_that_both_have(tmp_path: Path) -> None:
    measured = replayed(tmp_path, {'a': [3, 8, 10], 'b': [1, 2]}).measured()
    assert measured.ratio(RATE_H, 'box', 'a', 'b') == Spread((3, 4))


@pytest.mark.parametrize('run', [{'status': 'crashed'}, {'answers': {'missed': 1}}])
@pytest.mark.parametrize('threads', [1, 4])
def test_what_failed_or_answered_wrongly_once_has_no_ratio(tmp_path: Path, threads: int,
                                                           run: dict[str, Any]) -> None:
    stored = replayed(tmp_path, {'a': [3, 3, 3], 'b': [1, 1, 1]})
    assert stored.measured().ratio(RATE_H, 'box', 'a', 'b') == Spread((3, 3, 3))
    stored.run('box', 'b', REPLAY, repeat=4, threads=threads, **run)
    assert stored.measured().ratio(RATE_H, 'box', 'a', 'b') is None
    assert not stored.measured().is_right('box', 'b')


def test_wrong_answers_are_those_of_the_worst_replay(tmp_path: Path) -> None:
    stored = replayed(tmp_path, {'a': [1, 1, 1]})
    assert stored.measured().wrong_per_million('box', 'a') == 0
    stored.run('box', 'a', REPLAY, repeat=2, threads=1, answers={'missed': 7})
    assert stored.measured().wrong_per_million('box', 'a') == 7


def test_the_peer_is_the_fastest_on_the_scene(tmp_path: Path) -> None:
    """On box the second of them, on hall the first; a liar is a peer, too, but has no ratio."""
    for scene, fast, slow in [('box', 'two', 'one'), ('hall', 'one', 'two')]:
        stored = replayed(tmp_path, {'a': [30], slow: [10], fast: [15], 'funky-kd': [1]}, scene)
        stored.run(scene, 'liar', REPLAY, rate=99, answers={'ghost': 1})
    results = stored.measured().results
    measured = Measured(results, peers=['one', 'two', 'missing'])
    assert [measured.leader(RATE_MIXED, scene, measured.peers) for scene in ['box', 'hall']] == [
        'two', 'one']
    assert [measured.by_peer(RATE_MIXED, scene, 'a') for scene in ['box', 'hall']] == [
        Spread((2,)), Spread((2,))]
    lying = Measured(results, peers=['one', 'two', 'liar'])
    assert lying.by_peer(RATE_MIXED, 'box', 'a') == Spread((30 / 99,))
    assert lying.by_peer(RATE_MIXED, 'box', 'liar') is None
    assert Measured(results, peers=['missing']).by_peer(RATE_MIXED, 'box', 'a') == Spread((30,))
    assert Measured(results).by_peer(RATE_MIXED, 'box', 'a') == Spread((30,))


def test_scaling_is_that_of_repeats(tmp_path: Path) -> None:
    replayed(tmp_path, {'a': [20, 40, 90]})
    measured = replayed(tmp_path, {'a': [10, 20, 30]}, threads=1).measured()
    assert measured.scaling(RATE_MIXED, 'box', 'a') == Spread((2, 2, 3))


# ---- Break-even ---------------------------------------------------------------------------------


@pytest.mark.parametrize('build, rate, ahead', [
    # funky-kd takes 1 s + n / (10 million per second)
    (3, 20, (40e6, math.inf)),           # 3 + n / 20 < 1 + n / 10 from n = 40 on
    (0.5, 5, (0, 5e6)),                  # 0.5 + n / 5 < 1 + n / 10 up to n = 5
    (0.5, 20, (0, math.inf)), (3, 5, (math.inf, math.inf)), (1, 20, (0, math.inf)),
    (1, 5, (math.inf, math.inf)), (3, 10, (math.inf, math.inf)), (0.5, 10, (0, math.inf))])
def test_for_how_many_rays_a_kernel_is_ahead(tmp_path: Path, build: float, rate: float,
                                             ahead: tuple[float, float]) -> None:
    stored = Stored(tmp_path)
    stored.run('box', 'funky-kd', rate=10, report={'time.initialize_s': 1})
    stored.run('box', 'other', rate=rate, report={'time.initialize_s': build})
    assert stored.measured().ahead('box', 'other', 'funky-kd') == pytest.approx(ahead)


def test_nobody_is_ahead_of_what_failed(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.run('box', 'funky-kd', status='crashed')
    stored.run('box', 'other')
    assert stored.measured().ahead('box', 'other', 'funky-kd') is None
    assert stored.measured().ahead('box', 'funky-kd', 'other') is None


# ---- Threads and growth -------------------------------------------------------------------------


def test_thread_scaling(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    for repeat, factor in [(1, 1), (2, 1.1), (3, 0.9)]:
        for threads, rate in [(1, 3), (2, 5), (4, 8)]:
            stored.run('box', 'a', repeat=repeat, threads=threads, rate=rate * factor)
    measured = stored.measured()
    by_threads = measured.by_threads(RATE, 'box', 'a')
    assert {n: spread.median for n, spread in by_threads.items()} == {1: 3, 2: 5, 4: 8}
    assert by_threads[2].samples == pytest.approx((5, 5.5, 4.5))
    assert measured.threads == 4
    assert measured.median(RATE, 'box', 'a') == 8


def test_a_number_of_threads_that_failed_is_left_out(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.run('box', 'a')
    stored.run('box', 'a', threads=1, status='timed out')
    stored.run('box', 'a', threads=2, rate=7)
    assert set(stored.measured().by_threads(RATE, 'box', 'a')) == {2, 4}


def test_growth_is_in_the_order_of_triangles(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    for triangles, rate in [(1000000, 5), (1000, 20), (100000, 10)]:
        stored.run(f'forest@{triangles:g}', 'a', scale=triangles, triangles=triangles, rate=rate)
    stored.run('forest@1e+07', 'a', scale=10**7, status='out of memory')
    measured = stored.measured()
    points = [(x, spread.median) for x, spread in measured.by_triangles(RATE, 'a')]
    assert points == [(1000, 20), (100000, 10), (1000000, 5)]
    assert measured.growth_scene == 'forest'
    assert measured.scenes == []


# ---- The set as a whole -------------------------------------------------------------------------


def test_names_choose_results(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark(['a', 'b'], ['simple-bvh', 'funky-kd'])
    chosen = Measured(stored.measured().results, {('a', 'funky-kd')})
    assert (chosen.scenes, chosen.kernels) == (['a'], ['funky-kd'])


def test_order_does_not_depend_on_when_what_was_measured(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    for kernel in ['zoo', 'alpha', 'funky-kd', 'simple-bvh']:
        for scene, triangles in [('small', 10), ('large', 1000), ('medium', 100)]:
            stored.run(scene, kernel, triangles=triangles, exposure=None)
    measured = stored.measured()
    assert measured.kernels == ['simple-bvh', 'funky-kd', 'alpha', 'zoo']
    assert measured.scenes == ['small', 'medium', 'large']


def test_exact_figures_are_told_apart_by_any_difference() -> None:
    assert [metric for metric in METRICS if metric.is_exact] == [
        PEAK, FINAL, PEAK_PER_TRIANGLE, BYTES_PER_TRIANGLE, SQUARED_ERROR]
    assert not INITIALIZE.is_exact
