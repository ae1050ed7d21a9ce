#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Runs fuzz programs side by side, each for some seconds from its corpus.

Ends with status 1 where one of them found something. The input that showed it lies beside the
program then, and its output tells what is wrong.

usage: run.py SECONDS FUZZ_PROGRAM ...
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
IN_MEMORY = Path('/dev/shm')

# What a reader may take for an input of some kilobytes.
LIMITS = ['-timeout=10', '-malloc_limit_mb=64', '-rss_limit_mb=1024']


def fuzz(program: Path, seconds: int) -> bool:
    """True where the program found nothing."""
    dictionary = HERE / f'{program.name}.dict'
    with tempfile.TemporaryDirectory(dir=IN_MEMORY if IN_MEMORY.is_dir() else None) as scratch:
        new_inputs = Path(scratch) / 'new-inputs'
        new_inputs.mkdir()
        # The program adds inputs to the first folder and only reads from the others.
        result = subprocess.run(
            [program, f'-max_total_time={seconds}', *LIMITS, f'-artifact_prefix={program}-',
             *([f'-dict={dictionary}'] if dictionary.exists() else []),
             new_inputs, HERE / 'corpus' / program.name],
            env=os.environ | {'TMPDIR': scratch}, stdin=subprocess.DEVNULL, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors='replace', check=False)
    done = re.search(r'^Done (\d+) runs', result.stdout, re.MULTILINE)
    if result.returncode == 0 and done:
        print(f'{program.name}: {done[1]} inputs, nothing found', flush=True)
        return True
    print(f'{result.stdout}{program.name}: failed with status {result.returncode}', flush=True)
    return False


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument('seconds', type=int)
    parser.add_argument('programs', nargs='+', type=Path)
    arguments = parser.parse_args()
    with ThreadPoolExecutor(os.cpu_count()) as side_by_side:
        results = list(side_by_side.map(lambda program: fuzz(program, arguments.seconds),
                                        arguments.programs))
    return 0 if all(results) else 1


if __name__ == '__main__':
    sys.exit(main())
