# SPDX-License-Identifier: GPL-3.0-only
"""bench.py as one calls it: what it lists, prints and refuses."""

import os
import re
import shlex
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import bench as bench_py
from fakes import BENCH, Bench, clean_environment, complaint, files, text_of
from stored import Stored


@pytest.fixture(scope='module')
def bench(tmp_path_factory: pytest.TempPathFactory) -> Bench:
    """Kernels that are never run."""
    bench = Bench(tmp_path_factory.mktemp('bench'))
    bench.scene('hall')
    for name in ['simple-bvh', 'funky-kd', 'other', 'yourkernel']:
        bench.kernel(name)
    (bench.build / 'bwfirt-folder').mkdir()
    (bench.build / 'bwfirt-import').write_text('no kernel')
    (bench.build / 'bwfirt-import').chmod(0o755)
    (bench.build / 'bwfirt-unfinished.o').write_text('not executable')
    return bench


Call = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def call(bench: Bench, monkeypatch: pytest.MonkeyPatch,
         capsys: pytest.CaptureFixture[str]) -> Iterator[Call]:
    """Calls bench.py within this process, which is faster; nothing may be measured by it."""
    def result_of(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
        command = bench.command(*arguments)
        monkeypatch.setattr('sys.argv', command[1:])
        try:
            status = bench_py.run()
        except SystemExit as ended:  # by argparse
            status = int(str(ended.code))
        return subprocess.CompletedProcess(command, status, *capsys.readouterr())
    yield result_of
    assert bench.invocations() == []
    assert not bench.results.exists()


# ---- Lists --------------------------------------------------------------------------------------


def test_list_names_scenes_and_kernels(bench: Bench, call: Call) -> None:
    result = call('--list')
    assert (result.returncode, result.stderr) == (0, '')
    assert result.stdout.splitlines() == [
        *(f'scene   {name}: {bench.scenes / name}.scene' for name in ['box', 'hall']),
        *(f"kernel  {name}: {bench.build / f'bwfirt-{name}'}"
          for name in ['funky-kd', 'other', 'simple-bvh'])]


def test_dry_run_prints_commands_that_a_shell_understands(bench: Bench, call: Call,
                                                          tmp_path: Path) -> None:
    odd = tmp_path / "it's a scene.scene"
    odd.write_text('triangles box.ra2\n')
    odd.with_suffix('.camera').write_text('')
    result = call('--dry-run', '--scenes', odd, '--kernels', 'simple-bvh:a=1,b=$x',
                  '--repeats', '2', '--passes', '7', '--threads', '3', '--size', '12x34')
    assert (result.returncode, result.stderr) == (0, '')
    commands = [shlex.split(line) for line in result.stdout.splitlines()]
    assert all(words[:2] == [str(bench.build / 'bwfirt-simple-bvh'), str(odd)]
               for words in commands)
    assert ['--record' in words for words in commands] == [False, True] + 5 * [False]
    assert ['--replay' in words for words in commands] == [
        False, False, True, True, False, True, True]
    rendering = ' '.join(commands[0])
    for option in ['--threads 3', '--passes 7', '--size 12x34', '--kernel-option a=1',
                   '--kernel-option b=$x', f"--camera {odd.with_suffix('.camera')}"]:
        assert f'{option} ' in f'{rendering} '


@pytest.mark.parametrize('text, names', [
    ('a', ['a']), ('a,b', ['a', 'b']), ('a,,b,', ['a', 'b']), ('*', ['*']),
    ('a:x=1,b', ['a:x=1', 'b']), ('a:x=1,y=2,b:z=3,c', ['a:x=1,y=2', 'b:z=3', 'c'])])
def test_names_of_kernels_are_apart_at_commas(text: str, names: list[str]) -> None:
    assert bench_py.kernel_names(text) == names


def test_standard_kernels_that_are_not_built_are_left_out(bench: Bench, call: Call,
                                                          monkeypatch: pytest.MonkeyPatch) -> None:
    """Here the embree modes and wide-bvh."""
    def kernels(*arguments: str) -> list[str]:
        monkeypatch.setattr('sys.argv', ['bench.py', '--build', str(bench.build), '--scenes',
                                         str(bench.scenes), *arguments])
        plan = bench_py.plan_of(bench_py.parse_arguments(), bench.results)
        return [kernel.name for kernel in plan.kernels]
    assert kernels() == ['simple-bvh', 'funky-kd', 'other']
    assert kernels('--quick') == ['simple-bvh', 'funky-kd']
    with pytest.raises(bench_py.UsageError):
        kernels('--kernels', 'embree')


def test_the_peers_are_measured() -> None:
    assert set(bench_py.PEERS) < set(bench_py.KERNELS)


def test_replays_may_be_shorter(call: Call) -> None:
    shorter = ['--replay-seconds', '0.2']
    for arguments, seconds in [([], '1'), (['--quick'], '0.02'), (shorter, '0.2'),
                               (['--quick', *shorter], '0.2')]:
        commands = call('--dry-run', *arguments).stdout.splitlines()
        given = {line.split('--replay-seconds ')[1] for line in commands if '--replay ' in line}
        assert given == {seconds}


def test_quick_takes_less_of_everything() -> None:
    full, quick = vars(bench_py.FULL), vars(bench_py.QUICK)
    for key in ['passes', 'repeats', 'replay_rays', 'replay_seconds', 'time_limit']:
        assert quick[key] < full[key]


def test_the_standard_scenes_exist() -> None:
    for name in [*bench_py.SCENES, *bench_py.THREAD_SCALING, bench_py.GROWTH]:
        assert (BENCH.parent / 'scenes' / f'{name}.py').exists()


# ---- What is refused ----------------------------------------------------------------------------


@pytest.mark.parametrize('arguments, message', [
    (['--kernels', 'missing'], "the kernel 'missing' is not built in .*; built are: funky-kd, "
     'other, simple-bvh, yourkernel'),
    (['--kernels', 'other:a=1,missing'], "the kernel 'missing' is not built in .*"),
    (['--kernels', 'folder'], "the kernel 'folder' is not built in .*"),
    (['--scenes', 'missing'], '.*/missing.scene does not exist'),
    (['--scenes', '/no/such/folder/x.scene'], '/no/such/folder/x.scene does not exist'),
    (['--scenes', ''], 'there is no scene to measure'),
    (['--scenes', '$NOT_SET'], 'there is no scene to measure'),
    (['--kernels', ''], 'there is no kernel to measure in .*'),
    (['--kernels', 'other', '--build', '/no/such/build'],
     "the kernel 'other' is not built in /no/such/build; built are: none")])
def test_unknown_names_are_wrong_usage(call: Call, arguments: list[str], message: str) -> None:
    assert re.fullmatch(message, complaint(call(*arguments), 2))


@pytest.mark.parametrize('what', ['--list', '--dry-run'])
def test_unknown_names_are_wrong_usage_in_lists_too(call: Call, what: str) -> None:
    assert complaint(call('--scenes', 'missing', what), 2).endswith('does not exist')


def test_a_scene_without_camera_is_wrong_usage(call: Call, tmp_path: Path) -> None:
    (tmp_path / 'a.scene').write_text('')
    assert complaint(call('--scenes', tmp_path / 'a.scene'), 2) == (
        f"{tmp_path / 'a.camera'} does not exist: a scene needs a camera beside it")


@pytest.mark.parametrize('option', ['--repeats', '--threads', '--passes', '--time-limit',
                                    '--memory-limit', '--replay-seconds', '--size'])
@pytest.mark.parametrize('value', ['0', '-1', 'many', '', 'nan', 'inf', '1x', '0x4'])
def test_bad_numbers_are_wrong_usage(option: str, value: str, capsys: pytest.CaptureFixture[str],
                                     monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr('sys.argv', ['bench.py', f'{option}={value}'])
    with pytest.raises(SystemExit) as ended:
        bench_py.parse_arguments()
    assert ended.value.code == 2
    assert f'error: argument {option}: ' in capsys.readouterr().err.splitlines()[-1]


@pytest.mark.parametrize('arguments', [['--no-such-option'], ['cornell'], ['--list', '--dry-run'],
                                       ['--compare']])
def test_a_wrong_command_line(call: Call, arguments: list[str]) -> None:
    result = call(*arguments)
    assert (result.returncode, result.stdout) == (2, '')
    assert result.stderr.splitlines()[-1].startswith('bench.py: error: ')


def test_a_report_of_nothing_fails(bench: Bench, call: Call) -> None:
    assert complaint(call('--report-only'), 1) == 'there are no results to report'
    assert not bench.output.with_suffix('.csv').exists()


def test_a_comparison_with_nothing_fails(bench: Bench, call: Call, tmp_path: Path) -> None:
    Stored(tmp_path).run('box', 'a')
    assert complaint(call('--compare', tmp_path), 1) == (
        f'{bench.results}: there are no results')
    result = call('--results', tmp_path, '--compare', tmp_path / 'missing')
    assert complaint(result, 1) == f"{tmp_path / 'missing'}: there are no results"


def test_a_comparison_is_printed(call: Call, tmp_path: Path) -> None:
    Stored(tmp_path / 'a').benchmark(rates={'simple-bvh': 20})
    Stored(tmp_path / 'b').benchmark(rates={'simple-bvh': 10})
    result = call('--results', tmp_path / 'a', '--compare', tmp_path / 'b')
    assert (result.returncode, result.stderr) == (0, '')
    line = next(line for line in result.stdout.splitlines() if 'Rays, gross' in line)
    assert line.split() == ['box', 'simple-bvh', 'Rays,', 'gross', 'Mrays/s', '20', '10', '2.000',
                            'better']


def test_an_output_folder_that_is_missing_is_told_of_before_measuring(bench: Bench,
                                                                      call: Call) -> None:
    message = complaint(call('--output', bench.folder / 'missing' / 'report'), 1)
    assert message.startswith(str(bench.folder / 'missing'))


# ---- What is not installed ----------------------------------------------------------------------


@pytest.mark.parametrize('module, package', [
    ('matplotlib', 'python3-matplotlib'), ('jinja2', 'python3-jinja2'), ('tqdm', 'python3-tqdm'),
    ('imageio', 'python3-imageio'), ('numpy', 'python3-numpy')])
def test_a_missing_module_is_named_with_its_package(bench: Bench, tmp_path: Path, module: str,
                                                    package: str) -> None:
    (tmp_path / f'{module}.py').write_text(
        f'raise ModuleNotFoundError("No module named {module!r}", name={module!r})\n')
    message = complaint(bench.run(env=clean_environment(PYTHONPATH=str(tmp_path))), 1)
    assert message == f'{module} is missing: install the Debian package {package}'


@pytest.mark.parametrize('program, package', [
    ('pdflatex', 'texlive-latex-recommended and lmodern'), ('epstopdf', 'texlive-font-utils'),
    ('gs', 'ghostscript')])
def test_missing_latex_is_named_with_its_package(
        call: Call, tmp_path: Path, program: str, package: str,
        monkeypatch: pytest.MonkeyPatch) -> None:
    for other in {'pdflatex', 'epstopdf', 'gs'} - {program}:
        (tmp_path / other).symlink_to(shutil.which(other) or '/missing')
    monkeypatch.setenv('PATH', str(tmp_path))
    message = complaint(call(), 1)
    assert message == f'{program} is missing: install the Debian packages {package}'


# ---- From kernels to the report -----------------------------------------------------------------


def test_a_benchmark_from_kernels_to_report(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('simple-bvh', rate=5)
    bench.kernel('funky-kd', rate=10)
    bench.kernel('liar', rate=77, answers={'missed': 7})
    bench.kernel('broken', 'if KIND == "render": os.abort()')
    result = bench.run('--repeats', '1', cwd=tmp_path, env=clean_environment())
    assert (result.returncode, result.stderr) == (0, '')
    assert result.stdout.splitlines()[-3:] == [f'{bench.output}.{ending}'
                                               for ending in ['csv', 'html', 'pdf']]
    text = text_of(bench.output.with_suffix('.pdf'))
    for expected in ['77 7 ppm wrong', 'render: crashed', 'SIGABRT', '7 missed of 1000000',
                     'Too few repeats: 1']:
        assert expected in text
    assert files(tmp_path) >= {'report.csv', 'report.html', 'report.pdf'}
    assert not [name for name in os.listdir(tmp_path) if name.startswith('.')]


def test_a_benchmark_of_which_all_fails_has_a_report_and_fails(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    bench.kernel('broken', 'sys.exit("box.ra2: is broken")')
    result = bench.run(env=clean_environment())
    assert (result.returncode, result.stderr) == (1, '')
    assert 'box.ra2: is broken' in text_of(bench.output.with_suffix('.pdf'))
