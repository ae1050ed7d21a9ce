# SPDX-License-Identifier: GPL-3.0-only
"""Each way in which a kernel can fail is a row of the report, and the other kernels go on."""

from pathlib import Path

import pytest

from doubts import doubts, failures
from fakes import Bench, files, status_of
from metrics import RATE, RATE_MIXED, Measured

ON_A_RENDERING = 'if KIND == "render":\n    '
WRITE_REPORT = 'with open(given("--report"), "w") as stream: stream.write({}); sys.exit(0)'
PRINT_MUCH = 'for stream in (sys.stdout, sys.stderr): stream.write("much" * 1000000 + "\\n")'

# name: code, and how the run is shown
FAILURES = {
    'segfault': ('os.kill(os.getpid(), signal.SIGSEGV)', 'crashed', 'SIGSEGV'),
    'abort': ('print("assertion", file=sys.stderr, flush=True); os.abort()', 'crashed',
              'SIGABRT assertion'),
    'terminated': ('os.kill(os.getpid(), signal.SIGTERM)', 'killed', 'SIGTERM'),
    'kill': ('os.kill(os.getpid(), signal.SIGKILL)', 'killed',
             'SIGKILL, perhaps for want of memory'),
    'real-time-signal': ('os.kill(os.getpid(), 40)', 'killed', 'signal 40'),
    'bad-alloc': ('print("what(): std::bad_alloc", file=sys.stderr, flush=True); os.abort()',
                  'out of memory', 'what(): std::bad_alloc'),
    'memory-hog': ('x = bytearray(3 * 10**9)', 'out of memory', 'MemoryError'),
    'message': ('print("warning\\nbox.ra2: is broken", file=sys.stderr); sys.exit(1)',
                'exit status 1', 'box.ra2: is broken'),
    'silent': ('sys.exit(3)', 'exit status 3', ''),
    'much-and-fails': (PRINT_MUCH + '\n    sys.exit(1)', 'exit status 1', 'much' * 70),
    'no-report': ('sys.exit(0)', 'unreadable report', 'there is none'),
    'empty-report': (WRITE_REPORT.format('""'), 'unreadable report', 'Expecting value'),
    'rubbish': (WRITE_REPORT.format('"rays: many"'), 'unreadable report', 'Expecting value'),
    'bytes': ('open(given("--report"), "wb").write(b"\\xff\\xfe\\x00"); sys.exit(0)',
              'unreadable report', 'codec'),
    'half': (WRITE_REPORT.format('json.dumps(report)[:600]'), 'unreadable report', ''),
    'nested': (WRITE_REPORT.format('"[" * 100000'), 'unreadable report', 'recursion'),
    'list': (WRITE_REPORT.format('"[]"'), 'unreadable report', 'schema is missing'),
    'folder': ('os.mkdir(given("--report")); sys.exit(0)', 'unreadable report', 'is no file'),
    'other-kernel': ('report["kernel"] = "good"', 'wrong report',
                     'kernel is good, not other-kernel'),
    'fewer-passes': ('report["passes"] = 15', 'wrong report', 'passes is 15, not 16'),
    'fewer-threads': ('report["threads"] = 1', 'wrong report', 'threads is 1, not 2'),
    'other-schema': ('report["schema"] = 2', 'wrong report', 'schema is 2, not 1'),
    'nan': ('report["rays"]["per_second"] = float("nan")', 'wrong report',
            'Rays, gross is not finite'),
    'infinite': ('report["time"]["total_s"] = float("inf")', 'wrong report',
                 'Total running time is not finite'),
    'huge': ('report["time"]["total_s"] = 10**400', 'wrong report', 'is not finite'),
    'negative': ('report["memory"]["kernel_peak_bytes"] = -1', 'wrong report',
                 'Kernel memory, peak is negative'),
    'no-rays': ('report["rays"]["per_second"] = 0', 'wrong report', 'Rays, gross is 0'),
    'no-triangles': ('report["triangles"] = 0', 'wrong report', 'triangles is 0'),
    'other-size': ('report["width"] = 9', 'wrong report', 'width is 9, not 8'),
    'other-options': ('report["kernel_options"] = {"fast": "1"}', 'wrong report',
                      "kernel_options is {'fast': '1'}, not {}"),
    'no-texts': ('report["warnings"] = [7]', 'unreadable report', 'warnings are no texts'),
    'broken-image': ('open(IMAGE + ".exr", "w").write("EXR")', 'unreadable image',
                     'run.exr: '),
    'swapped-image': ('open(IMAGE + ".exr", "wb").write(open(IMAGE + ".png", "rb").read())',
                      'unreadable image', 'run.exr'),
    'no-image': ('output = None', 'unreadable image', 'run.exr: there is none'),
    'word': ('report["time"]["render_s"] = "fast"', 'unreadable report', ''),
    'null-average': ('report["average_intensity"] = [None] * 3; report["squared_error"] = None',
                     'wrong report', 'average_intensity is not finite'),
    'null-error': ('report["squared_error"] = None', 'wrong report',
                   'Squared error of the average intensity is not finite'),
    'odd-error': ('report["standard_error"] = ["x", 0, 0]', 'unreadable report',
                  'standard_error is no number'),
    'no-rates': ('del report["rays"]', 'unreadable report', "rays"),
    'no-average': ('del report["average_intensity"]', 'unreadable report', 'average_intensity'),
    'no-program': ('del report["program"]["flags"]', 'unreadable report', 'flags'),
    'no-leaks': ('del report["memory"]["kernel_leaked_bytes"]', 'unreadable report',
                 'kernel_leaked_bytes'),
}


class Measurements:
    """Of all these kernels, between two good ones."""

    def __init__(self, folder: Path) -> None:
        self.bench = Bench(folder)
        self.bench.kernel('simple-bvh', rate=5)
        self.bench.kernel('funky-kd')
        for name, (code, _, _) in FAILURES.items():
            self.bench.kernel(name, ON_A_RENDERING + code)
        self.bench.kernel('zoo', PRINT_MUCH, rate=20)
        self.measured = self.bench.measure(self.bench.plan(repeats=2, replays=False),
                                           gigabytes=2)


@pytest.fixture(scope='module')
def all_failed(tmp_path_factory: pytest.TempPathFactory) -> Measurements:
    return Measurements(tmp_path_factory.mktemp('failures'))


@pytest.mark.parametrize('name', FAILURES)
def test_a_failed_run_is_a_row_that_says_how(all_failed: Measurements, name: str) -> None:
    _, expected, expected_message = FAILURES[name]
    status, message = status_of(all_failed.measured, name)
    assert (status, expected_message in message) == (expected, True), (status, message)
    assert ('box', name, f'render: {status}', message) in failures(all_failed.measured)


@pytest.mark.parametrize('name', FAILURES)
def test_a_failed_run_has_no_figures_and_no_rank(all_failed: Measurements, name: str) -> None:
    measured = all_failed.measured
    assert measured.spread(RATE, 'box', name) is None
    assert name not in measured.best(RATE, 'box')
    assert measured.relative(RATE, name) is None


@pytest.mark.parametrize('name', FAILURES)
def test_what_failed_is_not_repeated(all_failed: Measurements, name: str) -> None:
    assert all_failed.bench.invocations().count(f'{name} render box.scene 2') == 1


def test_good_kernels_beside_them_keep_their_figures(all_failed: Measurements) -> None:
    measured = all_failed.measured
    rates = {name: measured.median(RATE, 'box', name) for name in ['simple-bvh', 'funky-kd', 'zoo']}
    assert rates == {'simple-bvh': 5, 'funky-kd': 10, 'zoo': 20}
    assert measured.best(RATE, 'box') == ['zoo']


def test_what_a_kernel_prints_is_kept(all_failed: Measurements) -> None:
    text = (all_failed.bench.results / 'box/zoo/render-2-threads-1.txt').read_text()
    assert text.count('much') == 2000000
    text = (all_failed.bench.results / 'box/message/render-2-threads-1.txt').read_text()
    assert text == 'warning\nbox.ra2: is broken\n'


def test_failures_leave_nothing_but_results(all_failed: Measurements) -> None:
    endings = {Path(name).suffix for name in files(all_failed.bench.results)}
    assert endings == {'.json', '.txt', '.exr', '.png'}
    assert {path.name for path in all_failed.bench.results.iterdir()} == {'.lock', 'box'}


# ---- Time ---------------------------------------------------------------------------------------

HANG = '''
child = os.fork()
if child == 0:
    note(f'{os.getpid()} hanging child box.scene 2')
time.sleep(5)
note(f'{os.getpid()} hanging beyond its limit')
time.sleep(100)
'''
STUBBORN = '''
for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
    signal.signal(number, signal.SIG_IGN)
with open(given('--report') + '.a1b2c3', 'w') as unfinished:
    unfinished.write('half a rep')
time.sleep(100)
'''


@pytest.fixture(scope='module')
def hanging(tmp_path_factory: pytest.TempPathFactory) -> Bench:
    bench = Bench(tmp_path_factory.mktemp('hanging'))
    bench.kernel('good')
    bench.kernel('hanging', 'if KIND == "render":' + HANG.replace('\n', '\n    '))
    bench.kernel('stubborn', 'if KIND == "render":' + STUBBORN.replace('\n', '\n    '))
    bench.measure(bench.plan(time_limit=2, control='good', repeats=1))
    return bench


@pytest.mark.parametrize('name', ['hanging', 'stubborn'])
def test_a_kernel_that_hangs_is_ended(hanging: Bench, name: str) -> None:
    assert status_of(hanging.measured(), name) == ('timed out', 'after 2 s')


def test_a_kernel_that_hangs_leaves_no_process(hanging: Bench) -> None:
    assert 'hanging child box.scene 2' in hanging.invocations()
    assert 'hanging beyond its limit' not in hanging.invocations()
    assert hanging.processes() == []


def test_a_kernel_that_hangs_leaves_no_unfinished_file(hanging: Bench) -> None:
    assert files(hanging.results / 'box/stubborn') == {'render-2-threads-1.json',
                                                       'render-2-threads-1.txt'}


def test_a_longer_time_limit_gives_another_chance(hanging: Bench) -> None:
    plan = hanging.plan(time_limit=3, control='good', repeats=1)
    again = {run.kernel.name for run in hanging.measurement(plan).missing()}
    assert again == {'hanging', 'stubborn'}


def test_a_hanging_warm_up_does_not_hang_the_benchmark(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('good', 'if KIND == "warm-up":\n    time.sleep(100)')
    measured = bench.measure(bench.plan(time_limit=2, repeats=1))
    assert measured.median(RATE, 'box', 'good') == 10
    assert bench.processes() == []


# ---- What the report tells beside the figures ---------------------------------------------------


def test_a_leak_is_a_warning(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('simple-bvh')
    bench.kernel('leaking', 'report["memory"]["kernel_leaked_bytes"] = 4096')
    warnings = [sentence for sentence in doubts(bench.measure()) if 'leak' in sentence]
    assert warnings == ['leaking leaked memory: up to 4096 bytes in a run.']


def test_a_kernel_that_answers_differently_from_run_to_run_is_a_warning(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('simple-bvh')
    bench.kernel('random', 'report["average_intensity"] = [time.time_ns() % 1000000 / 1e6] * 3')
    warnings = [sentence for sentence in doubts(bench.measure()) if 'from run to run' in sentence]
    assert len(warnings) == 1 and warnings[0].startswith('random ')


@pytest.fixture(scope='module')
def wrong(tmp_path_factory: pytest.TempPathFactory) -> Bench:
    """Of a kernel that answers wrongly and fast, and one that crashes in the replay."""
    bench = Bench(tmp_path_factory.mktemp('wrong'))
    bench.kernel('simple-bvh', rate=5)
    bench.kernel('funky-kd', rate=10)
    bench.kernel('liar', rate=50, answers={'missed': 7, 'false_visible': 2})
    bench.kernel('shy', 'if KIND == "replay":\n    os.abort()', rate=40)
    bench.kernel('tied', rate=10.2, answers={'tie': 1000})
    bench.measure()
    return bench


def test_wrong_answers_are_a_failure_with_their_counts(wrong: Bench) -> None:
    rows = [row for row in failures(wrong.measured()) if row[1] == 'liar']
    assert rows == [('box', 'liar', 'wrong answers', '7 missed, 2 false visible of 1000000')]


def test_ties_are_no_failure(wrong: Bench) -> None:
    assert 'tied' not in {row[1] for row in failures(wrong.measured())}
    assert wrong.measured().best(RATE, 'box') == ['tied']


def test_a_failed_replay_is_a_row_and_costs_the_rank(wrong: Bench) -> None:
    measured = wrong.measured()
    assert ('box', 'shy', 'replay: crashed', 'SIGABRT') in failures(measured)
    assert measured.median(RATE, 'box', 'shy') == 40
    assert measured.spread(RATE_MIXED, 'box', 'shy') is None
    assert 'shy' not in measured.best(RATE, 'box')


def test_a_failed_replay_is_not_repeated(wrong: Bench) -> None:
    """On one thread and on all it is tried once; what answers wrongly is measured to the end."""
    replays = [line for line in wrong.invocations() if ' replay ' in line]
    for kernel, times in [('shy', 1), ('liar', 3), ('tied', 3)]:
        for threads in (1, 2):
            assert replays.count(f'{kernel} replay box.scene {threads}') == times


def test_a_kernel_that_fails_on_one_thread_only_has_no_rank(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('simple-bvh')
    bench.kernel('odd', 'if KIND == "replay" and given("--threads") == "1":\n    os.abort()',
                 rate=40)
    measured = bench.measure()
    assert measured.spread(RATE_MIXED.alone(1), 'box', 'odd') is None
    assert measured.median(RATE_MIXED, 'box', 'odd') == 100
    assert measured.best(RATE_MIXED, 'box') == ['simple-bvh']
    assert ('box', 'odd', 'replay: crashed', 'SIGABRT') in failures(measured)


ODD_REPLAYS = {
    'no-answers': 'del report["replay"]["answers"]',
    'no-missed': 'del report["replay"]["answers"]["missed"]',
    'no-answers-in-flight': 'del report["replay"]["answers_in_flight"]',
    'no-questions': 'del report["replay"]["rays"]',
    'no-recorder': 'del report["replay"]["recorded_by"]',
    'no-rate': 'del report["replay"]["mixed_per_second"]',
    'null-rate': 'report["replay"]["mixed_per_second"] = None',
    'nan-rate': 'report["replay"]["mixed_per_second"] = float("nan")',
    'no-build-time': 'del report["time"]["initialize_s"]',
    'no-memory': 'del report["memory"]["kernel_final_bytes"]',
    'null-distance': 'report["replay"]["answers"]["max_relative_distance_error"] = None',
    'nan-ghosts': 'report["replay"]["answers_in_flight"]["ghost"] = float("nan")',
    'word-ghosts': 'report["replay"]["answers"]["ghost"] = "none"',
}


@pytest.fixture(scope='module')
def odd_replays(tmp_path_factory: pytest.TempPathFactory) -> Measured:
    bench = Bench(tmp_path_factory.mktemp('odd'))
    bench.kernel('simple-bvh')
    for name, code in ODD_REPLAYS.items():
        bench.kernel(name, f'if KIND == "replay":\n    {code}')
    return bench.measure(bench.plan(repeats=1))


@pytest.mark.parametrize('name', ODD_REPLAYS)
def test_a_replay_without_its_answers_is_a_failure(odd_replays: Measured, name: str) -> None:
    assert status_of(odd_replays, name, 'replay')[0] in ('unreadable report', 'wrong report')
    assert odd_replays.wrong_per_million('box', name) is None
    assert odd_replays.best(RATE, 'box') == ['simple-bvh']


def test_without_a_ray_stream_replays_are_failures(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('simple-bvh', 'if KIND == "record":\n    sys.exit("no")')
    bench.kernel('other')
    measured = bench.measure(bench.plan(repeats=1))
    assert status_of(measured, 'simple-bvh', 'record') == ('exit status 1', 'no')
    assert status_of(measured, 'other', 'replay') == ('not made', 'simple-bvh recorded no rays')
    assert measured.median(RATE, 'box', 'other') == 10


def test_a_program_that_cannot_be_started_is_a_failure(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('good')
    bench.kernel('odd').write_text('#!/no/such/interpreter\n')
    measured = bench.measure()
    assert status_of(measured, 'odd')[0] == 'not started'
    assert measured.median(RATE, 'box', 'good') == 10


def test_a_kernel_that_vanishes_is_a_failure(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('good', 'if KIND == "render":\n    '
                 'os.remove(sys.argv[0].replace("good", "odd")) '
                 'if os.path.exists(sys.argv[0].replace("good", "odd")) else None')
    bench.kernel('odd')
    assert status_of(bench.measure(), 'odd')[0] == 'not started'


def test_a_scene_that_names_no_triangles_fails_alone(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('good', 'if SCENE == "broken.scene":\n    sys.exit("broken.scene: no triangles")')
    bench.scene('broken')
    (bench.scenes / 'broken.scene').write_text('reflectance "0.5\n')
    measured = bench.measure()
    assert ('broken', 'good', 'render: exit status 1', 'broken.scene: no triangles') in failures(
        measured)
    assert measured.median(RATE, 'box', 'good') == 10
