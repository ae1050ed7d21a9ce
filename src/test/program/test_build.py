# SPDX-License-Identifier: GPL-3.0-only
"""The build: options are checked, and a kernel is added by copying a folder."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


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


def test_a_copied_kernel_folder_builds_and_conforms_without_an_edit(tmp_path: Path) -> None:
    copy = tmp_path / 'bwfirt'
    # copy2 keeps the times of files, and with them what is already built.
    shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns('.git', 'results'))
    shutil.copytree(copy / 'src/kernel/yourkernel', copy / 'src/kernel/my-kernel')

    assert 'my-kernel' in scons(copy, '-h').stdout
    built = scons(copy, 'kernel=my-kernel', 'build/bwfirt-my-kernel',
                  'build/test/conformance-my-kernel')
    assert built.returncode == 0, built.stdout + built.stderr
    version = subprocess.run([copy / 'build/bwfirt-my-kernel', '--version'], capture_output=True,
                             text=True, check=True)
    assert version.stdout.startswith('bwfirt-my-kernel ')
    subprocess.run([copy / 'build/test/conformance-my-kernel', '--gtest_brief=1'], check=True,
                   capture_output=True)
