# SPDX-License-Identifier: GPL-3.0-only
"""The made-up results are like measured ones, so that what other tests say of them holds."""

from pathlib import Path

import pytest

from doubts import doubts, failures
from plan import CONTROL, RECORD, RENDER, REPLAY
from stored import ABSENT, Stored, changed


def test_a_benchmark_as_it_comes_is_beyond_doubt(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark(['box', 'hall'], scaling=['box'], growth=[1000, 10000])
    assert doubts(stored.measured()) == []
    assert failures(stored.measured()) == []


def test_a_benchmark_has_all_its_runs(tmp_path: Path) -> None:
    stored = Stored(tmp_path)
    stored.benchmark(['box', 'hall'], scaling=['box'], growth=[1000, 10000])
    kinds = [result.kind for result in stored.measured().results]
    assert {kind: kinds.count(kind) for kind in kinds} == {
        RENDER: 3 * (2 * 2 + 2 * 2 + 2 * 2), CONTROL: 3 * 2, RECORD: 2,
        REPLAY: 3 * 2 * 2 * 2}


def test_keys_are_changed_and_removed() -> None:
    report = {'a': {'b': 1, 'c': 2}, 'd': 3}
    assert changed(report, {'a.b': 5, 'd': ABSENT}) == {'a': {'b': 5, 'c': 2}}
    assert report == {'a': {'b': 1, 'c': 2}, 'd': 3}
    with pytest.raises(KeyError):
        changed(report, {'missing': ABSENT})
