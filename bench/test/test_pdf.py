# SPDX-License-Identifier: GPL-3.0-only
"""Any results make a valid PDF."""

import csv
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

import pytest

import style
from fakes import clean_environment, text_of
from latex import fitting
from overallfigures import geometric_means
from plan import CONTROL, REPLAY
from report import write_report
from stored import Stored
from tables import Cell, Table

ODD_SCENE = '50%_a&b #1 {x} $y ~z^ <t>|u "q" \\s é ß'
ODD_KERNEL = 'k:a=%_&#,b=${}~^<>|"\\ ü'
ODD_MESSAGE = '\x1b[31m%_&#${}~^<>|"\\ \u65e5\u672c\x00\ttab ' + 'x' * 280
EIGHT = ['simple-bvh', 'funky-kd', 'wide-bvh', 'embree', 'embree:quality=high,robust=1',
         'a-kernel-with-a-long-name', 'seventh', 'eighth']


def odd_names(stored: Stored) -> None:
    stored.benchmark([ODD_SCENE], ['simple-bvh', ODD_KERNEL],
                     answers={ODD_KERNEL: {'missed': 3}}, scaling=[ODD_SCENE])
    stored.run(ODD_SCENE, 'b_r%o&k#e n', status='crashed', message=ODD_MESSAGE)
    stored.run('\u65e5\u672c \udcff', 'simple-bvh', exposure=None)


def one_run(stored: Stored) -> None:
    """One scene, one kernel, one repeat of one pass; no control, no replay, no reference."""
    stored.run('box', 'lonely', exposure=None, report={
        'reference_average_intensity': None, 'standard_error': [None] * 3,
        'squared_error': 0.1876})


def all_failed(stored: Stored) -> None:
    for scene in ['box', 'hall']:
        for kernel in ['simple-bvh', 'funky-kd']:
            stored.run(scene, kernel, status='crashed', message='SIGSEGV')
            stored.run(scene, kernel, CONTROL, status='timed out', message='after 9 s')
            stored.run(scene, kernel, REPLAY, status='not made',
                       message='simple-bvh recorded no rays')


def no_replay(stored: Stored) -> None:
    """Nor a control, nor a reference for the average intensity; and a kernel that fails later."""
    stored.benchmark(['box'], ['a', 'b'], control=None, replays=False, report={
        'reference_average_intensity': None, 'squared_error': 0.1876})
    stored.run('box', 'broken', repeat=1, exposure=None)
    stored.run('box', 'broken', repeat=2, status='timed out', message='after 1800 s')


def zeros(stored: Stored) -> None:
    """A kernel that needs no time and no memory, and a scene without light."""
    stored.benchmark(['dark'], report={
        'time.initialize_s': 0, 'memory.kernel_peak_bytes': 0, 'memory.kernel_final_bytes': 0,
        'average_intensity': [0, 0, 0], 'standard_error': [0, 0, 0], 'squared_error': 0,
        'reference_average_intensity': [0, 0, 0]}, growth=[1000])


def eight_kernels(stored: Stored) -> None:
    stored.benchmark(['box', 'hall', 'conference'], EIGHT, scaling=['conference'],
                     growth=[1000, 10000, 100000], answers={'seventh': {'false_occluded': 5}},
                     rates={kernel: 3 + 2 * number for number, kernel in enumerate(EIGHT)})


@dataclass(frozen=True)
class Report:
    """Files of a report, and the text of the PDF."""

    base: Path
    text: str
    csv: str

    @property
    def one_line(self) -> str:
        """The text without any blanks: lines may break anywhere."""
        return ''.join(self.text.split())

    def shows(self, *texts: str) -> bool:
        missing = [text for text in texts if ''.join(text.split()) not in self.one_line]
        assert not missing, (missing, self.text[:3000])
        return True


@contextmanager
def environment(**variables: str) -> Iterator[None]:
    """Restored afterwards: write_report() sets the date for LaTeX."""
    with mock.patch.dict(os.environ, clean_environment(**variables), clear=True):
        yield


@pytest.mark.parametrize('columns, parts', [(1, [1]), (4, [4]), (5, [3, 2]), (8, [4, 4]),
                                            (9, [3, 3, 3])])
def test_wide_tables_are_split_into_parts_of_about_the_same_width(columns: int,
                                                                  parts: list[int]) -> None:
    """Besides the first column of 10 characters there is room for four columns of 25."""
    names = [f'{letter:25}' for letter in 'abcdefghi'[:columns]]
    whole = Table('wide', ['0123456789', *names], [[Cell(name) for name in ['kernel', *names]]])
    tables = fitting(whole)
    assert [table.columns[0] for table in tables] == len(parts) * ['0123456789']
    assert [len(table.columns) - 1 for table in tables] == parts
    assert [name for table in tables for name in table.columns[1:]] == names
    assert [cell.text for table in tables for cell in table.rows[0][1:]] == names


def test_every_standard_kernel_has_a_style_of_its_own() -> None:
    counts = {len(styles) for styles in [style.COLOURS, style.HATCHES, style.MARKERS,
                                         style.LINES]}
    assert counts == {len(set(style.COLOURS))} and min(counts) >= 10


def test_graphs_that_do_not_fill_their_rows_leave_the_rest_empty(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark()
    figure = geometric_means(stored.measured())
    assert figure
    assert [axes.axison for axes in figure.axes] == 9 * [True] + [False]


Reports = Callable[[Callable[[Stored], None]], Report]


@pytest.fixture(scope='module')
def reports(tmp_path_factory: pytest.TempPathFactory) -> Reports:
    """Makes each report once."""
    made: dict[str, Report] = {}

    def report(fill: Callable[[Stored], None]) -> Report:
        if fill.__name__ not in made:
            folder = tmp_path_factory.mktemp(fill.__name__)
            stored = Stored(folder / 'results')
            fill(stored)
            base = folder / 'report'
            with environment(), mock.patch('report.write_html', return_value=b''):  # takes long
                paths = write_report(stored.measured(), base)
            assert base.with_suffix('.pdf') in paths and base.with_suffix('.csv') in paths
            assert {path.name for path in folder.iterdir()} == {'results', 'report.pdf',
                                                                'report.csv', 'report.html'}
            made[fill.__name__] = Report(base, text_of(base.with_suffix('.pdf')),
                                         base.with_suffix('.csv').read_text(errors='replace'))
        return made[fill.__name__]
    return report


def test_odd_names_are_shown_as_they_are(reports: Reports) -> None:
    report = reports(odd_names)
    assert report.shows(ODD_SCENE, ODD_KERNEL, 'b_r%o&k#e n', '3 ppm wrong')
    assert report.shows('?[31m%_&#${}~^<>|"\\ ???', '?? ?')


def test_a_single_run(reports: Reports) -> None:
    report = reports(one_run)
    assert report.shows('lonely', '1 repeat,', 'There is no control', 'Too few repeats: 1',
                        'The answers of lonely were not checked on box.', '0.188',
                        'for want of a reference')


def test_all_failed(reports: Reports) -> None:
    report = reports(all_failed)
    assert report.shows('Failures', 'SIGSEGV', 'render: crashed', 'control: timed out',
                        'replay: not made', 'simple-bvh recorded no rays')
    assert len(report.csv.splitlines()) == 1 + 12


def test_no_replay_no_control_no_reference(reports: Reports) -> None:
    report = reports(no_replay)
    assert report.shows('There is no control', 'The answers of a were not checked on box.',
                        'not replayed', 'for want of a reference', 'broken',
                        'render: timed out', 'after 1800 s')


def test_no_time_no_memory_no_light(reports: Reports) -> None:
    assert reports(zeros).shows('dark', 'simple-bvh', 'funky-kd')


def test_eight_kernels_on_three_scenes(reports: Reports) -> None:
    report = reports(eight_kernels)
    assert report.shows(*EIGHT, 'box', 'hall', 'conference', '5 ppm wrong', 'Failures',
                        '5 false occluded of 1000000', 'Thread scaling', 'Growth',
                        'Break-even', 'Warnings')
    rows = list(csv.DictReader(report.csv.splitlines()))
    assert len(rows) == 3 * (3 * 9 + 2 * 8 + 3 * 8) + 3 * (1 + 3 * 2 * 8)


def test_a_wrong_kernel_is_not_shown_as_the_best(reports: Reports) -> None:
    """Each speed of it in the tables of rates has its errors behind it."""
    text = reports(eight_kernels).text
    assert '15 5 ppm wrong' in text
    assert '17' in text
