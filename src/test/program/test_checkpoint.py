# SPDX-License-Identifier: GPL-3.0-only
"""A run that was ended in any way goes on from its checkpoint as if nothing had happened."""

import random
import signal
import subprocess
import time
from pathlib import Path

import pytest

from program import batch_command, read_report, refusal, render, wait_for_file

RUN = ('--size', '64x48', '--checkpoint', 'box.checkpoint')
KILLS = 6


def start(program: Path, folder: Path, *options: str) -> subprocess.Popen:
    command = [str(word) for word in batch_command(program, *RUN, *options)]
    return subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL)


@pytest.mark.parametrize('program', ['funky-kd'], indirect=True)
def test_a_run_killed_again_and_again_ends_with_the_same_image(
        program: Path, folder: Path) -> None:
    begun = time.monotonic()
    render(program, folder, '--size', '64x48', '--passes', '100')
    passes = str(round(100 * 4 / (time.monotonic() - begun)))
    expected = render(program, folder, '--size', '64x48', '--passes', passes)
    image = (folder / 'image.exr').read_bytes()

    moments = random.Random(1)
    for _ in range(KILLS):
        with start(program, folder, '--passes', passes) as process:
            time.sleep(moments.uniform(0.05, 2.5))
            process.kill()
    report = render(program, folder, *RUN, '--passes', passes)
    assert (folder / 'image.exr').read_bytes() == image
    assert report['rays']['intersect'] == expected['rays']['intersect']
    assert report['average_intensity'] == expected['average_intensity']
    assert report['standard_error'] == expected['standard_error']


@pytest.mark.parametrize('ending', [signal.SIGINT, signal.SIGTERM])
def test_a_run_ended_by_a_signal_leaves_a_checkpoint_of_all_its_passes(
        program: Path, folder: Path, ending: signal.Signals) -> None:
    with start(program, folder, '--passes', '1000000') as process:
        wait_for_file(folder, 'box.checkpoint')
        process.send_signal(ending)
        assert process.wait(30) == 0
    ended = read_report(folder)
    more = ended['passes'] + 5
    report = render(program, folder, *RUN, '--passes', str(more))
    image = (folder / 'image.exr').read_bytes()
    assert report['passes'] == more
    assert report['rays']['intersect'] > ended['rays']['intersect']
    (folder / 'box.checkpoint').unlink()
    render(program, folder, '--size', '64x48', '--passes', str(more))
    assert (folder / 'image.exr').read_bytes() == image


def test_a_checkpoint_of_all_passes_gives_the_image_at_once(program: Path, folder: Path) -> None:
    first = render(program, folder, *RUN)
    image = (folder / 'image.exr').read_bytes()
    (folder / 'image.exr').unlink()
    second = render(program, folder, *RUN)
    assert (folder / 'image.exr').read_bytes() == image
    assert first['rays'] == second['rays']


@pytest.mark.parametrize('options, complaint', [
    (('--seed', '2'), 'seed'), (('--size', '48x64'), 'size'), (('--view', 'normals'), 'view'),
    (('--passes', '1'), 'more than --passes 1'),
])
def test_a_checkpoint_of_another_run_is_refused(
        program: Path, folder: Path, options: tuple[str, str], complaint: str) -> None:
    render(program, folder, *RUN)
    given = RUN[2:] if options[0] == '--size' else RUN
    assert complaint in refusal(program, folder, *given, *options)


def test_a_checkpoint_of_another_kernel_scene_or_camera_is_refused(
        program: Path, folder: Path) -> None:
    render(program, folder, *RUN)
    other = program.parent / 'bwfirt-funky-kd'
    assert 'its kernel is' in refusal(other, folder, *RUN)
    for name, what in [('box.scene', 'scene'), ('box.camera', 'camera')]:
        path = folder / name
        text = path.read_text()
        path.write_text(text.replace('reflectance 0.5', 'reflectance 0.6')
                            .replace('depth 1', 'depth 1.5'))
        assert f'its {what} is' in refusal(program, folder, *RUN)
        path.write_text(text)
    render(program, folder, *RUN)


@pytest.mark.parametrize('damage', [
    lambda data: b'', lambda data: data[:50], lambda data: data[:-24], lambda data: data + b'x',
    lambda data: bytes(len(data)), lambda data: data[:-1] + bytes([data[-1] ^ 1]),
])
def test_a_damaged_checkpoint_is_refused_and_kept(program: Path, folder: Path, damage) -> None:
    render(program, folder, *RUN)
    path = folder / 'box.checkpoint'
    path.write_bytes(damage(path.read_bytes()))
    assert 'box.checkpoint: is ' in refusal(program, folder, *RUN)


def test_the_reference_is_written_into_the_camera_file(program: Path, folder: Path) -> None:
    camera = (folder / 'box.camera').read_text()
    report = render(program, folder, '--passes', '20', '--reference')
    lines = (folder / 'box.camera').read_text().splitlines()
    assert '\n'.join(lines[:-1]) + '\n' == camera
    average = ' '.join(repr(value) for value in report['average_intensity'])
    assert lines[-1] == (f'referenceAverageIntensity ({average})  # simple-bvh, 16x12, 20 passes, '
                         f"seed 1; standard error {report['standard_error'][0]:.1e}")
    assert render(program, folder, '--passes', '20')['squared_error'] == 0


def test_false_colours_are_no_reference(program: Path, folder: Path) -> None:
    assert '--reference' in refusal(program, folder, '--reference', '--view', 'normals', status=2)
