# SPDX-License-Identifier: GPL-3.0-only
"""The viewer's window: how it opens, changes its size, and ends, whatever its user does."""

import os
import random
import signal
import time
from pathlib import Path

import numpy as np
import pytest

from box import CAMERA, write_triangles
from display import SCREEN_HEIGHT, SCREEN_WIDTH, Display, wait_for
from program import complaint, run, snapshot
from viewer import HEIGHT, NO_FILE, WIDTH, Viewer, batch_picture, viewing

KEYS = ['w', 'a', 's', 'd', 'q', 'e', 'plus', 'minus', 'KP_Add', 'l', 'u', 'Up', 'Down', 'ctrl+s',
        'c', 'p', '1', '2', '3', '4', '5', '0', 'Prior', 'Next', 'Home', 'r', 'space', 'f', 'Tab',
        'h', 'F1', 'Shift_L', 'alt+x', 'ctrl+w', 'Return', 'z']
TRIANGLES_THAT_TAKE_SECONDS = 2_000_000


def close_window(viewer: Viewer) -> None:
    viewer.press('alt+F4')


def press_escape(viewer: Viewer) -> None:
    viewer.press('Escape')


def interrupt(viewer: Viewer) -> None:
    viewer.process.send_signal(signal.SIGINT)


def terminate(viewer: Viewer) -> None:
    viewer.process.send_signal(signal.SIGTERM)


ENDS = pytest.mark.parametrize('end', [close_window, press_escape, interrupt, terminate])


@ENDS
def test_every_way_to_end_it_is_a_success(
        display: Display, program: Path, folder: Path, end) -> None:
    with viewing(display, program, folder, '--passes', '1000000') as viewer:
        end(viewer)
        assert viewer.status() == 0
        assert viewer.output() == ''


@pytest.fixture(scope='module')
def large(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a scene for which a kernel needs seconds."""
    folder = tmp_path_factory.mktemp('large')
    corners = np.random.default_rng(1).uniform(-1, 1, (TRIANGLES_THAT_TAKE_SECONDS, 1, 3))
    edges = np.random.default_rng(2).uniform(-0.01, 0.01, (TRIANGLES_THAT_TAKE_SECONDS, 3, 3))
    write_triangles(folder / 'box.ra2', corners + edges)
    (folder / 'box.scene').write_text('triangles box.ra2\nlights 1 0 9 100\n')
    (folder / 'box.camera').write_text(CAMERA)
    return folder


@ENDS
def test_it_ends_while_the_kernel_builds(
        display: Display, program: Path, large: Path, end) -> None:
    with viewing(display, program, large, is_ready=False) as viewer:
        viewer.display.xdotool('key', '--delay', 1, 'w', 'l', 'p', 'c', 'h', '5', 'ctrl+s', 'h')
        viewer.click(WIDTH // 2, HEIGHT // 2)
        end(viewer)
        assert viewer.status() == 0


@pytest.mark.parametrize('environment', [{}, {'DISPLAY': ':987'}, {'DISPLAY': 'nonsense'}])
def test_without_a_display_it_says_so(program: Path, folder: Path, environment: dict) -> None:
    before = snapshot(folder)
    kept = {name: value for name, value in os.environ.items()
            if name not in ['DISPLAY', 'WAYLAND_DISPLAY']}
    result = run(program, '--camera', 'box.camera', 'box.scene', cwd=folder, env=kept | environment)
    assert 'display' in complaint(result, program, 1)
    assert result.stdout == '' and snapshot(folder) == before


@pytest.mark.parametrize('name, content', [
    ('box.scene', 'triangles none.ra2'), ('box.scene', 'lights 1 12 99 1 triangles box.ra2'),
    ('box.scene', 'what is this'), ('box.ra2', 'no triangles'), ('box.camera', 'type fisheye\n')])
def test_a_bad_file_is_one_line(
        display: Display, program: Path, folder: Path, name: str, content: str) -> None:
    (folder / name).write_text(content)
    result = run(program, '--camera', 'box.camera', 'box.scene', cwd=folder,
                 env=display.environment)
    assert complaint(result, program, 1)


@pytest.mark.parametrize('options', [
    ('--output', 'image'), ('--report', 'report.json'), ('--checkpoint', 'sums'),
    ('--record', 'box.rays'), ('--reference',)])
def test_options_of_a_batch_run_are_wrong_usage(
        display: Display, program: Path, folder: Path, options: tuple[str, ...]) -> None:
    result = run(program, '--camera', 'box.camera', *options, 'box.scene', cwd=folder,
                 env=display.environment)
    message = complaint(result, program, 2)
    assert options[0] in message and '--batch' in message


def test_without_a_camera_file_it_finds_a_place(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder, '--camera', NO_FILE) as viewer:
        assert viewer.camera().keys() >= {'position', 'direction', 'up', 'depth', 'filmSizeY'}


def resize(viewer: Viewer, width: int, height: int) -> None:
    viewer.display.xdotool('windowsize', viewer.window, width, height)


def wait_for_size(viewer: Viewer, width: int, height: int) -> None:
    wait_for(lambda: viewer.size() == (width, height), f'a size of {width}x{height}')


@pytest.mark.parametrize('width, height', [(64, 64), (201, 99), (90, 300)])
def test_the_picture_fits_a_window_that_changes_its_size(
        display: Display, program: Path, folder: Path, width: int, height: int) -> None:
    with viewing(display, program, folder) as viewer:
        resize(viewer, width, height)
        viewer.wait_until_shown(batch_picture(program, folder, '--size', f'{width}x{height}'))


def test_many_changes_of_the_size_end_in_the_picture_of_the_last(
        display: Display, program: Path, folder: Path) -> None:
    expected = batch_picture(program, folder, '--size', '150x131')
    with viewing(display, program, folder) as viewer:
        sizes = [(64 + 13 * i % 300, 64 + 29 * i % 200) for i in range(20)]
        for width, height in [*sizes, (150, 131)]:
            resize(viewer, width, height)
        viewer.wait_until_shown(expected)


def test_f_fills_the_screen_and_goes_back(display: Display, program: Path, folder: Path) -> None:
    picture = batch_picture(program, folder)
    with viewing(display, program, folder) as viewer:
        viewer.press('f')
        wait_for_size(viewer, SCREEN_WIDTH, SCREEN_HEIGHT)
        viewer.press('f')
        wait_for_size(viewer, WIDTH, HEIGHT)
        viewer.wait_until_shown(picture)


def test_the_picture_is_there_again_after_the_window_was_an_icon(
        display: Display, program: Path, folder: Path) -> None:
    picture = batch_picture(program, folder)
    with viewing(display, program, folder) as viewer:
        viewer.wait_until_shown(picture)
        display.xdotool('windowminimize', viewer.window)
        wait_for(lambda: display.screen().max() == 0, 'an empty screen')
        viewer.activate()
        viewer.wait_until_shown(picture)
        assert viewer.saved_picture()[1] > 0


def test_nothing_is_rendered_while_the_window_is_an_icon(
        display: Display, program: Path, folder: Path) -> None:
    """The program then uses a twentieth of a processor at most. Else it uses all that it gets."""
    def processor_seconds() -> float:
        fields = Path(f'/proc/{viewer.process.pid}/stat').read_text().rsplit(')', 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')

    def rests() -> bool:
        before, start = processor_seconds(), time.monotonic()
        time.sleep(2)
        return processor_seconds() - before < (time.monotonic() - start) / 20

    with viewing(display, program, folder, '--passes', '1000000') as viewer:
        display.xdotool('windowminimize', viewer.window)
        wait_for(rests, 'a rest')
        viewer.activate()
        passes = viewer.saved_picture()[1]
        wait_for(lambda: viewer.saved_picture()[1] > passes, 'more passes')


@pytest.mark.parametrize('size', ['64x64', f'{WIDTH}x{HEIGHT}'])
def test_it_survives_whatever_is_pressed_and_clicked(
        display: Display, program: Path, folder: Path, size: str) -> None:
    dice = random.Random(size)
    with viewing(display, program, folder, '--size', size, '--passes', '1000000') as viewer:
        words = []
        for _ in range(150):
            key = dice.choice(KEYS)
            words += dice.choice([['key', key], ['key', key], ['keydown', key], ['keyup', key],
                                  ['mousedown', dice.choice([1, 3])], ['mouseup', 1],
                                  ['mouseup', 3], ['click', dice.randint(1, 5)],
                                  ['mousemove', dice.randrange(60), dice.randrange(60)]])
        display.xdotool(*words)
        for key in KEYS:
            display.xdotool('keyup', key)
        display.xdotool('mouseup', 1, 'mouseup', 3)
        viewer.camera()
