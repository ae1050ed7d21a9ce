# SPDX-License-Identifier: GPL-3.0-only
"""Which of the stored results count, and how they are written."""

from pathlib import Path

import pytest

from plan import CONTROL, REPLAY
from results import ENDINGS, ResultsError, locked, read_results, write_result
from stored import Stored

NEW = {'fingerprint.program': 'sha-of-a-new-one'}


@pytest.fixture
def stored(tmp_path: Path) -> Stored:
    stored = Stored(tmp_path)
    stored.benchmark()
    return stored


def kinds(stored: Stored) -> list[tuple[str, str, int]]:
    return sorted((result.kernel, result.kind, result.repeat)
                  for result in read_results(stored.folder) if result.kind != 'record')


ONE_AND_ALL = 2 * [1] + 2 * [2] + 2 * [3]  # repeats of replays
UNTOUCHED = [('simple-bvh', 'render', 1), ('simple-bvh', 'render', 2), ('simple-bvh', 'render', 3),
             *(('simple-bvh', 'replay', repeat) for repeat in ONE_AND_ALL)]


@pytest.mark.parametrize('kind', ['render', CONTROL, REPLAY])
def test_results_of_an_older_kernel_do_not_count(stored: Stored, kind: str) -> None:
    """Neither its repeats nor its control, and least of all its answers."""
    stored.run('box', 'funky-kd', kind, bench=NEW)
    assert kinds(stored) == [('funky-kd', kind, 1)] + UNTOUCHED


def test_results_with_older_options_do_not_count_for_their_kind(stored: Stored) -> None:
    stored.run('box', 'funky-kd', bench={'fingerprint.passes': 99})
    assert kinds(stored) == [('funky-kd', 'render', 1), *(
        ('funky-kd', 'replay', repeat) for repeat in ONE_AND_ALL)] + UNTOUCHED


def test_a_failure_of_the_newest_kernel_replaces_what_an_older_one_did(stored: Stored) -> None:
    stored.run('box', 'funky-kd', status='crashed', bench=NEW)
    assert kinds(stored) == [('funky-kd', 'render', 1)] + UNTOUCHED
    assert stored.measured().first('box', 'funky-kd') is None


def test_results_are_in_the_order_of_their_making(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    for scene, kernel in [('b', 'z'), ('a', 'y'), ('c', 'x')]:
        stored.run(scene, kernel)
    assert [result.scene for result in read_results(tmp_path)] == ['b', 'a', 'c']


def test_no_folder_is_no_result(tmp_path: Path) -> None:
    assert read_results(tmp_path / 'missing') == []


def test_a_result_replaces_all_files_of_an_older_one(stored: Stored, tmp_path: Path) -> None:
    path = stored.folder / 'box/funky-kd/render-4-threads-1'
    bench = stored.run('box', 'funky-kd').bench
    unfinished = tmp_path / 'unfinished'
    (unfinished / 'folder').mkdir(parents=True)
    for name in ['run.txt', 'run.report', 'run.exr.Xb3kZq', 'core', 'folder/file']:
        (unfinished / name).write_text('new')
    write_result(path, {}, bench, unfinished)
    assert list(unfinished.iterdir()) == []
    assert path.with_suffix('.txt').read_text() == 'new'
    assert [ending for ending in ENDINGS if path.with_suffix(ending).exists()] == ['.txt']
    assert {file.suffix for file in path.parent.iterdir()} == {'.json', '.txt'}


def test_a_result_appears_in_one_step_after_its_other_files(
        stored: Stored, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = stored.folder / 'box/funky-kd/render-4-threads-9'
    (tmp_path / 'unfinished').mkdir()
    (tmp_path / 'unfinished' / 'run.txt').write_text('new')
    moved: list[str] = []

    def replace(source: object, target: object) -> None:
        moved.append(Path(str(target)).suffix)
        if moved[-1] == '.json':
            raise KeyboardInterrupt
    monkeypatch.setattr('results.os.replace', replace)
    with pytest.raises(KeyboardInterrupt):
        write_result(path, {}, {}, tmp_path / 'unfinished')
    assert moved == ['.txt', '.json']
    assert not path.with_suffix('.json').exists()


def test_one_at_a_time_holds_the_lock(tmp_path: Path) -> None:
    with locked(tmp_path / 'results') as unfinished:
        assert unfinished.is_dir()
        with pytest.raises(ResultsError, match='measures there'):
            with locked(tmp_path / 'results'):
                pass
        assert unfinished.is_dir()
    with locked(tmp_path / 'results'):
        pass
    assert not unfinished.exists()
