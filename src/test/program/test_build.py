# SPDX-License-Identifier: GPL-3.0-only
"""The build: options are checked, and a kernel is added by copying a folder."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
PROMISE = 'Misses per million at interiors, edges, vertices:'
KERNEL_INFO = 'build/obj/g++-native/generated/my-kernel/KernelInfo.cpp'


def scons(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(['scons', *arguments], cwd=folder, capture_output=True, text=True,
                          timeout=600, check=False)


@pytest.mark.parametrize('argument, complaint', [
    ('colour=1', "unknown option 'colour'"),
    ('arch=pdp11', 'arch: pdp11'),
    ('debug=maybe', 'maybe'),
    ('sanitize=address,dirt', "'dirt' is none of address, undefined, thread"),
    ('kernel=simple-bvh,no-such', "'no-such' is none of"),
    ('cxx=no-such-compiler', 'there is no such compiler'),
    ('fuzz_seconds=soon', 'expected a whole number'),
    ('sanitize=fuzzer', 'needs cxx=clang++'),
    ('sanitize=thread', 'needs cxx=clang++'),
    ('fuzz', 'needs cxx=clang++ sanitize=fuzzer,address,undefined'),
])
def test_an_unknown_or_unfit_option_or_value_is_refused(argument: str, complaint: str) -> None:
    result = scons(ROOT, argument)
    assert result.returncode == 2
    assert complaint in result.stdout + result.stderr


def test_help_lists_options_targets_and_kernels() -> None:
    text = scons(ROOT, '-h').stdout
    for word in ['debug', 'cxx', 'dvorak', 'frontend', 'kernel', 'arch', 'sanitize', 'scenes',
                 'bench', 'test', 'fuzz', 'simple-bvh', 'funky-kd', 'yourkernel']:
        assert word in text


@pytest.fixture(scope='module')
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the project, with a copy of the template kernel named my-kernel."""
    folder = tmp_path_factory.mktemp('copy') / 'bwfirt'
    # copy2 keeps the times of files, and with them what is already built.
    shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns('.git', 'results', '__pycache__'))
    shutil.copytree(folder / 'src/kernel/yourkernel', folder / 'src/kernel/my-kernel')
    return folder


def test_a_copied_kernel_folder_builds_and_conforms_without_an_edit(copy: Path) -> None:
    assert 'my-kernel' in scons(copy, '-h').stdout
    built = scons(copy, 'kernel=my-kernel', 'build/bwfirt-my-kernel')
    assert built.returncode == 0, built.stdout + built.stderr
    version = subprocess.run([copy / 'build/bwfirt-my-kernel', '--version'], capture_output=True,
                             text=True, check=True)
    assert version.stdout.startswith('bwfirt-my-kernel ')

    tested = scons(copy, 'kernel=my-kernel', 'test')
    assert tested.returncode == 0, tested.stdout + tested.stderr
    assert re.findall('^--- (.*)$', tested.stdout, re.M) == ['conformance-my-kernel']
    assert re.fullmatch(r'[1-9]\d* passed, 0 failed', tested.stdout.splitlines()[-1])


def promising(numbers: str, copy: Path) -> subprocess.CompletedProcess[str]:
    """Builds what the README of my-kernel says about missed rays, after changing it."""
    readme = (ROOT / 'src/kernel/yourkernel/README').read_text()
    assert f'{PROMISE} 0, 0, 0\n' in readme
    (copy / 'src/kernel/my-kernel/README').write_text(
        readme.replace(f'{PROMISE} 0, 0, 0\n', f'{PROMISE} {numbers}\n'))
    return scons(copy, 'kernel=my-kernel', KERNEL_INFO)


def test_what_a_readme_promises_reaches_the_program(copy: Path) -> None:
    result = promising('0, 12.5, 300', copy)
    assert result.returncode == 0, result.stderr
    text = (copy / KERNEL_INFO).read_text()
    assert re.findall(r'::MISSES_AT_\w+ = (.*);', text) == ['0.0', '12.5', '300.0']


@pytest.mark.parametrize('numbers', ['0, 0', '0, 0, -1', '0, 0, few', f'0, 0, 0\n{PROMISE} 0, 0, 9'])
def test_a_promise_that_cannot_be_read_is_refused(numbers: str, copy: Path) -> None:
    result = promising(numbers, copy)
    assert result.returncode == 2
    assert f"my-kernel/README: expected one line like '{PROMISE} 0, 0, 0'" in result.stderr
