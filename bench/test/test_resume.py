# SPDX-License-Identifier: GPL-3.0-only
"""A benchmark that is ended at any moment goes on where it was; nothing is measured twice."""

import json
import os
import random
import signal
import subprocess
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from fakes import Bench, complaint, files, mounted_disk, session
from metrics import RATE
from plan import CONTROL, RECORD, RENDER, REPLAY, Run
from results import locked
from stored import Stored

KILLS = 5
PATIENCE_S = 30
WAIT = 'time.sleep(0.02)'
HANG = '''
for number in (signal.SIGTERM, signal.SIGINT):
    signal.signal(number, signal.SIG_IGN)
if SCENE == "hall.scene" and KIND == "render":
    time.sleep(100)
'''


def wait_for(happened: Callable[[], object], process: subprocess.Popen[str] | None = None) -> None:
    """Until something is so, or a process has ended."""
    end = time.monotonic() + PATIENCE_S
    while not happened() and (process is None or process.poll() is None):
        assert time.monotonic() < end, 'it did not happen in time'
        time.sleep(0.002)


def results(bench: Bench) -> dict[str, str]:
    """All results so far, each of which must be whole."""
    found = {str(path): path.read_text() for path in sorted(bench.results.glob('*/*/*.json'))}
    for text in found.values():
        assert json.loads(text)['bench']['status'] == 'done'
    return found


# ---- Killed at any moment -----------------------------------------------------------------------


@pytest.fixture(scope='module')
def killed(tmp_path_factory: pytest.TempPathFactory) -> Bench:
    """Killed again and again, then left to end. What holds at each kill is tested on the way."""
    bench = Bench(tmp_path_factory.mktemp('killed'))
    bench.scene('hall')
    for name in ['simple-bvh', 'funky-kd']:
        bench.kernel(name, WAIT)
    moments = random.Random(1)
    before: dict[str, str] = {}
    for _ in range(KILLS):
        enough = len(bench.invocations(but=())) + moments.randint(1, 4)
        with bench.started() as process:
            wait_for(lambda: len(bench.invocations(but=())) >= enough, process)
            time.sleep(moments.uniform(0, 0.06))
        wait_for(lambda: not bench.processes())
        after = results(bench)
        assert after.items() >= before.items(), 'a result was lost or measured again'
        before = after
    assert 0 < len(before) < 44, 'the kills did not hit the measuring'
    bench.measure()
    assert results(bench).items() >= before.items()
    return bench


def test_after_kills_every_run_has_one_result(killed: Bench) -> None:
    found = killed.measured().results
    counted = Counter((result.scene, result.kernel, result.kind) for result in found)
    expected = {(scene, kernel, RENDER): 3 for scene in ['box', 'hall']
                for kernel in ['simple-bvh', 'funky-kd']}
    expected |= {(scene, 'funky-kd', CONTROL): 3 for scene in ['box', 'hall']}
    expected |= {(scene, 'simple-bvh', RECORD): 1 for scene in ['box', 'hall']}
    expected |= {(scene, kernel, REPLAY): 6 for scene in ['box', 'hall']
                 for kernel in ['simple-bvh', 'funky-kd']}
    assert counted == expected


def test_a_kill_wastes_one_run_at_most(killed: Bench) -> None:
    assert 44 <= len(killed.invocations()) <= 44 + KILLS


def test_kills_leave_nothing_behind(killed: Bench) -> None:
    assert {path.name for path in killed.results.iterdir()} == {'.lock', 'box', 'hall'}
    assert {Path(name).suffix for name in files(killed.results)} == {
        '.json', '.txt', '.exr', '.png', '.rays'}
    assert killed.processes() == []


def test_once_more_measures_nothing(killed: Bench) -> None:
    assert killed.measurement().missing() == []


# ---- Ended by a signal --------------------------------------------------------------------------


@pytest.mark.parametrize('number, status, said', [
    (signal.SIGINT, 1, 'bench.py: interrupted; the results so far are kept\n'),
    (signal.SIGTERM, 128 + signal.SIGTERM, '')])
def test_a_signal_ends_it_and_its_kernel_and_keeps_results(
        tmp_path: Path, number: signal.Signals, status: int, said: str) -> None:
    bench = Bench(tmp_path)
    bench.scene('hall')
    bench.kernel('stubborn', HANG)
    with bench.started() as process:
        wait_for(lambda: 'stubborn render hall.scene 2' in bench.invocations(), process)
        process.send_signal(number)
        _, errors = process.communicate(timeout=PATIENCE_S)
    assert (process.returncode, errors) == (status, said)
    assert bench.processes() == []
    assert {path.name for path in bench.results.iterdir()} == {'.lock', 'box'}
    assert len(results(bench)) == 1


def test_a_kill_ends_its_kernel(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.scene('hall')
    bench.kernel('stubborn', HANG)
    with bench.started() as process:
        wait_for(lambda: 'stubborn render hall.scene 2' in bench.invocations(), process)
    wait_for(lambda: not bench.processes())


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_signal_while_figures_are_drawn_leaves_no_process(tmp_path: Path,
                                                            number: signal.Signals) -> None:
    bench = Bench(tmp_path)
    Stored(bench.results).benchmark(['box', 'hall'])
    with bench.started('--report-only') as process:
        wait_for(lambda: len(session(process.pid)) > 1, process)
        time.sleep(0.5)  # Python forgets exceptions of signals that arrive while it forks
        process.send_signal(number)
        process.wait(PATIENCE_S)
        wait_for(lambda: not session(process.pid))
    assert not bench.output.with_name('report.pdf').exists()


# ---- What is out of date ------------------------------------------------------------------------


@pytest.fixture(scope='module')
def measured_once(tmp_path_factory: pytest.TempPathFactory) -> Bench:
    bench = Bench(tmp_path_factory.mktemp('done'))
    bench.scene('hall')
    for name in ['simple-bvh', 'funky-kd']:
        bench.kernel(name)
    bench.measure(bench.plan(repeats=2))
    assert bench.measurement(bench.plan(repeats=2)).missing() == []
    return bench


@pytest.fixture
def done(measured_once: Bench, tmp_path: Path) -> Bench:
    """All runs of two kernels on two scenes, two repeats."""
    return measured_once.copy(tmp_path)


def missing(bench: Bench, **plan: Any) -> Counter[tuple[str, str, str]]:
    """Scene, kernel and kind of the runs that would be made."""
    plan = {'repeats': 2, **plan}
    runs = bench.measurement(bench.plan(**plan)).missing()
    return Counter((run.scene.name, run.kernel.name, run.kind) for run in runs)


def of(scene: str, kernel: str) -> Counter[tuple[str, str, str]]:
    """All that is made of a kernel on a scene, but for a recording."""
    control = {(scene, kernel, CONTROL): 2} if kernel == 'funky-kd' else {}
    return Counter({(scene, kernel, RENDER): 2, (scene, kernel, REPLAY): 4, **control})


BOX, HALL = ('box', 'hall')
EVERYTHING = of(BOX, 'simple-bvh') + of(BOX, 'funky-kd') + of(HALL, 'simple-bvh') + of(
    HALL, 'funky-kd')
RECORDS = Counter({(scene, 'simple-bvh', RECORD): 1 for scene in (BOX, HALL)})
REPLAYS = Counter({key: n for key, n in EVERYTHING.items() if key[2] == REPLAY})
RENDERINGS = EVERYTHING - REPLAYS
ON_ONE_THREAD = Counter({key: n // 2 for key, n in REPLAYS.items()})


def test_another_kernel_is_measured_alone(done: Bench) -> None:
    done.kernel('another')
    assert missing(done) == of(BOX, 'another') + of(HALL, 'another')


def test_a_changed_kernel_is_measured_again_alone(done: Bench) -> None:
    done.kernel('funky-kd', '# changed')
    assert missing(done) == of(BOX, 'funky-kd') + of(HALL, 'funky-kd')


def test_a_changed_recorder_means_new_replays(done: Bench) -> None:
    done.kernel('simple-bvh', '# changed')
    assert missing(done) == of(BOX, 'simple-bvh') + of(HALL, 'simple-bvh') + RECORDS + REPLAYS - \
        Counter({(scene, 'simple-bvh', REPLAY): 4 for scene in (BOX, HALL)})


@pytest.mark.parametrize('ending', ['.scene', '.camera'])
def test_a_changed_scene_is_measured_again_alone(done: Bench, ending: str) -> None:
    with open(done.scenes / f'hall{ending}', 'a') as file:
        file.write('# changed\n')
    assert missing(done) == of(HALL, 'simple-bvh') + of(HALL, 'funky-kd') + Counter(
        {(HALL, 'simple-bvh', RECORD): 1})


@pytest.mark.parametrize('text', ['triangles box.ra2\n', 'reflectance 0.5 triangles "box.ra2"',
                                  '# triangles a.ra2\ntriangles # comment\n  box.ra2#x\n'])
def test_changed_triangles_are_measured_again(done: Bench, text: str) -> None:
    for name in (BOX, HALL):
        (done.scenes / f'{name}.scene').write_text(text)
    done.measure(done.plan(repeats=2))
    (done.scenes / 'box.ra2').write_bytes(bytes(72))
    assert missing(done) == EVERYTHING + RECORDS


def test_files_written_anew_with_the_same_content_change_nothing(done: Bench) -> None:
    program = done.build / 'bwfirt-funky-kd'
    program.write_bytes(program.read_bytes())
    done.scene('hall')
    assert missing(done) == Counter()


@pytest.mark.parametrize('option, runs', [
    ({'passes': 8}, RENDERINGS),
    ({'size': '4x4'}, EVERYTHING + RECORDS),
    ({'threads': 1}, RENDERINGS + ON_ONE_THREAD),
    ({'replay_rays': 2000}, REPLAYS + RECORDS),
    ({'replay_seconds': 2}, REPLAYS),
    ({'time_limit': 5}, Counter()),
    ({'repeats': 1}, Counter())])
def test_another_option_means_new_runs_where_it_matters(
        done: Bench, option: dict[str, Any], runs: Counter[tuple[str, str, str]]) -> None:
    assert missing(done, **option) == runs


def test_more_repeats_mean_the_additional_ones(done: Bench) -> None:
    runs = done.measurement(done.plan(repeats=4)).missing()
    assert {run.repeat for run in runs} == {3, 4}
    assert Counter((run.scene.name, run.kernel.name, run.kind) for run in runs) == EVERYTHING
    measured = done.measure(done.plan(repeats=4))
    assert len(measured.runs(BOX, 'funky-kd')) == 4
    assert len(measured.replays(BOX, 'funky-kd')) == 8


def test_half_of_a_measurement_with_new_options_is_not_mixed_with_old_runs(done: Bench) -> None:
    done.kernel('funky-kd', rate=30)
    plan = done.plan(repeats=2)
    measurement = done.measurement(plan)
    first = Run(RENDER, plan.scenes[0], plan.kernels[0], 2)
    assert first.kernel.name == 'funky-kd'
    unfinished = done.folder / 'unfinished'
    unfinished.mkdir()
    measurement.make(first, unfinished)
    spread = done.measured().spread(RATE, BOX, 'funky-kd')
    assert spread and spread.samples == (30,)


def test_a_kernel_that_changes_meanwhile_is_measured_again(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('odd', 'with open(sys.argv[0], "a") as program: program.write("# more\\n")')
    bench.measure(bench.plan(repeats=1, control=''))
    assert missing(bench, repeats=1, control='') == Counter({(BOX, 'odd', RENDER): 1})


def test_deleted_ray_streams_are_recorded_again_when_they_are_needed(done: Bench) -> None:
    for stream in done.results.rglob('*.rays'):
        stream.unlink()
    assert missing(done) == Counter()
    done.kernel('funky-kd', '# changed')
    assert missing(done) == of(BOX, 'funky-kd') + of(HALL, 'funky-kd') + RECORDS
    assert all(result.done for result in done.measure(done.plan(repeats=2)).results)


@pytest.mark.parametrize('text', ['', '{', '[]', '{"bench": 7}', '{"bench": {"scene": "box"}}'])
def test_a_file_that_is_no_result_is_replaced(done: Bench, text: str) -> None:
    (done.results / 'box/funky-kd/render-2-threads-2.json').write_text(text)
    assert missing(done) == Counter({(BOX, 'funky-kd', RENDER): 1})
    spread = done.measured().spread(RATE, BOX, 'funky-kd')
    assert spread and len(spread.samples) == 1


# ---- bench.py as a whole ------------------------------------------------------------------------


def test_fresh_forgets_these_kernels_on_these_scenes_only(done: Bench) -> None:
    before = results(done)
    mine = {name for name in before if '/box/funky-kd/' in name}
    done.kernel('funky-kd', 'if KIND == "render": time.sleep(100)')
    box = done.scenes / 'box.scene'
    with done.started('--fresh', '--kernels', 'funky-kd', '--scenes', box) as process:
        wait_for(lambda: done.invocations()[-1:] == ['funky-kd render box.scene 2'], process)
    after = results(done)
    assert after == {name: text for name, text in before.items() if name not in mine}
    assert (done.results / 'box/simple-bvh/record.rays').exists()


def test_a_second_bench_is_refused_and_harms_nothing(done: Bench) -> None:
    before = results(done)
    with locked(done.results) as unfinished:
        (unfinished / 'run.txt').write_text('under way')
        for arguments in [['--repeats', '4'], ['--fresh']]:
            message = complaint(done.run(*arguments), 1)
            assert message == (f'{done.results}: another bench.py, process {os.getpid()}, '
                               'measures there')
        assert (unfinished / 'run.txt').read_text() == 'under way'
    assert results(done) == before
    assert (done.results / '.lock').read_text() == str(os.getpid())


def test_a_file_in_place_of_the_results_is_one_line(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('good')
    bench.results.write_text('kept')
    assert str(bench.results) in complaint(bench.run(), 1)
    assert (bench.results.read_text(), bench.invocations()) == ('kept', [])


def test_read_only_results_are_one_line(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('good')
    bench.results.mkdir(mode=0o555)
    command = bench.command()
    if os.geteuid() == 0:  # root writes everywhere unless it gives that right up
        command = ['setpriv', '--bounding-set=-dac_override', *command]
        if subprocess.run([*command[:2], 'true'], check=False).returncode != 0:
            pytest.skip('root cannot give up its right to write everywhere here')
    result = subprocess.run(command, check=False, capture_output=True, text=True, timeout=60)
    assert str(bench.results) in complaint(result, 1)
    assert bench.invocations() == []


def test_a_disk_that_is_nearly_full_is_one_line_and_no_row(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('good')
    with mounted_disk(tmp_path, 8) as disk:
        bench.results = disk / 'results'
        assert complaint(bench.run(), 1).endswith('MB are left on its disk')
        assert (bench.invocations(), files(bench.results)) == ([], set())


def test_a_disk_that_becomes_full_is_one_line_and_keeps_results(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    with mounted_disk(tmp_path, 24) as disk:
        bench.results = disk / 'results'
        bench.kernel('a-good', 'pass')
        bench.kernel('greedy', f'try: open({str(disk / "filler")!r}, "wb").write(bytes(2**25))\n'
                     'except OSError: pass')
        message = complaint(bench.run('--kernels', 'a-good,greedy'), 1)
        assert 'No space left' in message or 'MB are left on its disk' in message
        assert any('a-good' in name for name in results(bench))
        assert not any('greedy' in name for name in results(bench))
        (disk / 'filler').unlink()
        bench.kernel('greedy')
        assert all(result.done for result in bench.measure(bench.plan(repeats=1)).results)
