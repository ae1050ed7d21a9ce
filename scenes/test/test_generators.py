# SPDX-License-Identifier: GPL-3.0-only
"""The generators of the standard scenes, mostly at a small scale."""

import hashlib
import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

SCENES = Path(__file__).resolve().parent.parent
GENERATORS = sorted(SCENES.glob('*.py'))
SCALABLE = [path for path in GENERATORS if path.stem != 'cornell']
SUMS = SCENES / 'SHA256SUMS'
# What numpy computes with AVX2 or AVX-512 may differ in the last bit from what it computes without.
PLAIN_PROCESSOR = {'NPY_DISABLE_CPU_FEATURES':
                   'AVX2 FMA3 AVX512F AVX512CD AVX512_SKX AVX512_CLX AVX512_CNL AVX512_ICL'}
NOT_PORTABLE = re.compile(
    r'\bnp\.(a?(sin|cos|tan)h?|arc\w+|exp\w*|log\w*|power|float_power|hypot|cbrt|dot|vdot|inner|'
    r'matmul|einsum|tensordot|cross|sum|mean|std|var|average|linalg|fft|random(?!\.RandomState))\b|'
    r'\.(sum|mean|std|var)\(|(?<!vectors)\.dot\(| @ |'
    r'\bmath\.(?!(pi|inf|sqrt|factorial|ceil|floor)\b)')


def generate(generator: Path, base: Path, *options: str, **environment: str) -> np.ndarray:
    """The triangles that a generator writes."""
    subprocess.run(['/usr/bin/python3', generator, base, *options], check=True, timeout=300,
                   capture_output=True, env=os.environ | environment)
    return read(base)


def read(base: Path) -> np.ndarray:
    return np.fromfile(f'{base}.ra2', '<f4').reshape(-1, 3, 3)


def lights(base: Path) -> list[list[float]]:
    """First and last triangle and exitance of each light of a scene file."""
    text = Path(f'{base}.scene').read_text(encoding='utf-8')
    words = re.search(r'^lights (.*)$', text, re.M).group(1).split()
    assert len(words) == 1 + 3 * int(words[0])
    return [[float(word) for word in words[i:i + 3]] for i in range(1, len(words), 3)]


@pytest.mark.parametrize('generator', GENERATORS, ids=lambda path: path.stem)
def test_the_standard_scene_is_the_published_one(generator: Path) -> None:
    base = generator.with_suffix('')
    if not base.with_suffix('.ra2').exists():
        pytest.skip(f'{base.name}.ra2 is not there: scons scenes')
    sums = dict(reversed(line.split()) for line in SUMS.read_text(encoding='utf-8').splitlines())
    content = base.with_suffix('.ra2').read_bytes()
    assert hashlib.sha256(content).hexdigest() == sums[f'{base.name}.ra2']


@pytest.mark.parametrize('generator', SCALABLE, ids=lambda path: path.stem)
def test_every_processor_and_every_run_give_the_same_bytes(generator: Path, tmp_path: Path) -> None:
    first = generate(generator, tmp_path / 'first', '--scale', '1e4')
    second = generate(generator, tmp_path / 'second', '--scale', '1e4', **PLAIN_PROCESSOR)
    assert first.tobytes() == second.tobytes()
    assert 9_000 < len(first) < 11_000


@pytest.mark.parametrize('scale', [1e3, 1e5])
@pytest.mark.parametrize('generator', SCALABLE, ids=lambda path: path.stem)
def test_a_scene_of_another_scale_is_the_same_scene(generator: Path, scale: float,
                                                    tmp_path: Path) -> None:
    triangles = generate(generator, tmp_path / 'scaled', '--scale', str(scale))
    assert 0.9 * scale < len(triangles) < 1.1 * scale
    smaller = generate(generator, tmp_path / 'smaller', '--scale', '2e3')
    assert lights(tmp_path / 'scaled') == lights(tmp_path / 'smaller')
    last = int(lights(tmp_path / 'scaled')[-1][1])
    assert np.array_equal(triangles[:last + 1], smaller[:last + 1])
    size = np.ptp(triangles.reshape(-1, 3), axis=0)
    assert np.ptp(smaller.reshape(-1, 3), axis=0) == pytest.approx(size, rel=0.2)


@pytest.mark.parametrize('generator', SCALABLE, ids=lambda path: path.stem)
def test_coordinates_are_finite_and_leave_room_for_the_offset_of_rays(generator: Path,
                                                                      tmp_path: Path) -> None:
    triangles = generate(generator, tmp_path / 'scene', '--scale', '1e4')
    assert np.abs(triangles).max() <= 100


@pytest.mark.parametrize('source', [path for path in SCENES.rglob('*.py')
                                    if path.parent.name != 'test'],
                         ids=lambda path: str(path.relative_to(SCENES)))
def test_generators_use_no_function_whose_last_bit_depends_on_the_machine(source: Path) -> None:
    code = re.sub(r'""".*?"""|#[^\n]*', '', source.read_text(encoding='utf-8'), flags=re.S)
    assert not NOT_PORTABLE.search(code), NOT_PORTABLE.search(code)


def test_a_folder_that_is_missing_is_one_line(tmp_path: Path) -> None:
    result = subprocess.run(['/usr/bin/python3', SCENES / 'cornell.py', tmp_path / 'no' / 'x'],
                            capture_output=True, text=True, check=False)
    assert result.returncode == 1
    assert result.stderr == f'cornell.py: {tmp_path}/no/x: No such file or directory\n'


@pytest.mark.parametrize('scale', ['0', '999', '2e7', 'nan', 'many'])
def test_a_scale_beyond_the_range_is_a_usage_error(scale: str, tmp_path: Path) -> None:
    result = subprocess.run(['/usr/bin/python3', SCALABLE[0], tmp_path / 'x', '--scale', scale],
                            capture_output=True, text=True, check=False)
    assert result.returncode == 2
    assert 'number of triangles' in result.stderr.splitlines()[-1]
    assert list(tmp_path.iterdir()) == []
