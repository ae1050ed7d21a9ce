# SPDX-License-Identifier: GPL-3.0-only
"""Kernels take turns, so that a machine which drifts harms all alike."""

from pathlib import Path
from typing import Any

import pytest

from fakes import Bench
from plan import CONTROL, RECORD, RENDER, REPLAY, thread_counts


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    bench = Bench(tmp_path)
    bench.scene('hall')
    for name in ['simple-bvh', 'funky-kd', 'other']:
        bench.kernel(name)
    return bench


def renderings(bench: Bench, scene: str, **plan: Any) -> list[list[str]]:
    """The kernels of each repeat in their order, the control marked by a star."""
    runs = [run for run in bench.plan(['simple-bvh', 'funky-kd', 'other'], **plan).runs()
            if run.kind in (RENDER, CONTROL) and run.scene.name == scene]
    return [[run.kernel.name + '*' * (run.kind == CONTROL) for run in runs if run.repeat == repeat]
            for repeat in range(1, runs[-1].repeat + 1)]


@pytest.mark.parametrize('scene', ['box', 'hall'])
def test_each_repeat_begins_with_another_kernel(bench: Bench, scene: str) -> None:
    assert renderings(bench, scene, repeats=5) == [
        ['simple-bvh', 'funky-kd', 'other', 'funky-kd*'],
        ['funky-kd', 'other', 'funky-kd*', 'simple-bvh'],
        ['other', 'funky-kd*', 'simple-bvh', 'funky-kd'],
        ['funky-kd*', 'simple-bvh', 'funky-kd', 'other'],
        ['simple-bvh', 'funky-kd', 'other', 'funky-kd*']]


def test_without_the_control_kernel_there_is_no_control(bench: Bench) -> None:
    assert CONTROL not in {run.kind for run in bench.plan(control='missing').runs()}


def test_a_repeat_of_all_scenes_is_done_before_the_next(bench: Bench) -> None:
    runs = [run for run in bench.plan().runs() if run.kind in (RENDER, CONTROL)]
    assert [(run.repeat, run.scene.name) for run in runs] == [
        (repeat, scene) for repeat in (1, 2, 3) for scene in ['box', 'hall'] for _ in range(4)]


@pytest.mark.parametrize('scene', ['box', 'hall'])
@pytest.mark.parametrize('threads', [1, 2])
def test_kernels_replay_in_turns_and_each_repeat_begins_with_another(
        bench: Bench, scene: str, threads: int) -> None:
    runs = [(run.repeat, run.kernel.name)
            for run in bench.plan(['simple-bvh', 'funky-kd', 'other'], repeats=4).runs()
            if (run.kind, run.scene.name, run.threads) == (REPLAY, scene, threads)]
    assert runs == [(1, 'simple-bvh'), (1, 'funky-kd'), (1, 'other'),
                    (2, 'funky-kd'), (2, 'other'), (2, 'simple-bvh'),
                    (3, 'other'), (3, 'simple-bvh'), (3, 'funky-kd'),
                    (4, 'simple-bvh'), (4, 'funky-kd'), (4, 'other')]


@pytest.mark.parametrize('threads, counts', [(1, [1]), (6, [1, 6])])
def test_kernels_replay_on_one_thread_and_on_all(bench: Bench, threads: int,
                                                 counts: list[int]) -> None:
    runs = [run for run in bench.plan(['other'], threads=threads, repeats=1).runs()
            if run.kind == REPLAY]
    assert [(run.scene.name, run.threads) for run in runs] == [
        (scene, count) for scene in ['box', 'hall'] for count in counts]
    assert {run.name for run in runs if run.scene.name == 'box'} == {
        f'box/other/replay-{count}-threads-1' for count in counts}


def test_rays_are_recorded_once_before_they_are_replayed(bench: Bench) -> None:
    for scene in ['box', 'hall']:
        kinds = [run.kind for run in bench.plan(['simple-bvh', 'other']).runs()
                 if run.scene.name == scene and run.kind in (RECORD, REPLAY)]
        assert kinds == [RECORD] + 3 * 4 * [REPLAY]


@pytest.mark.parametrize('threads, counts', [(1, [1]), (2, [1, 2]), (6, [1, 2, 4, 6]),
                                             (8, [1, 2, 4, 8])])
def test_thread_counts_double_up_to_all(threads: int, counts: list[int]) -> None:
    assert thread_counts(threads) == counts


def test_a_scaling_scene_is_rendered_with_fewer_threads_too(bench: Bench) -> None:
    runs = [run for run in bench.plan(['other'], scaling=['hall'], threads=6, repeats=1,
                                      control='').runs() if run.kind == RENDER]
    assert [(run.scene.name, run.threads) for run in runs] == [
        ('box', 6), ('hall', 6), ('hall', 1), ('hall', 2), ('hall', 4)]


def test_runs_are_made_in_that_order_after_one_warm_up_a_scene(bench: Bench) -> None:
    bench.measure(bench.plan(['simple-bvh', 'funky-kd'], repeats=2))
    assert bench.invocations(but=()) == [
        'simple-bvh warm-up box.scene None',
        'simple-bvh render box.scene 2', 'funky-kd render box.scene 2',
        'funky-kd render box.scene 2',
        'simple-bvh record box.scene 1',
        'simple-bvh replay box.scene 1', 'funky-kd replay box.scene 1',
        'simple-bvh replay box.scene 2', 'funky-kd replay box.scene 2',
        'simple-bvh warm-up hall.scene None',
        'simple-bvh render hall.scene 2', 'funky-kd render hall.scene 2',
        'funky-kd render hall.scene 2',
        'simple-bvh record hall.scene 1',
        'simple-bvh replay hall.scene 1', 'funky-kd replay hall.scene 1',
        'simple-bvh replay hall.scene 2', 'funky-kd replay hall.scene 2',
        'funky-kd render box.scene 2', 'funky-kd render box.scene 2',
        'simple-bvh render box.scene 2',
        'funky-kd replay box.scene 1', 'simple-bvh replay box.scene 1',
        'funky-kd replay box.scene 2', 'simple-bvh replay box.scene 2',
        'funky-kd render hall.scene 2', 'funky-kd render hall.scene 2',
        'simple-bvh render hall.scene 2',
        'funky-kd replay hall.scene 1', 'simple-bvh replay hall.scene 1',
        'funky-kd replay hall.scene 2', 'simple-bvh replay hall.scene 2']


def test_no_two_kernels_run_at_a_time(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    alone = f'os.mkdir({str(tmp_path / "alone")!r}); time.sleep(0.01)\n' \
            f'os.rmdir({str(tmp_path / "alone")!r})'
    for name in ['simple-bvh', 'funky-kd']:
        bench.kernel(name, alone)
    assert all(result.done for result in bench.measure().results)


@pytest.mark.parametrize('options', ['fast=1', 'quality=high,robust=0', 'file=/a/b.txt'])
def test_a_kernel_takes_part_several_times_with_options(tmp_path: Path, options: str) -> None:
    bench = Bench(tmp_path)
    bench.kernel('simple-bvh')
    name = f'simple-bvh:{options}'
    measured = bench.measure(bench.plan(['simple-bvh', name], repeats=1))
    assert measured.kernels == ['simple-bvh', name]
    run = measured.first('box', name)
    assert run and run.report['kernel_options'] == dict(
        option.split('=') for option in options.split(','))
