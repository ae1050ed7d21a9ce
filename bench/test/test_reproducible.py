# SPDX-License-Identifier: GPL-3.0-only
"""The same results make the same report to the byte, wherever and whenever."""

import subprocess
import sys
from pathlib import Path

import pytest

from fakes import BENCH, clean_environment, text_of
from stored import Stored


def write_in_new_process(results: Path, folder: Path, **variables: str) -> dict[str, bytes]:
    """The files of a report that bench.py writes into another folder, by their endings."""
    folder.mkdir()
    result = subprocess.run(
        [sys.executable, BENCH / 'bench.py', '--report-only', '--results', results, '--output',
         folder / 'report'], cwd=folder, check=False, capture_output=True, text=True,
        env=clean_environment(**variables))
    assert result.returncode == 0, result.stderr
    assert result.stdout.splitlines() == [str(folder / f'report.{ending}')
                                          for ending in ['csv', 'html', 'pdf']]
    return {path.suffix: path.read_bytes() for path in folder.iterdir()}


@pytest.fixture(scope='module')
def written(tmp_path_factory: pytest.TempPathFactory) -> dict[str, dict[str, bytes]]:
    """The report of the same results in two folders, with and without a date from outside."""
    folder = tmp_path_factory.mktemp('same')
    for place in ['here', 'there']:
        Stored(folder / place).benchmark(['box'], answers={'funky-kd': {'missed': 3}})
    return {
        'here': write_in_new_process(folder / 'here', folder / 'a', TZ='Pacific/Auckland'),
        'there': write_in_new_process(folder / 'there', folder / 'other', TZ='UTC',
                                      PYTHONHASHSEED='7', LC_ALL='C'),
        'dated': write_in_new_process(folder / 'here', folder / 'c',
                                      SOURCE_DATE_EPOCH='1000000000'),
    }


@pytest.mark.parametrize('ending', ['.pdf', '.csv', '.html'])
def test_the_same_results_make_the_same_bytes(written: dict[str, dict[str, bytes]],
                                              ending: str) -> None:
    assert len(written['here'][ending]) > 500
    assert written['here'][ending] == written['there'][ending]


def test_the_date_is_that_of_the_last_run(written: dict[str, dict[str, bytes]],
                                          tmp_path: Path) -> None:
    (tmp_path / 'a.pdf').write_bytes(written['here']['.pdf'])
    assert '2026-01-02 03:07 UTC' in text_of(tmp_path / 'a.pdf')


def test_the_date_may_be_given(written: dict[str, dict[str, bytes]], tmp_path: Path) -> None:
    (tmp_path / 'a.pdf').write_bytes(written['dated']['.pdf'])
    assert '2001-09-09 01:46 UTC' in text_of(tmp_path / 'a.pdf')
    assert written['dated']['.csv'] == written['here']['.csv']
