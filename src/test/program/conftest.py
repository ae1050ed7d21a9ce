# SPDX-License-Identifier: GPL-3.0-only
"""Fixtures of the tests that run whole programs.

The executables are those in build/ of the repository, or in the folder that the environment
variable BWFIRT_BUILD names.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest

from box import write_box
from display import Display, virtual_display
from program import BUILD


@pytest.fixture
def program(request: pytest.FixtureRequest) -> Path:
    """The executable of simple-bvh, or of the kernel that the test is parametrised with."""
    path = BUILD / f"bwfirt-{getattr(request, 'param', 'simple-bvh')}"
    if not path.exists():
        pytest.fail(f'{path} is missing: build it with scons')
    return path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with box.scene, box.ra2 and box.camera."""
    write_box(tmp_path)
    return tmp_path


@pytest.fixture(scope='module')
def display(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Display]:
    with virtual_display(tmp_path_factory.mktemp('display')) as opened:
        yield opened
