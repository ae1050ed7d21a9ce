# SPDX-License-Identifier: GPL-3.0-only
"""Includes point only downwards in the list of layers, and foreign libraries stay where they are."""

import re
import subprocess
from pathlib import Path

import pytest

from program import REPOSITORY

SOURCES = REPOSITORY / 'src'
LAYERS = ['math', 'scene', 'kernel', 'film', 'render', 'report', 'app', 'tools']
KERNELS = sorted(path.name for path in (SOURCES / 'kernel').iterdir() if path.is_dir())

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
KERNEL_SEES = r'math/\w+\.h|kernel/\w+\.h|scene/Triangle\.h'


def source_files(folder: Path) -> list[Path]:
    return [path for path in sorted(folder.rglob('*')) if path.suffix in ('.h', '.cpp')]


def includes(path: Path, bracket: str) -> list[str]:
    """What the file includes from the project ('"') or from elsewhere ('<')."""
    return [name for found, name in INCLUDE.findall(path.read_text()) if found == bracket]


def layer_of(path: Path) -> str:
    return path.relative_to(SOURCES).parts[0]


def all_sources() -> list[Path]:
    return [path for layer in LAYERS for path in source_files(SOURCES / layer)]


def test_every_source_file_lies_in_a_layer() -> None:
    strangers = {layer_of(path) for path in source_files(SOURCES)} - {*LAYERS, 'test'}
    assert strangers == set()
    assert len(all_sources()) > 30


def test_includes_of_the_project_begin_with_a_layer_and_exist() -> None:
    wrong = [(str(path), name) for path in all_sources() for name in includes(path, '"')
             if name.split('/')[0] not in LAYERS or not (SOURCES / name).is_file()]
    assert wrong == []


def test_includes_point_only_downwards() -> None:
    wrong = [(str(path), name) for path in all_sources() for name in includes(path, '"')
             if LAYERS.index(name.split('/')[0]) > LAYERS.index(layer_of(path))]
    assert wrong == []


def test_the_interface_of_kernels_sees_only_math_and_triangles() -> None:
    files = [path for path in (SOURCES / 'kernel').iterdir() if path.suffix in ('.h', '.cpp')]
    wrong = [(path.name, name) for path in files for name in includes(path, '"')
             if not re.fullmatch(KERNEL_SEES, name)]
    assert wrong == []
    assert any(name == 'scene/Triangle.h' for path in files for name in includes(path, '"'))


@pytest.mark.parametrize('kernel', KERNELS)
def test_a_kernel_sees_only_its_own_folder_and_the_interface(kernel: str) -> None:
    files = source_files(SOURCES / 'kernel' / kernel)
    wrong = [(path.name, name) for path in files for name in includes(path, '"')
             if not re.fullmatch(rf'{KERNEL_SEES}|kernel/{re.escape(kernel)}/[\w/]+\.h', name)]
    assert wrong == []
    assert any('kernel/RTKernel.h' in includes(path, '"') for path in files)


@pytest.mark.parametrize('kernel', KERNELS)
def test_a_kernel_has_a_readme_whose_first_line_says_what_it_is(kernel: str) -> None:
    readme = SOURCES / 'kernel' / kernel / 'README'
    assert len(readme.read_text().splitlines()[0].split()) > 1


@pytest.mark.parametrize('library, layer', [
    (r'xxhash\.h', 'scene'), (r'OpenEXR/.*|Imf\w*\.h|Iex\w*\.h', 'film'),
    (r'png\.h|libpng.*', 'film'), (r'SDL.*', 'app'), (r'assimp/.*', 'tools'),
    (r'embree.*', 'kernel'),
])
def test_a_foreign_library_is_included_in_one_layer_only(library: str, layer: str) -> None:
    users = {layer_of(path) for path in all_sources() for name in includes(path, '<')
             if re.fullmatch(library, name)}
    assert users <= {layer}


def test_no_file_of_the_project_names_a_folder_of_a_certain_machine() -> None:
    listing = subprocess.run(['git', 'ls-files', '-z'], cwd=REPOSITORY, capture_output=True,
                             text=True, check=False)
    if listing.returncode != 0:
        pytest.skip(f'no list of files from git: {listing.stderr.strip()}')
    machine_path = re.compile(r'\.\./shared|(?<![\w.~/-])/(home|root|work|mnt|Users)/\w')
    files = [REPOSITORY / name for name in listing.stdout.split('\0') if name and name != '.ci/run']
    wrong = [str(path.relative_to(REPOSITORY)) for path in files if path.is_file()
             and path.suffix != '.png' and machine_path.search(path.read_text(errors='replace'))]
    assert wrong == []
