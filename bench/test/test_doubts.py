# SPDX-License-Identifier: GPL-3.0-only
"""Each warning appears where it should, and nowhere else: a benchmark as it comes has none."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from doubts import doubts, failures
from plan import CONTROL, RECORD, REPLAY
from stored import BEGIN, FLAGS, MACHINE, Stored

KERNELS = ['simple-bvh', 'funky-kd']


def only(warnings: list[str], *begins: str) -> bool:
    """Whether there are these warnings and no others, by what they begin with."""
    return len(warnings) == len(begins) and all(
        warning.startswith(begin) for warning, begin in zip(warnings, begins))


def doubts_of(folder: Path, **changes: Any) -> list[str]:
    stored = Stored(folder)
    stored.benchmark(**changes)
    return doubts(stored.measured())


def doubts_with(folder: Path, *, report: Mapping[str, Any] = {}, bench: Mapping[str, Any] = {},
                kind: str = 'render') -> list[str]:
    """Of a benchmark with one further kernel, of which one run differs."""
    stored = Stored(folder)
    stored.benchmark()
    for repeat in (1, 2, 3):
        differs = kind == 'render' and repeat == 2
        stored.run('box', 'odd', repeat=repeat, report=report if differs else {},
                   bench=bench if differs else {})
    if kind != 'replay':
        stored.run('box', 'odd', REPLAY)
    if kind != 'render':
        stored.run('box', 'odd', kind, report=report, bench=bench)
    return doubts(stored.measured())


def test_a_further_kernel_is_beyond_doubt(tmp_path: Path) -> None:
    assert doubts_with(tmp_path) == []


# ---- How much was measured ----------------------------------------------------------------------


def test_no_control(tmp_path: Path) -> None:
    assert only(doubts_of(tmp_path, control=None), 'There is no control: ')


@pytest.mark.parametrize('repeats, warned', [(1, True), (2, True), (3, False), (4, False)])
def test_few_repeats(tmp_path: Path, repeats: int, warned: bool) -> None:
    warnings = doubts_of(tmp_path, repeats=repeats)
    assert only(warnings, *[f'Too few repeats: {repeats} for some kernel'] * warned)


def test_few_repeats_of_one_kernel(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark()
    for kind in ('render', REPLAY):
        stored.run('box', 'odd', kind)
    assert only(doubts(stored.measured()), 'Too few repeats: 1 ')


def test_a_kernel_that_failed_at_once_has_not_too_few_repeats(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark()
    stored.run('box', 'odd', status='crashed')
    stored.run('box', 'odd', REPLAY, status='crashed')
    assert doubts(stored.measured()) == []


@pytest.mark.parametrize('rates, warned', [((100, 104, 109), False), ((100, 104, 115), True),
                                           ((80, 100, 101), True), ((96, 100, 105), False)])
def test_wide_spread(tmp_path: Path, rates: tuple[float, ...], warned: bool) -> None:
    warnings = doubts_of(tmp_path, rates=lambda scene, kernel, repeat:
                         rates[repeat - 1] / 10 if kernel == 'simple-bvh' else 10)
    assert only(warnings, *['Wide spread: the rays per second of 1 of 2 pairs of kernel and scene '
                            'vary by more than 10 % of their median; most those of simple-bvh on '
                            'box, by '] * warned)


@pytest.mark.parametrize('seconds, warned', [(0.9, True), (1.1, False)])
def test_short_runs(tmp_path: Path, seconds: float, warned: bool) -> None:
    warnings = doubts_of(tmp_path, rates={'funky-kd': 100 / seconds})
    assert only(warnings, *['Short runs: 1 of 2 pairs of kernel and scene rendered for less than 1 '
                            's.'] * warned)


@pytest.mark.parametrize('seconds, warned', [(0.5, True), (1, False)])
def test_quick_replays(tmp_path: Path, seconds: float, warned: bool) -> None:
    stored = Stored(tmp_path)
    stored.benchmark(replays=False)
    for kernel in KERNELS:
        stored.run('box', kernel, REPLAY, bench={'fingerprint.replay_seconds': seconds})
    assert only(doubts(stored.measured()), *['Quick replays: '] * warned)


@pytest.mark.parametrize('key, value', [('size', '9x9'), ('passes', 99), ('threads', 3)])
def test_different_extents(tmp_path: Path, key: str, value: object) -> None:
    stored = Stored(tmp_path)
    stored.benchmark()
    for repeat in (1, 2, 3):
        stored.run('hall', 'simple-bvh', repeat=repeat, bench={f'fingerprint.{key}': value})
    warnings = [text for text in doubts(stored.measured()) if 'differ in' in text]
    assert warnings == [f'The runs differ in {key}.']


# ---- The machine --------------------------------------------------------------------------------


@pytest.mark.parametrize('kind', ['render', CONTROL, REPLAY])
@pytest.mark.parametrize('key, share, warning', [
    ('others', 0.051, 'runs other processes took more than 5 % of its processor time, at most '
     '5.1 %.'),
    ('others', 0.049, ''),
    ('stolen', 0.02, 'runs other virtual machines took (steal time) more than 1 % of its processor '
     'time, at most 2 %.'), ('stolen', 0.01, '')])
def test_load(tmp_path: Path, kind: str, key: str, share: float, warning: str) -> None:
    warnings = doubts_with(tmp_path, kind=kind, bench={f'disturbance.{key}': share})
    assert only(warnings, *['The machine was not quiet: in 1 of '] * bool(warning))
    assert all(text.endswith(warning) for text in warnings)


def test_load_of_a_recording_does_not_matter(tmp_path: Path) -> None:
    assert doubts_with(tmp_path, kind=RECORD, bench={'disturbance.others': 0.9}) == []


@pytest.mark.parametrize('key, value, begins', [
    ('virtual', True, ['Measured in a virtual machine: ']),
    ('governor', 'powersave', ['The scaling governor is powersave, not performance.']),
    ('governor', 'performance', []), ('governor', '', []),
    ('boost', 'on', ['Boost is on: ']), ('boost', 'off', []), ('boost', '', []),
    ('cpu', 'Another Processor', ['The runs were made on different processors.']),
    ('affinity', [0, 1], ['The runs were made on different processors.'])])
def test_machine(tmp_path: Path, key: str, value: object, begins: list[str]) -> None:
    warnings = doubts_with(tmp_path, bench={'machine': {**MACHINE, key: value}})
    assert only(warnings, *begins)


def test_several_sessions(tmp_path: Path) -> None:
    warnings = doubts_with(tmp_path, bench={'session': '2026-02-03T00:00:00+00:00'})
    assert warnings == [f'Measured in 2 sessions, between {BEGIN.isoformat()} and '
                        '2026-02-03T00:00:00+00:00, box among others: the machine may have changed '
                        'in between.']


# ---- The programs -------------------------------------------------------------------------------


@pytest.mark.parametrize('key, value, begins', [
    ('flags', FLAGS + ' -g', ['The framework was compiled with different flags']),
    ('flags', FLAGS.replace('-O3', '-O0'), ['A debug build, or one with sanitizers, ',
                                            'The framework was compiled with different flags']),
    ('flags', FLAGS + ' -fsanitize=address', ['A debug build, or one with sanitizers, ',
                                              'The framework was compiled with different flags']),
    ('kernel_flags', FLAGS + ' -mavx2', ['Kernels were compiled with different flags']),
    ('compiler', 'clang 14', ['Different compilers were used.']),
    ('commit', 'fedcba9876543210', ['The kernels are of different commits.']),
    ('commit', '0123-dirty', ['The kernels are of different commits.',
                              'The sources were not those of a commit: '])])
def test_builds(tmp_path: Path, key: str, value: str, begins: list[str]) -> None:
    assert only(doubts_with(tmp_path, report={f'program.{key}': value}), *begins)


def test_a_debug_build_of_all(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark(replays=False, report={'program.flags': '-O0 -g'})
    assert 'A debug build, or one with sanitizers, was measured.' in doubts(stored.measured())


# ---- The answers --------------------------------------------------------------------------------


def test_unchecked_answers(tmp_path: Path) -> None:
    warnings = doubts_of(tmp_path, scenes=['box', 'hall'], replays=False)
    assert warnings == [f'The answers of {kernel} were not checked on box, hall.'
                        for kernel in KERNELS]


def test_a_kernel_without_figures_need_not_be_checked(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark()
    stored.run('box', 'odd', status='crashed')
    assert doubts(stored.measured()) == []


@pytest.mark.parametrize('kind', ['render', CONTROL])
def test_answers_that_differ_from_run_to_run(tmp_path: Path, kind: str) -> None:
    warnings = doubts_with(tmp_path, kind=kind, report={'average_intensity': [0.2501, 0.2501, 0.3]})
    assert warnings == ['odd answers differently from run to run on box: its images of the same '
                        'seed are not the same.']


def test_answers_that_differ_with_the_number_of_threads(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark()
    stored.run('box', 'funky-kd', threads=1, report={'average_intensity': [0.25, 0.25, 0.25]})
    assert only(doubts(stored.measured()), 'funky-kd answers differently from run to run on box: ')


def test_wrong_answers_are_failures_and_no_doubt(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark(answers={'funky-kd': {'missed': 3, 'tie': 5}})
    assert doubts(stored.measured()) == []
    assert failures(stored.measured()) == [('box', 'funky-kd', 'wrong answers',
                                            '3 missed of 1000000')]


@pytest.mark.parametrize('kind', ['render', CONTROL, REPLAY])
def test_leaks(tmp_path: Path, kind: str) -> None:
    warnings = doubts_with(tmp_path, kind=kind, report={
        'memory.kernel_leaked_bytes': 77, 'warnings': ['the kernel leaked 77 bytes']})
    assert warnings == ['odd leaked memory: up to 77 bytes in a run.']


def test_what_a_kernel_warns_of_is_told_once(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark(['box', 'hall'], report={'warnings': ['coordinates are beyond 128']})
    assert doubts(stored.measured()) == [
        f'{kernel} on box, hall: coordinates are beyond 128.' for kernel in KERNELS]


@pytest.mark.parametrize('warning', [
    'the rays were recorded meanwhile: measure speed without --record',
    'answers differ from the recorded ones: missed 3',
    'rates measured for 0.05 s at a time are for a first look: take the default of 1 s'])
def test_what_is_told_otherwise_is_not_told_twice(tmp_path: Path, warning: str) -> None:
    assert doubts_with(tmp_path, report={'warnings': [warning]}) == []


# ---- Nothing measured ---------------------------------------------------------------------------


def test_all_failed_is_no_error(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.run('box', 'a', status='crashed', message='SIGSEGV')
    stored.run('box', 'b', status='timed out', message='after 9 s')
    measured = stored.measured()
    assert only(doubts(measured), 'There is no control: ')
    assert failures(measured) == [('box', 'a', 'render: crashed', 'SIGSEGV'),
                                  ('box', 'b', 'render: timed out', 'after 9 s')]
