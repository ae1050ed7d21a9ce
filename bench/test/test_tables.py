# SPDX-License-Identifier: GPL-3.0-only
"""What the tables show of good, wrong and failed kernels; and the comparison of two sets."""

import csv
import io
from pathlib import Path

import pytest

import tables
from compare import compare
from doubts import failures
from metrics import Measured
from plan import REPLAY
from report import write_csv
from stored import Stored
from tables import Cell, Table


def row(table: Table, name: str) -> list[Cell]:
    return next(cells for cells in table.rows if cells[0].text == name)


def texts(cells: list[Cell]) -> list[str]:
    return [cell.text for cell in cells]


def all_tables(measured: Measured) -> list[Table]:
    of_scenes = [table for scene in measured.scenes for table in tables.of_scene(measured, scene)]
    return of_scenes + tables.summary(measured) + [
        table(measured) for table in [*tables.OVERALL_TABLES, *tables.SYSTEM_TABLES]]


@pytest.fixture(scope='module')
def measured(tmp_path_factory: pytest.TempPathFactory) -> Measured:
    """Two good kernels; one that is fast and wrong; one that crashes; one whose replay does."""
    stored = Stored(tmp_path_factory.mktemp('results'))
    stored.benchmark(['box'], ['simple-bvh', 'funky-kd', 'liar'], answers={
        'liar': {'missed': 30, 'false_visible': 12, 'tie': 5}},
        rates={'simple-bvh': 5, 'funky-kd': 10, 'liar': 77})
    stored.run('box', 'broken', status='crashed', message='SIGSEGV')
    stored.run('box', 'broken', REPLAY, status='crashed', message='SIGSEGV')
    for repeat in (1, 2, 3):
        stored.run('box', 'shy', repeat=repeat, rate=66)
    stored.run('box', 'shy', REPLAY, status='timed out', message='after 9 s')
    return stored.measured()


# ---- Speed --------------------------------------------------------------------------------------


def test_the_best_is_marked_and_wrong_or_unchecked_ones_are_not(measured: Measured) -> None:
    speed = tables.speed(measured)
    cells = dict(zip(speed.columns[1:], row(speed, 'box')[1:]))
    assert {kernel for kernel, cell in cells.items() if cell.is_best} == {'funky-kd'}
    assert (cells['funky-kd'].text, cells['funky-kd'].error) == ('10', '')
    assert (cells['liar'].text, cells['liar'].error) == ('77', '42 ppm wrong')
    assert (cells['broken'].text, cells['broken'].error) == ('', 'crashed')
    assert (cells['shy'].text, cells['shy'].error) == ('66', 'answers not checked')


def test_no_speed_of_a_wrong_kernel_is_without_its_errors(measured: Measured) -> None:
    rates = ['77', '96.', '154', '308', '192', '231',  # gross, and the replayed ones
             '38.5', '48.1', '57.8']                   # on one thread
    shown = [(cells[0], cell) for table in all_tables(measured) for cells in table.rows
             for cell in cells[1:] if cell.value is not None
             and 'liar' in (cells[0].text, table.columns[cells.index(cell)])
             and any(cell.text.startswith(rate) for rate in rates)]
    assert len(shown) >= 9
    assert all('42 ppm wrong' in (name.error, cell.error) for name, cell in shown)


def test_a_wrong_kernel_has_no_means_and_no_break_even(measured: Measured) -> None:
    liar = texts(row(tables.kernels(measured), 'liar'))
    assert liar == ['liar', *['\u2013'] * 9, '42', '1']
    columns = tables.break_even(measured).columns
    assert row(tables.break_even(measured), 'box')[columns.index('liar')].text == '\u2013'


def test_means_of_good_kernels(measured: Measured) -> None:
    cells = texts(row(tables.kernels(measured), 'simple-bvh'))
    assert cells[0] == 'simple-bvh'
    assert cells[3:8] == ['0.5'] * 5          # rays, h, V, h and V, in flight
    assert cells[8:] == ['1', '1', '0', '0']  # memory, wrong answers, failures


def test_answers_table(measured: Measured) -> None:
    table = tables.answers(measured, 'box')
    by_name = dict(zip(table.columns, row(table, 'liar')))
    assert {name: by_name[name].text for name in ['questions', 'missed', 'ghost', 'tie']} == {
        'questions': '1000000', 'missed': '30', 'ghost': '0', 'tie': '5'}
    assert [name for name, cell in by_name.items() if cell.error] == ['missed', 'false visible']
    assert row(table, 'broken')[1].error == 'crashed'
    assert row(table, 'shy')[1].error == 'timed out'


def test_failures_have_their_messages(measured: Measured) -> None:
    assert set(failures(measured)) == {
        ('box', 'broken', 'render: crashed', 'SIGSEGV'),
        ('box', 'broken', 'replay: crashed', 'SIGSEGV'),
        ('box', 'shy', 'replay: timed out', 'after 9 s'),
        ('box', 'liar', 'wrong answers', '30 missed, 12 false visible of 1000000')}
    assert [texts(cells) for cells in tables.failure_table(measured).rows] == [
        list(cells) for cells in failures(measured)]


def test_the_control_tells_the_noise(measured: Measured) -> None:
    table = tables.control(measured)
    assert texts(row(table, 'box'))[:3] == ['box', 'funky-kd', '+0.50 %']
    assert texts(row(table, 'noise'))[2] == '0.50 %'


@pytest.mark.parametrize('build, rate, text', [
    (3, 20, 'from 40M on'), (0.5, 5, 'up to 5M'), (0.5, 20, 'always'), (3, 5, 'never')])
def test_break_even(tmp_path: Path, build: float, rate: float, text: str) -> None:
    stored = Stored(tmp_path)
    stored.run('box', 'funky-kd', rate=10, report={'time.initialize_s': 1})
    stored.run('box', 'other', rate=rate, report={'time.initialize_s': build})
    assert texts(row(tables.break_even(stored.measured()), 'box')) == ['box', '\u2013', text]


def test_average_intensity_beside_its_reference(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.run('box', 'a', report={'average_intensity': [0.26, 0, 0],
                                   'standard_error': [0.004, 0, 0],
                                   'reference_average_intensity': [0.25, 0, 0]})
    stored.run('box', 'b', report={'standard_error': [None] * 3,
                                   'reference_average_intensity': None})
    table = tables.intensity(stored.measured(), 'box')
    assert texts(row(table, 'a'))[1:5] == ['0.260000000', '0.004', '0.250000000', '+2.50']
    assert texts(row(table, 'b'))[2:5] == ['\u2013'] * 3


# ---- Kernels alone ------------------------------------------------------------------------------


@pytest.fixture(scope='module')
def alone(tmp_path_factory: pytest.TempPathFactory) -> Measured:
    """On a machine that drifts by a tenth from repeat to repeat; the peer answers wrongly on hall.

    Rates on one thread are a quarter of those on four.
    """
    stored = Stored(tmp_path_factory.mktemp('results'))
    speeds = {('box', 'fast'): 30, ('hall', 'fast'): 90, ('box', 'peer'): 20, ('hall', 'peer'): 30}
    for scene, liar in [('box', {}), ('hall', {'missed': 3})]:
        stored.benchmark([scene], ['funky-kd', 'fast', 'peer'], control=None,
                         answers={'peer': liar}, rates=lambda scene, kernel, repeat:
                         speeds.get((scene, kernel), 10) * (1 - repeat / 10))
    return Measured(stored.measured().results, peers=['peer', 'missing'])


@pytest.mark.parametrize('threads, title, mixed', [
    (1, 'Kernels alone, one thread: ', '15 (13.1\u201316.9)'),
    (4, 'Kernels alone, 4 threads: ', '60 (52.5\u201367.5)')])
def test_rates_and_ratios_of_kernels_alone(alone: Measured, threads: int, title: str,
                                           mixed: str) -> None:
    table = tables.alone(alone, 'box', threads)
    assert table.title.startswith(title) and table in tables.of_scene(alone, 'box')
    by_name = dict(zip(table.columns, texts(row(table, 'fast'))))
    assert by_name['build s'] == '0.001 (0.001\u20130.001)'
    assert by_name['mixed'] == mixed
    assert (by_name['peak B/tri.'], by_name['final B/tri.']) == ('200', '100')
    assert texts(row(table, 'fast'))[8:] == 2 * ['1.50 (1.50\u20131.50)']
    assert texts(row(table, 'peer'))[8:] == 2 * ['1.00 (1.00\u20131.00)']
    assert texts(row(table, 'funky-kd'))[8:] == 2 * ['0.50 (0.50\u20130.50)']
    assert [cells[0].text for cells in table.rows if cells[6].is_best] == ['fast']
    assert 'the peer is peer (mixed), peer (in flight)' in table.note


def test_a_peer_that_answers_wrongly_is_a_measure_but_has_no_ratio(alone: Measured) -> None:
    table = tables.alone(alone, 'hall', 4)
    assert [texts(cells)[8] for cells in table.rows] == [
        '0.33 (0.33\u20130.33)', '3.00 (3.00\u20133.00)', '\u2013']
    assert 'the peer is peer (mixed)' in table.note
    assert [cells[0].error for cells in table.rows] == ['', '', '3 ppm wrong']
    means = tables.by_peer(alone, 4)
    assert texts(row(means, 'fast'))[1] == '2.12 (1.50 box\u20133.00 hall)'
    assert texts(row(means, 'peer'))[1] == '1.00 [1] (1.00 box\u20131.00 box)'


def test_means_of_ratios_name_the_scenes_of_the_least_and_the_greatest(alone: Measured) -> None:
    """Relative to funky-kd: 3 on box, 9 on hall."""
    measured = Measured(alone.results)
    one, all_threads = (tables.by_peer(measured, threads) for threads in (1, 4))
    assert texts(row(one, 'fast')) == ['fast', *2 * ['5.20 (3.00 box\u20139.00 hall)']]
    assert texts(row(all_threads, 'fast')) == texts(row(one, 'fast'))
    assert tables.summary(measured)[2:] == [one, all_threads]
    assert [table.title.partition(':')[0] for table in [one, all_threads]] == [
        'Kernels alone, one thread', 'Kernels alone, 4 threads']


def test_scaling(alone: Measured) -> None:
    assert [texts(cells) for cells in tables.scaling(alone).rows] == [
        [scene, '4.00', '4.00', '4.00'] for scene in ['box', 'hall']]


def test_without_replays_there_are_no_tables_of_kernels_alone(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark(replays=False)
    assert not [table for table in all_tables(stored.measured())
                if 'alone' in table.title and table.rows]


def test_one_thread_is_not_shown_twice(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    for repeat in (1, 2):
        stored.run('box', 'a', REPLAY, repeat=repeat, threads=1, all_threads=1)
    titles = [table.title for table in all_tables(stored.measured())
              if 'alone' in table.title and table.rows]
    assert [title.partition(':')[0] for title in titles] == 2 * ['Kernels alone, one thread']


# ---- CSV ----------------------------------------------------------------------------------------


def test_csv_has_a_row_for_each_run(measured: Measured) -> None:
    rows = list(csv.DictReader(io.StringIO(write_csv(measured))))
    assert [(r['scene'], r['kernel'], r['kind'], int(r['threads']), int(r['repeat']), r['status'])
            for r in rows] == [(x.scene, x.kernel, x.kind, x.threads, x.repeat, x.status)
                               for x in measured.results]
    rates = {(r['kernel'], r['kind'], r['repeat']): r['rate [Mrays/s]'] for r in rows}
    assert float(rates['funky-kd', 'render', '2']) == pytest.approx(10.1)
    assert rates['broken', 'render', '1'] == ''
    replays = {(r['kernel'], r['threads'], r['repeat']): r for r in rows if r['kind'] == 'replay'}
    assert len(replays) == 3 * 2 * 3 + 2
    for threads, rate in [('1', 6.25), ('4', 25)]:
        of_one = replays['funky-kd', threads, '1']
        assert float(of_one['mixed [Mrays/s]']) == pytest.approx(rate)
        assert float(of_one['initialize [s]']) == pytest.approx(0.001)
        assert float(of_one['peak_per_triangle [bytes]']) == 200
        assert of_one['rate [Mrays/s]'] == of_one['total [s]'] == ''
    assert {r['wrong_per_million'] for r in rows if r['kernel'] == 'liar'} == {'42.0'}
    assert {r['message'] for r in rows if r['kernel'] == 'broken'} == {'SIGSEGV'}


@pytest.mark.parametrize('message', ['a,b', 'say "no"', 'two\nlines', 'é 日 \udcff', ';=1+1'])
def test_csv_keeps_odd_texts_whole(tmp_path: Path, message: str) -> None:
    stored = Stored(tmp_path)
    stored.run('odd, "name"', 'a', status='crashed', message=message)
    row, = csv.DictReader(io.StringIO(write_csv(stored.measured())))
    assert (row['scene'], row['message']) == ('odd, "name"', message)


# ---- Two sets -----------------------------------------------------------------------------------


@pytest.fixture
def here(tmp_path: Path) -> Stored:
    return Stored(tmp_path / 'here')


@pytest.fixture
def there(tmp_path: Path) -> Stored:
    return Stored(tmp_path / 'there')


def lines(here: Stored, there: Stored, figure: str = 'Rays, gross') -> list[list[str]]:
    """Of that figure: kernel, medians, ratio and verdict."""
    text = compare(here.measured(), there.measured())
    return [line.split(maxsplit=1)[1].replace(figure + ' Mrays/s', '').split()
            for line in text.splitlines() if figure in line]


def test_comparison_tells_ratio_and_whether_it_exceeds_the_noise(here: Stored,
                                                                 there: Stored) -> None:
    kernels = ['simple-bvh', 'funky-kd', 'third']
    here.benchmark(kernels=kernels, rates={'simple-bvh': 12, 'funky-kd': 10, 'third': 4})
    there.benchmark(kernels=kernels, rates={'simple-bvh': 10, 'funky-kd': 10.1, 'third': 5})
    assert lines(here, there) == [['simple-bvh', '12', '10', '1.200', 'better'],
                                  ['funky-kd', '10', '10.1', '0.990', 'equal'],
                                  ['third', '4', '5', '0.800', 'worse']]
    assert compare(here.measured(), there.measured()).endswith(
        'noise of rays per second: 0.5 % here, 0.5 % there')


def test_comparison_calls_less_time_better(here: Stored, there: Stored) -> None:
    here.run('box', 'a', report={'time.total_s': 5})
    there.run('box', 'a', report={'time.total_s': 10})
    verdicts = [line for line in compare(here.measured(), there.measured()).splitlines()
                if 'Total running time' in line]
    assert len(verdicts) == 1 and verdicts[0].split()[-2:] == ['0.500', 'better']


def test_comparison_names_wrong_answers_beside_speed(here: Stored, there: Stored) -> None:
    here.benchmark(kernels=['simple-bvh', 'a', 'b'], rates={'a': 99}, answers={
        'a': {'missed': 7}})
    there.benchmark(kernels=['simple-bvh', 'a', 'b'], answers={'b': {'ghost': 9}})
    assert lines(here, there)[1:] == [
        ['a', '99', '10', '9.900', 'wrong', 'answers', 'here'],
        ['b', '10', '10', '1.000', 'wrong', 'answers', 'there']]


def test_comparison_of_different_extents_says_so(here: Stored, there: Stored) -> None:
    here.benchmark()
    there.benchmark(bench={'fingerprint.passes': 4})
    text = compare(here.measured(), there.measured())
    assert 'the two sets differ in passes' in text
    assert 'differ in' not in compare(here.measured(), here.measured())


def test_comparison_of_what_has_nothing_in_common(here: Stored, there: Stored) -> None:
    here.run('box', 'a')
    there.run('hall', 'a')
    there.run('box', 'b')
    assert compare(here.measured(), there.measured()) == (
        'the two sets have no kernel and scene in common')
