#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Runs test programs and the Python tests side by side; ends with the line 'N passed, N failed'.

usage: run.py [--python-tests PATTERN] [TEST_PROGRAM ...]
"""

import argparse
import importlib.util
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
PYTHON_TESTS = [HERE.parents[1] / 'bench' / 'test', HERE / 'program',
                HERE.parents[1] / 'scenes' / 'test']  # those that take longest begin first


def python_tests(pattern: str) -> list[Path]:
    """The test files whose names match; none for an empty pattern."""
    files = [file for folder in PYTHON_TESTS if pattern for file in sorted(folder.glob(pattern))]
    if pattern and not files:
        sys.exit('run.py: the Python tests are missing')
    return files


def counts(report: Path, status: int) -> tuple[int, int, int]:
    """Passed, failed and skipped of a JUnit report. A run that died counts as one failure."""
    if not report.exists():
        return 0, 1, 0
    suites = ElementTree.parse(report).getroot().iter('testsuite')
    total = failed = skipped = 0
    for suite in suites:
        total += int(suite.get('tests', 0))
        failed += int(suite.get('failures', 0)) + int(suite.get('errors', 0))
        skipped += int(suite.get('skipped', 0))
    if status != 0 and failed == 0:
        failed, total = failed + 1, total + 1
    return total - failed - skipped, failed, skipped


def run(name: str, command: list, report: Path) -> tuple[int, int, int]:
    """Keeps the output together: other tests run at the same time."""
    result = subprocess.run(command, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    sys.stdout.buffer.write(f'--- {name}\n'.encode() + result.stdout)
    sys.stdout.flush()
    return counts(report, result.returncode)


def run_program(program: Path, folder: Path) -> tuple[int, int, int]:
    report = folder / f'{program.name}.xml'
    return run(program.name, [program, '--gtest_brief=1', f'--gtest_output=xml:{report}'], report)


def run_pytest(file: Path, folder: Path) -> tuple[int, int, int]:
    report = folder / f'{file.parent.name}-{file.stem}.xml'
    return run(file.name, [sys.executable, '-m', 'pytest', '-q', '-rs', '-p', 'no:cacheprovider',
                           f'--junitxml={report}', file], report)


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument('programs', nargs='*', type=Path)
    parser.add_argument('--python-tests', default='test_*.py', metavar='PATTERN')
    arguments = parser.parse_args()
    files = python_tests(arguments.python_tests)
    if not files and not arguments.programs:
        sys.exit('run.py: no kernel was built that could be tested')
    if files and importlib.util.find_spec('pytest') is None:
        sys.exit('run.py: pytest is missing: install the Debian package python3-pytest')

    # Under a sanitizer malloc has to refuse too large a request, as it does elsewhere.
    #
    # clang's OpenMP library tells the thread sanitizer, through its tool Archer, how threads wait
    # for each other. It is not instrumented, so that its own memory would look like races.
    os.environ['ASAN_OPTIONS'] = 'allocator_may_return_null=1'
    os.environ['TSAN_OPTIONS'] = 'allocator_may_return_null=1:ignore_noninstrumented_modules=1'
    # Threads that have nothing to do sleep, and leave the processor to the tests beside them.
    os.environ['OMP_WAIT_POLICY'] = 'passive'
    # Many tests wait, for a window or a browser: one more than processors keeps these busy.
    with (tempfile.TemporaryDirectory() as scratch,
          ThreadPoolExecutor(os.cpu_count() + 1) as side_by_side):
        folder = Path(scratch)
        running = [side_by_side.submit(run_pytest, file, folder) for file in files]
        running += [side_by_side.submit(run_program, program, folder)
                    for program in arguments.programs]
        results = [test.result() for test in running]
    passed, failed, skipped = (sum(column) for column in zip(*results))
    if skipped:
        print(f'{skipped} skipped')
    print(f'{passed} passed, {failed} failed')
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main())
