# SPDX-License-Identifier: GPL-3.0-only
"""Folders of made-up results, as run.py and results.py write them.

    stored = Stored(tmp_path)
    stored.benchmark(scenes=['box', 'hall'], kernels=['simple-bvh', 'funky-kd'])
    stored.run('box', 'broken', status='crashed', message='SIGSEGV')
    measured = stored.measured()

Nothing is doubtful about a benchmark as it comes: doubts() of it is empty. What a test is about it
changes by the keys of the file, nested ones joined by a point: {'time.render_s': 0.5}; ABSENT as a
value removes a key.
"""

import json
from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from datetime import datetime, timedelta, timezone
from pathlib import Path
from typing import Any

import imageio
import numpy as np

from metrics import Measured
from plan import CONTROL, RECORD, RECORDER, RENDER, REPLAY
from results import Result, read_result, read_results

ABSENT = object()
THREADS = 4
PASSES = 16
SIZE = (8, 6)
TRIANGLES = 1000
QUESTIONS_H, QUESTIONS_V = 60_000_000, 40_000_000
REFERENCE = [0.25, 0.25, 0.25]
BEGIN = datetime(2026, 1, 2, 3, 4, 5, tzinfo=timezone.utc)
SECONDS_APART = 10
DIFFERENCES = ['missed', 'ghost', 'wrong_triangle', 'tie', 'false_visible', 'false_occluded']
FLAGS = '-std=c++20 -Wall -fopenmp -ffp-contract=off -O3 -DNDEBUG -march=native'
Changes = Mapping[str, Any]

MACHINE = {
    'cpu': 'Imagined Processor 9000', 'caches': ['L1 Data 48K', 'L2 Unified 2048K'], 'cores': 4,
    'affinity': [0, 1, 2, 3], 'governor': 'performance', 'boost': 'off', 'virtual': False,
    'memory_bytes': 16 * 2**30, 'transparent_huge_pages': 'madvise', 'huge_pages': '0',
    'os': 'Debian GNU/Linux 12 (bookworm), Linux 6.1.0', 'python': '3.11.2',
}
QUIET = {'others': 0.01, 'stolen': 0.0, 'load_before': 0.1, 'load_after': 3.9}


def changed(report: dict[str, Any], changes: Changes) -> dict[str, Any]:
    """A copy with other values for some keys, nested ones joined by a point."""
    report = deepcopy(report)
    for key, value in changes.items():
        *outer, last = key.split('.')
        place = report
        for name in outer:
            place = place[name]
        if value is ABSENT:
            del place[last]
        else:
            place[last] = value
    return report


def render_report(kernel: str, *, scene: str = 'box', rate: float = 10, threads: int = THREADS,
                  passes: int = PASSES, triangles: int = TRIANGLES) -> dict[str, Any]:
    """The run report of a kernel that traces so many million rays per second."""
    name, _, options = kernel.partition(':')
    questions_h, questions_v = QUESTIONS_H * passes // PASSES, QUESTIONS_V * passes // PASSES
    render = (questions_h + questions_v) / (1e6 * rate)
    initialize = 1e-6 * triangles
    return {
        'schema': 1,
        'program': {'version': '1.0.0', 'commit': '0123456789abcdef0123456789abcdef01234567',
                    'compiler': 'g++ (Debian 12.2.0-14) 12.2.0', 'flags': FLAGS,
                    'kernel_flags': FLAGS, 'openmp': True},
        'system': {'cpu': MACHINE['cpu'], 'cores': 4, 'threads_available': 4,
                   'memory_bytes': MACHINE['memory_bytes'],
                   'os': 'Debian GNU/Linux 12 (bookworm), Linux 6.1.0',
                   'date': '2026-01-02T03:04:05Z'},
        'kernel': name,
        'kernel_options': dict(option.split('=', 1) for option in options.split(',') if option),
        'scene': f'scenes/{scene}.scene', 'camera': f'scenes/{scene}.camera',
        'triangles': triangles, 'threads': threads, 'in_flight': 1, 'passes': passes,
        'width': SIZE[0], 'height': SIZE[1], 'seed': 1,
        'time': {'load_s': 0.01, 'initialize_s': initialize, 'render_s': render,
                 'total_s': initialize + render},
        'rays': {'intersect': questions_h, 'visibility': questions_v, 'per_second': 1e6 * rate},
        'memory': {'kernel_peak_bytes': 200 * triangles, 'kernel_final_bytes': 100 * triangles,
                   'kernel_leaked_bytes': 0, 'process_peak_bytes': 20_000_000,
                   'triangles_bytes': 36 * triangles},
        'average_intensity': [0.2501, 0.2501, 0.2501],
        'standard_error': [0.0002, 0.0002, 0.0002],
        'reference_average_intensity': REFERENCE,
        'squared_error': 3e-8,
        'warnings': [],
    }


def replay_report(kernel: str, *, scene: str = 'box', rate: float = 20, threads: int = THREADS,
                  triangles: int = TRIANGLES, answers: Mapping[str, int] | None = None
                  ) -> dict[str, Any]:
    """The report of a replay at so many million questions per second.

    @param answers counts of those that differ, such as {'missed': 3}
    """
    counts: dict[str, float] = {name: (answers or {}).get(name, 0) for name in DIFFERENCES}
    asked = 1_000_000
    rates = {f'{what}_per_second': [1e6 * rate * factor * drift for drift in (0.99, 1, 1.01)]
             for what, factor in [('intersect', 1), ('visibility', 2), ('mixed', 1.25),
                                  ('mixed_in_flight', 1.5)]}
    report = render_report(kernel, scene=scene, rate=1.25 * rate, threads=threads,
                           triangles=triangles)
    return changed(report, {
        'passes': 0, 'width': 0, 'height': 0,
        'average_intensity': [None] * 3, 'standard_error': [None] * 3, 'squared_error': None,
        'replay': {
            'recorded_by': RECORDER, 'seconds_per_measurement': 1,
            'rays': {'intersect': asked * 6 // 10, 'visibility': asked * 4 // 10},
            **{name: values[1] for name, values in rates.items()},
            'in_flight': 16, 'measurements': rates,
            'by_bounce': [{'first': 0, 'last': 0, 'intersect': asked * 6 // 10,
                           'visibility': asked * 4 // 10, 'mixed_per_second': 1.25e6 * rate}],
            'answers': counts | {'max_relative_distance_error': 1e-7},
            'answers_in_flight': counts | {'max_relative_distance_error': 1e-7},
            'answers_per_million': {name: 1e6 * count / asked for name, count in counts.items()},
            'examples': {},
        }})


def write_images(base: Path, exposure: float = 1) -> None:
    """BASE.exr and BASE.png: a ramp, one pixel of which the exposure alters."""
    width, height = SIZE
    image = np.linspace(0, 1, 3 * width * height, dtype=np.float32).reshape(height, width, 3)
    image[0, 0] += np.float32(exposure - 1)
    imageio.imwrite(f'{base}.exr', image, format='EXR-FI')
    imageio.imwrite(f'{base}.png', np.rint(255 * np.clip(image, 0, 1)).astype(np.uint8))


class Stored:
    """A folder of results that is being filled. Each run begins ten seconds after the last."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.begun = 0

    def run(self, scene: str = 'box', kernel: str = RECORDER, kind: str = RENDER, *,
            repeat: int = 1, threads: int = THREADS, all_threads: int = THREADS,
            rate: float | None = None, triangles: int = TRIANGLES, scale: int | None = None,
            status: str = 'done', message: str = '', answers: Mapping[str, int] | None = None,
            exposure: float | None = 1, report: Changes = {}, bench: Changes = {}) -> Result:
        """Writes the files of one run.

        @param threads      of this run
        @param all_threads  that the benchmark uses: fewer threads are those of a scaling curve
        @param rate         million rays per second: 10 in a rendering and 20 in a replay
        @param scale        triangles asked for, in a scene of a growth curve
        @param exposure     of its image, where it has one; None for no image. Another number is
                            another image
        @param report       changes of the run report
        @param bench        changes of what bench.py adds to it
        """
        of_run: dict[str, Any] = {'scene': scene, 'threads': threads, 'triangles': triangles}
        if rate:
            of_run['rate'] = rate
        full = (replay_report(kernel, answers=answers, **of_run) if kind == REPLAY
                else render_report(kernel, **of_run))
        full = changed(full, report) if status == 'done' else {}
        added = changed(self._bench(scene, kernel, kind, repeat, threads, all_threads, scale,
                                    status, message), bench)
        name = kind if kind == RECORD else f'{kind}-{threads}-threads-{repeat}'
        path = self.folder / scene / kernel / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if status == 'done' and kind == RENDER and repeat == 1 and threads == all_threads \
                and exposure is not None:
            write_images(path, exposure)
        path.with_name(f'{name}.txt').write_text(f'what {kernel} prints\n{message}\n',
                                                 errors='replace')
        json_file = path.with_name(f'{name}.json')
        json_file.write_text(json.dumps({**full, 'bench': added}, indent=2))
        result = read_result(json_file)
        assert result
        return result

    def _bench(self, scene: str, kernel: str, kind: str, repeat: int, threads: int,
               all_threads: int, scale: int | None, status: str, message: str) -> dict[str, Any]:
        started = BEGIN + timedelta(seconds=SECONDS_APART * self.begun)
        self.begun += 1
        program = kernel.partition(':')[0]
        fingerprint: dict[str, Any] = {
            'program': f'sha-of-{program}', 'scene': f'sha-of-{scene}',
            'camera': f'sha-of-the-camera-of-{scene}',
            'triangles': f'sha-of-the-triangles-of-{scene}', 'size': f'{SIZE[0]}x{SIZE[1]}',
            'cpu': MACHINE['cpu'], 'affinity': MACHINE['affinity']}
        fingerprint |= {'replay_rays': 1_000_000} if kind in (RECORD, REPLAY) else {
            'passes': PASSES}
        if kind == REPLAY:
            fingerprint |= {'recorder': f'sha-of-{RECORDER}', 'replay_seconds': 1}
        if kind != RECORD:
            fingerprint['threads'] = all_threads
        return {
            'scene': scene, 'kernel': kernel, 'kind': kind, 'threads': threads, 'repeat': repeat,
            'status': status, 'message': message, 'fingerprint': fingerprint, 'scale': scale,
            'command': [f'/somewhere/build/bwfirt-{program}', f'/somewhere/scenes/{scene}.scene',
                        '--threads', str(threads)],
            'arguments': [], 'session': BEGIN.isoformat(), 'started': started.isoformat(),
            'seconds': 9.5, 'limits': {'seconds': 1800, 'bytes': 10**10},
 'machine': dict(MACHINE), 'disturbance': dict(QUIET)}

    def benchmark(self, scenes: Sequence[str] = ('box',),
                  kernels: Sequence[str] = (RECORDER, 'funky-kd'), *, repeats: int = 3,
                  rates: Mapping[str, float] | Callable[[str, str, int], float] = {},
                  answers: Mapping[str, Mapping[str, int]] = {}, control: str | None = 'funky-kd',
                  replays: bool = True, scaling: Sequence[str] = (),
                  growth: Sequence[int] = (), report: Changes = {}, bench: Changes = {}) -> None:
        """Writes all runs of a benchmark, in the order of plan.py.

        @param rates    million rays per second of a kernel, 10 if it is not among them; or a
                        function of scene, kernel and repeat
        @param answers  of a kernel, that differ: {'funky-kd': {'missed': 3}}
        @param control  the kernel that is measured against itself; None for no control
        @param replays  whether rays are recorded and replayed, on one thread and on all
        @param scaling  scenes that are rendered with one and with two threads, too
        @param growth   numbers of triangles of the scene that grows
        @param report   changes of all run reports but those of replays
        @param bench    changes of what bench.py adds to each
        """
        def rate(scene: str, kernel: str, repeat: int) -> float:
            if callable(rates):
                return rates(scene, kernel, repeat)
            return rates.get(kernel, 10) * (1 + 0.01 * (repeat % 3 - 1))  # 1, 1.01, 0.99, 1 ...

        for repeat in range(1, repeats + 1):
            for scene in scenes:
                for kernel in kernels:
                    self.run(scene, kernel, repeat=repeat, rate=rate(scene, kernel, repeat),
                             exposure=1.5 if any(answers.get(kernel, {}).values()) else 1,
                             report=report, bench=bench)
                    if kernel == control:
                        self.run(scene, kernel, CONTROL, repeat=repeat, report=report, bench=bench,
                                 rate=1.005 * rate(scene, kernel, repeat))
                for threads in (1, 2) if scene in scaling else ():
                    for kernel in kernels:
                        self.run(scene, kernel, repeat=repeat, threads=threads, report=report,
                                 bench=bench, rate=rate(scene, kernel, repeat) * threads / THREADS)
                if replays and repeat == 1:
                    self.run(scene, RECORDER, RECORD, threads=1, bench=bench)
                for threads in (1, THREADS) if replays else ():
                    for kernel in kernels:
                        self.run(scene, kernel, REPLAY, repeat=repeat, threads=threads, bench=bench,
                                 answers=answers.get(kernel),
                                 rate=2 * rate(scene, kernel, repeat) * threads / THREADS)
            for triangles in growth:
                for kernel in kernels:
                    self.run(f'forest@{triangles:g}', kernel, repeat=repeat, scale=triangles,
                             triangles=triangles, rate=rate('forest', kernel, repeat),
                             exposure=None, report=report, bench=bench)

    def measured(self) -> Measured:
        return Measured(read_results(self.folder))
