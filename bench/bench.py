#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Measures ray tracing kernels on scenes, and typesets bench.pdf, bench.html and bench.csv."""

# A scene is a name in scenes/, a scene file, or a folder of scene files; each has a camera of the
# same name beside it. A kernel is NAME or NAME:OPTION=VALUE,...; '*' stands for all others that are
# built, but for the template.
SCENES = ['cornell', 'conference', 'atrium', 'statue', 'forest', 'hairball', 'stadium']
MORE_SCENES = ['$BWFIRT_SCENES']  # in a full run
PEERS = ['embree', 'embree:quality=medium', 'embree:robust=1']  # others are compared with the best
KERNELS = ['simple-bvh', 'funky-kd', *PEERS, '*']  # of these, those that are built
QUICK_KERNELS = ['simple-bvh', 'funky-kd', 'wide-bvh']  # likewise
CONTROL = 'funky-kd'  # is measured against itself, to learn the noise
THREAD_SCALING = ['conference']  # scenes that are rendered with fewer threads, too
GROWTH = 'forest'  # a standard scene that is made of ever more triangles

import argparse
import math
import os
import re
import shlex
import signal
import sys
from pathlib import Path

try:
    from compare import compare
    from environment import memory_bytes
    from latex import LatexError
    from metrics import Measured
    from plan import (RECORDER, ROOT, Extent, Plan, Scene, UsageError, built_kernels, find_kernels,
                      find_scenes)
    from report import ReportError, require_output, write_report
    from results import ResultsError, read_results
    from run import Limits, Measurement, remove
except ModuleNotFoundError as missing:
    sys.exit(f'bench.py: {missing.name} is missing: install the Debian package '
             f'python3-{str(missing.name).lower()}')

FULL = Extent(size='640x480', passes=16, repeats=3, controls=None, replay_rays=1000000,
              replay_seconds=1, replays_on_one_thread=True,
              growth=(1000, 10000, 100000, 1000000, 10000000), time_limit=1800)
QUICK = Extent(size='200x150', passes=2, repeats=2, controls=3, replay_rays=5000,
               replay_seconds=0.02, replays_on_one_thread=False,
               growth=(1000, 10000, 100000), time_limit=120)
BENCH = ROOT / 'bench'
MOST_BYTES = 2**62  # that a limit can be
DONE, FAILED, WRONG_USAGE = 0, 1, 2


def number(text: str) -> float:
    value = float(text)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f'{text} is not a number above 0')
    return value


def whole_number(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f'{text} is less than 1')
    return value


def size(text: str) -> str:
    if not re.fullmatch('[1-9][0-9]*x[1-9][0-9]*', text):
        raise argparse.ArgumentTypeError(f'{text} is not WIDTHxHEIGHT')
    return text


def names(text: str) -> list[str]:
    return [name for name in text.split(',') if name]


def kernel_names(text: str) -> list[str]:
    """Apart at commas, but for those between options: NAME:OPTION=VALUE,OPTION=VALUE."""
    return [name for name in re.split(',(?![^,:]*=)', text) if name]


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog='bench.py', description=__doc__, epilog='The lists of '
                                     'scenes and kernels are at the beginning of bench/bench.py.')
    add = parser.add_argument
    what = parser.add_mutually_exclusive_group()
    what.add_argument('--list', action='store_true', help='list scenes and kernels, and end')
    what.add_argument('--dry-run', action='store_true', help='print the runs to be made, and end')
    what.add_argument('--report-only', action='store_true',
                      help='measure nothing; make the report of the results that there are')
    what.add_argument('--compare', metavar='DIR', type=Path, help='measure nothing; compare the '
                      'results with those in another folder: ratios, and whether they are noise')
    add('--quick', action='store_true', help='a small image, few kernels, short replays, 2 repeats')
    add('--fresh', action='store_true', help='forget the results of these scenes and kernels first')
    add('--scenes', metavar='A,B', type=names, help='names, scene files, or folders of them')
    add('--kernels', metavar='A,B', type=kernel_names, action='append',
        help="NAME or NAME:OPTION=VALUE,...; '*' for all others")
    add('--repeats', metavar='N', type=whole_number, help='of each run, default 3')
    add('--threads', metavar='N', type=whole_number, help='default: all that may be used')
    add('--passes', metavar='N', type=whole_number, help='samples per pixel, default 16')
    add('--replay-seconds', metavar='S', type=number,
        help='least time of each measurement in a replay, default 1')
    add('--size', metavar='WxH', type=size, help='of the image, default 640x480')
    add('--time-limit', metavar='SECONDS', type=number, help='of one run, default 1800')
    add('--memory-limit', metavar='GB', type=number, help="of one run's address space, "
        'default 0.9 times the memory of the machine')
    add('--results', metavar='DIR', type=Path,
        help='folder of results, default bench/results, or its folder quick')
    add('--output', metavar='BASE', type=Path, default=BENCH / 'bench',
        help='BASE.pdf, BASE.html and BASE.csv, default bench/bench')
    add('--build', metavar='DIR', type=Path, default=ROOT / 'build', help='where the kernels are')
    return parser.parse_args()


def extent_of(arguments: argparse.Namespace) -> Extent:
    base = QUICK if arguments.quick else FULL
    given = {key: value for key in ['repeats', 'passes', 'size', 'replay_seconds', 'time_limit']
             if (value := getattr(arguments, key))}
    return Extent(**{**vars(base), **given})


def plan_of(arguments: argparse.Namespace, results: Path) -> Plan:
    """@throws UsageError for names that fit nothing"""
    build = arguments.build.absolute()
    built = built_kernels(build)
    chosen = [name for part in arguments.kernels or [] for name in part]
    standard_kernels = [name for name in (QUICK_KERNELS if arguments.quick else KERNELS)
                        if name.partition(':')[0] in [*built, '*']]
    kernels = find_kernels(standard_kernels if arguments.kernels is None else chosen, build)
    standard = SCENES if arguments.quick else SCENES + MORE_SCENES
    scenes = find_scenes(standard if arguments.scenes is None else arguments.scenes)
    extent = extent_of(arguments)
    threads = len(os.sched_getaffinity(0))
    growth = [Scene(f'{GROWTH}@{scale:g}', results / 'scenes' / f'{GROWTH}-{scale}.scene',
                    ROOT / 'scenes' / f'{GROWTH}.camera', scale) for scale in extent.growth]
    recorder = find_kernels([RECORDER], build)[0] if RECORDER in built else None
    return Plan(scenes, kernels, CONTROL, [] if arguments.scenes else growth, THREAD_SCALING,
                arguments.threads or threads, extent, recorder)


def show(plan: Plan) -> None:
    for scene in plan.scenes + plan.growth:
        print(f'scene   {scene.name}: {scene.file}')
    for kernel in plan.kernels:
        print(f'kernel  {kernel.name}: {kernel.program}')


def stored(folder: Path) -> Measured:
    """@throws ResultsError where there are no results"""
    measured = Measured(read_results(folder))
    if not measured.results:
        raise ResultsError(f'{folder}: there are no results')
    return measured


def main() -> int:
    arguments = parse_arguments()
    results = (arguments.results or BENCH / 'results' / ('quick' if arguments.quick else 'full')
               ).absolute()
    if arguments.compare:
        print(compare(stored(results), stored(arguments.compare)))
        return DONE
    selected = None
    if not arguments.report_only:
        plan = plan_of(arguments, results)
        if arguments.list:
            show(plan)
            return DONE
        memory = arguments.memory_limit or 0.9e-9 * memory_bytes()
        limits = Limits(plan.extent.time_limit, min(int(memory * 1e9), MOST_BYTES))
        measurement = Measurement(plan, results, limits, sys.argv[1:])
        if arguments.dry_run:
            for run in measurement.missing():
                print(shlex.join(measurement.command(run, results / run.name)))
            return DONE
        require_output(arguments.output)
        if arguments.fresh:
            remove(plan, results)
        measurement.measure()
        selected = plan.names()
    measured = Measured(read_results(results), selected, PEERS)
    for path in write_report(measured, arguments.output):
        print(path)
    return DONE if any(result.done for result in measured.results) else FAILED


def run() -> int:
    """main(), with a line on standard error for what went wrong."""
    try:
        return main()
    except KeyboardInterrupt:
        status, message = FAILED, 'interrupted; the results so far are kept'
    except UsageError as error:
        status, message = WRONG_USAGE, str(error)
    except (LatexError, ReportError, ResultsError, OSError) as error:
        status, message = FAILED, str(error)
    print(f'bench.py: {message}', file=sys.stderr)
    return status


if __name__ == '__main__':
    for stream in (sys.stdout, sys.stderr):  # names of files may hold what they cannot show
        stream.reconfigure(errors='backslashreplace')  # type: ignore[attr-defined]
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))
    sys.exit(run())
