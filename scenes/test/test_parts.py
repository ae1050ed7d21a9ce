# SPDX-License-Identifier: GPL-3.0-only
"""Parts of the standard scenes that have to be closed."""

import numpy as np
import pytest

import statue
from edges import open_edges
from stadium_parts.teapot import teapot
from statue_parts.owl import owl


@pytest.mark.parametrize('detail', [0.005, 0.02, 0.1])
def test_the_statue_is_closed(detail: float) -> None:
    mesh = owl(statue.SPACING / detail**0.5)
    assert len(mesh) > 1000
    assert open_edges(mesh) == 0


def test_the_teapot_is_open_only_where_its_patches_end() -> None:
    segments = 8
    rims = 2 * 4 * segments  # of body and lid, four patches around
    ends = 4 * 2 * segments  # of handle and spout, two patches around
    assert open_edges(teapot(segments)) == rims + ends


def test_the_teapot_has_its_published_size() -> None:
    low, high = (f(teapot(8).reshape(-1, 3), axis=0) for f in (np.min, np.max))
    assert low == pytest.approx((-3, 0, -2))
    assert high == pytest.approx((3.434, 3.15, 2), abs=1e-3)
