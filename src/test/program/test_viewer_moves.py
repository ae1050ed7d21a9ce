# SPDX-License-Identifier: GPL-3.0-only
"""Keys and mouse move the camera of the viewer, which prints where it is."""

import time
from pathlib import Path

import numpy as np
import pytest

from display import Display, wait_for
from image import read_png
from program import render
from viewer import HEIGHT, PASSES, WIDTH, Viewer, batch_picture, viewing

POSITION, DIRECTION = np.array([0, 0, 0.9]), np.array([0, 0, -2])
RIGHT, UP, FORWARD = np.eye(3)[0], np.eye(3)[1], -np.eye(3)[2]
CENTRE = (WIDTH // 2, HEIGHT // 2)
ABOVE_MESSAGE = slice(HEIGHT // 2)
LEFT_BUTTON, MIDDLE_BUTTON, RIGHT_BUTTON, WHEEL_UP = 1, 2, 3, 4


def moved(viewer: Viewer, key: str) -> np.ndarray:
    """The way that the camera goes for a key."""
    start = viewer.camera()['position']
    viewer.press(key)
    wait_for(lambda: (viewer.camera()['position'] != start).any(), 'a move')
    return viewer.camera()['position'] - start


def last_camera(folder: Path) -> str:
    """The file of the camera that was printed last."""
    return max(folder.glob('box-*.camera'), key=lambda path: int(path.stem.split('-')[1])).name


def wait_until_seen_from_there(viewer: Viewer, program: Path, folder: Path) -> None:
    """Until the picture is what a batch run renders with the camera that was printed last."""
    expected = batch_picture(program, folder, '--camera', last_camera(folder))
    viewer.wait_until_shown(expected, ABOVE_MESSAGE)


def is_same(one: dict[str, np.ndarray], other: dict[str, np.ndarray]) -> bool:
    return one.keys() == other.keys() and all((one[key] == other[key]).all() for key in one)


@pytest.mark.parametrize('key, expected', [('w', FORWARD), ('s', -FORWARD), ('a', -RIGHT),
                                           ('d', RIGHT), ('e', UP), ('q', -UP)])
def test_a_key_moves_the_camera_its_way(
        display: Display, program: Path, folder: Path, key: str, expected: np.ndarray) -> None:
    with viewing(display, program, folder) as viewer:
        way = moved(viewer, key)
        assert way / np.linalg.norm(way) == pytest.approx(expected, abs=1e-6)
        assert (viewer.camera()['direction'] == DIRECTION).all()
        wait_until_seen_from_there(viewer, program, folder)


def test_forward_is_where_the_camera_looks(display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder) as viewer:
        viewer.drag(LEFT_BUTTON, CENTRE, (CENTRE[0] + 20, CENTRE[1] + 10))
        way, direction = moved(viewer, 'w'), viewer.camera()['direction']
        assert direction[0] > 0.1 and direction[1] < -0.1
        assert way / np.linalg.norm(way) == pytest.approx(direction / np.linalg.norm(direction))


def test_a_key_that_is_held_moves_until_it_is_released(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder) as viewer:
        before = viewer.steady_picture()
        display.xdotool('keydown', 'w')
        wait_for(lambda: viewer.camera()['position'][2] < 0.4, 'a walk of half a unit')
        viewer.wait_until_changed(before, ABOVE_MESSAGE)
        display.xdotool('keyup', 'w')
        end = viewer.camera()
        wait_until_seen_from_there(viewer, program, folder)
        assert is_same(viewer.camera(), end)


def test_a_key_moves_while_errors_are_shown(display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder) as viewer:
        display.xdotool('keydown', 'w', 'key', '5')
        wait_for(lambda: viewer.camera()['position'][2] < 0.4, 'a walk of half a unit')
        display.xdotool('keyup', 'w', 'key', '0')
        viewer.camera()
        wait_until_seen_from_there(viewer, program, folder)


def test_the_picture_turns_as_the_pointer_is_dragged(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder) as viewer:
        viewer.drag(LEFT_BUTTON, CENTRE, (CENTRE[0] + 10, CENTRE[1]), (CENTRE[0] + 25, CENTRE[1]))
        angle = 25 / HEIGHT * np.pi / 2
        to_the_right = viewer.camera()
        assert to_the_right['direction'] == pytest.approx(
            2 * np.array([np.sin(angle), 0, -np.cos(angle)]))
        assert (to_the_right['position'] == POSITION).all()
        wait_until_seen_from_there(viewer, program, folder)

        viewer.press('r')
        viewer.drag(LEFT_BUTTON, CENTRE, (CENTRE[0], CENTRE[1] + 25))
        assert viewer.camera()['direction'] == pytest.approx(
            2 * np.array([0, -np.sin(angle), -np.cos(angle)]))


def test_nothing_turns_unless_the_left_button_is_held(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder) as viewer:
        start = viewer.camera()
        display.xdotool('mousemove', *CENTRE, 'mousemove', 10, 10, 'mousemove', 90, 70)
        assert is_same(viewer.camera(), start)
        for button in [MIDDLE_BUTTON, RIGHT_BUTTON]:
            viewer.drag(button, CENTRE, (CENTRE[0] + 25, CENTRE[1] + 5))
            assert is_same(viewer.camera(), start)
        viewer.drag(LEFT_BUTTON, CENTRE, (CENTRE[0] + 25, CENTRE[1] + 5))
        turned = viewer.camera()
        assert not is_same(turned, start)
        display.xdotool('mousemove', 10, 10, 'mousemove', 90, 70)
        assert is_same(viewer.camera(), turned)
        assert 'triangle' not in viewer.output(), 'a drag is no click'


def test_r_goes_back_to_the_start(display: Display, program: Path, folder: Path) -> None:
    start_picture = batch_picture(program, folder)
    with viewing(display, program, folder) as viewer:
        start = viewer.camera()
        viewer.drag(LEFT_BUTTON, CENTRE, (CENTRE[0] + 25, CENTRE[1] + 5))
        moved(viewer, 'd')
        assert not is_same(viewer.camera(), start)
        viewer.press('r')
        assert is_same(viewer.camera(), start)
        viewer.wait_until_shown(start_picture, ABOVE_MESSAGE)


def test_the_wheel_and_the_keys_change_the_speed(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder) as viewer:
        display.xdotool('key', '--delay', 1, *['minus'] * 40)
        assert 0 < moved(viewer, 'd')[0] < 0.01, 'a thousandth of the speed, for some milliseconds'
        display.xdotool('click', '--repeat', 20, '--delay', 1, WHEEL_UP)
        display.xdotool('key', '--delay', 1, *['plus'] * 20)
        display.xdotool('keydown', 'w')
        wait_for(lambda: viewer.camera()['position'][2] < 0.4, 'a walk of half a unit')
        display.xdotool('keyup', 'w')


def test_the_status_shows_that_shift_is_faster(
        display: Display, program: Path, folder: Path) -> None:
    size = '320x200'
    with viewing(display, program, folder, '--size', size) as viewer:
        viewer.wait_until_shown(batch_picture(program, folder, '--size', size))
        without_status = viewer.steady_picture()
        viewer.press('Tab')
        viewer.wait_until_changed(without_status)
        slow = viewer.steady_picture()
        display.xdotool('keydown', 'Shift_L')
        viewer.wait_until_changed(slow)
        display.xdotool('keyup', 'Shift_L')
        viewer.wait_until_shown(slow)


def test_another_window_with_the_focus_ends_the_walk(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder) as viewer:
        display.xdotool('key', '--delay', 1, *['minus'] * 12)
        display.xdotool('keydown', 'w')
        wait_for(lambda: viewer.camera()['position'][2] < POSITION[2], 'a move')
        with viewing(display, program, folder, '--size', '64x64'):
            def is_still() -> bool:
                before = uncovered()
                time.sleep(0.5)
                return bool((uncovered() == before).all())

            def uncovered() -> np.ndarray:
                return display.screen()[:HEIGHT // 2, 64:WIDTH].copy()
            wait_for(is_still, 'the end of the walk')
            display.xdotool('keyup', 'w')
        viewer.activate()
        end = viewer.camera()
        assert end['position'][2] > -1, 'it went on as far as the wall and through it'
        assert is_same(viewer.camera(), end)


def test_a_printed_camera_gives_a_batch_run_the_same_picture(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder) as viewer:
        viewer.drag(LEFT_BUTTON, CENTRE, (CENTRE[0] - 20, CENTRE[1] + 15))
        moved(viewer, 'e')
        output = len(viewer.output())
        viewer.camera()
        name = last_camera(folder)
        assert viewer.output()[output:] == (folder / name).read_text()
        assert viewer.output()[output:].startswith(f'# {name}: seen ')
        wait_until_seen_from_there(viewer, program, folder)
        picture = viewer.final_picture()
    render(program, folder, '--camera', name, '--passes', f'{PASSES}',
           '--size', f'{WIDTH}x{HEIGHT}')
    difference = np.abs(read_png(folder / 'image.png') - picture)
    assert difference.max() <= 1 and difference.mean() < 0.01


def test_c_keeps_files_that_are_there_already(
        display: Display, program: Path, folder: Path) -> None:
    (folder / 'box-1.camera').write_text('mine')
    with viewing(display, program, folder) as viewer:
        viewer.camera()
        viewer.camera()
    assert (folder / 'box-1.camera').read_text() == 'mine'
    assert {path.name for path in folder.glob('*.camera')} == {
        'box.camera', 'box-1.camera', 'box-2.camera', 'box-3.camera'}
