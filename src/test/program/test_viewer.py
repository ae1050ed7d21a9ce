# SPDX-License-Identifier: GPL-3.0-only
"""What the viewer shows: light, false colours, exposure, help and status."""

import re
import time
from pathlib import Path

import numpy as np
import pytest

from box import box_triangles, replace_line, write_triangles
from display import Display, wait_for
from image import read_png
from program import REPOSITORY, run
from viewer import HEIGHT, WIDTH, Viewer, batch_picture, is_smooth, viewing

BELOW_LEGEND = slice(80, HEIGHT)


def is_grey(image: np.ndarray) -> bool:
    return int((image.max(axis=2).astype(int) - image.min(axis=2)).max()) <= 1


def brightness_is_below(viewer: Viewer, share: float, of: float) -> bool:
    return viewer.picture().mean() < share * of


@pytest.mark.parametrize('program', ['simple-bvh', 'funky-kd'], indirect=True)
def test_the_window_shows_what_a_batch_run_renders(
        display: Display, program: Path, folder: Path) -> None:
    expected = batch_picture(program, folder)
    with viewing(display, program, folder) as viewer:
        viewer.wait_until_shown(expected)
        assert np.abs(viewer.final_picture() - expected).max() <= 1


def test_the_seed_reaches_the_picture(display: Display, program: Path, folder: Path) -> None:
    expected = batch_picture(program, folder, '--seed', '7')
    assert np.abs(expected - batch_picture(program, folder)).max() > 100
    with viewing(display, program, folder, '--seed', '7') as viewer:
        viewer.wait_until_shown(expected)


@pytest.mark.parametrize('key, view', [('1', 'normals'), ('2', 'triangles'), ('3', 'distance'),
                                       ('4', 'queries')])
def test_a_digit_shows_the_false_colours_of_a_batch_run(
        display: Display, program: Path, folder: Path, key: str, view: str) -> None:
    expected = batch_picture(program, folder, '--view', view)
    with viewing(display, program, folder) as viewer:
        viewer.press(key)
        viewer.wait_until_shown(expected, BELOW_LEGEND)


def test_the_same_digit_or_0_shows_light_again(
        display: Display, program: Path, folder: Path) -> None:
    light, normals = batch_picture(program, folder), batch_picture(program, folder, '--view',
                                                                   'normals')
    with viewing(display, program, folder) as viewer:
        for back in '10':
            viewer.press('1')
            viewer.wait_until_shown(normals, BELOW_LEGEND)
            viewer.press(back)
            viewer.wait_until_shown(light, BELOW_LEGEND)


def test_a_view_of_the_command_line_is_shown_first(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder, '--view', 'distance') as viewer:
        viewer.wait_until_shown(batch_picture(program, folder, '--view', 'distance'))


def test_4_shows_queries_and_then_the_time_of_h(
        display: Display, program: Path, folder: Path) -> None:
    queries = batch_picture(program, folder, '--view', 'queries')
    with viewing(display, program, folder) as viewer:
        viewer.press('4')
        viewer.wait_until_shown(queries, BELOW_LEGEND)
        viewer.press('4')
        viewer.wait_until_changed(queries, BELOW_LEGEND)
        assert not is_grey(viewer.picture()[BELOW_LEGEND]), 'times have the colours of a scale'
        viewer.press('4')
        viewer.wait_until_shown(queries, BELOW_LEGEND)


@pytest.mark.parametrize('program', ['funky-kd'], indirect=True)
def test_5_shows_a_right_kernel_without_a_coloured_pixel(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder) as viewer:
        viewer.press('5')
        wait_for(lambda: is_smooth(viewer.picture()[BELOW_LEGEND]), 'a picture without noise')
        errors = viewer.final_picture()
        assert is_smooth(errors) and is_grey(errors) and errors.mean() > 10


@pytest.mark.parametrize('program', ['yourkernel'], indirect=True)
def test_5_shows_wrong_answers_in_colour(display: Display, program: Path, folder: Path) -> None:
    """So far from the origin the kernels round differently, and disagree."""
    write_triangles(folder / 'box.ra2', box_triangles() + [300_000, 0, 0])
    replace_line(folder / 'box.camera', 'position', 'position 300000 0 0.9')
    warning = f'{program.name}: warning: the largest coordinate is .*\n'
    with viewing(display, program, folder, errors=warning) as viewer:
        viewer.press('5')
        wait_for(lambda: not is_grey(viewer.picture()[BELOW_LEGEND]), 'coloured pixels')


def test_5_says_where_there_is_nothing_to_compare_with(
        display: Display, program: Path, folder: Path) -> None:
    alone = folder / program.name
    alone.write_bytes(program.read_bytes())
    alone.chmod(0o755)
    light = batch_picture(program, folder)
    with viewing(display, alone, folder) as viewer:
        viewer.press('5')
        viewer.wait_until_changed(light, BELOW_LEGEND)
        assert is_grey(viewer.picture()[BELOW_LEGEND])
        viewer.press('0')
        viewer.wait_until_shown(light, BELOW_LEGEND)


def test_two_steps_of_exposure_are_one_stop(display: Display, program: Path, folder: Path) -> None:
    as_it_is, brighter, darker = (batch_picture(program, folder, factor=factor)
                                  for factor in [1, 2, 0.5])
    with viewing(display, program, folder) as viewer:
        viewer.press('Prior', 'Prior')
        viewer.wait_until_shown(brighter)
        viewer.press('Home')
        viewer.wait_until_shown(as_it_is)
        viewer.press('Next', 'Next')
        viewer.wait_until_shown(darker)


@pytest.mark.parametrize('key', ['h', 'F1', 'Tab'])
def test_a_key_shows_a_panel_and_hides_it(
        display: Display, program: Path, folder: Path, key: str) -> None:
    picture = batch_picture(program, folder)
    with viewing(display, program, folder) as viewer:
        viewer.wait_until_shown(picture)
        viewer.press(key)
        wait_for(lambda: brightness_is_below(viewer, 0.9, picture.mean()), 'a dark panel')
        viewer.press(key)
        viewer.wait_until_shown(picture)


def test_h_and_f1_show_the_same_help(display: Display, program: Path, folder: Path) -> None:
    picture = batch_picture(program, folder)
    with viewing(display, program, folder) as viewer:
        viewer.wait_until_shown(picture)
        viewer.press('h')
        wait_for(lambda: brightness_is_below(viewer, 0.9, picture.mean()), 'a dark panel')
        seen = viewer.steady_picture()
        viewer.press('F1')
        viewer.wait_until_shown(picture)
        viewer.press('F1')
        viewer.wait_until_shown(seen)


def help_of(program: Path) -> list[str]:
    """The lines of --help that tell of the viewer."""
    text = run(program, '--help').stdout
    return re.search(r'^The viewer, without --batch:\n((?:.+\n)+)\n', text, re.M)[1].splitlines()


def test_the_help_names_every_key(program: Path) -> None:
    text = '\n'.join(help_of(program))
    for key in ['w a s d', 'q e', 'Shift', 'wheel', 'click', ' l ', ' u ', 'Up Down', r'Ctrl\+S',
                ' c ', ' p ', '1 2 3', ' 4 ', ' 5 ', ' 0 ', 'PageUp PageDown, Home', ' r ', 'Space',
                ' f ', 'Tab', 'h F1', 'Esc']:
        assert re.search(key, text), key


def test_the_documentation_lists_the_keys_as_the_help_does(program: Path) -> None:
    documentation = (REPOSITORY / 'doc' / 'viewer').read_text()
    documented = [line.strip() for line in documentation.splitlines()]
    assert not [line for line in help_of(program) if line.strip() not in documented]


def test_space_pauses(display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder, '--passes', '1000000') as viewer:
        def passes() -> int:
            return viewer.saved_picture()[1]

        def is_still() -> bool:
            before = passes()
            time.sleep(0.5)
            return passes() == before

        first = passes()
        wait_for(lambda: passes() > first + 5, 'more passes')
        viewer.press('space')
        wait_for(is_still, 'the pause')
        paused = passes()
        viewer.press('space')
        wait_for(lambda: passes() > paused + 5, 'passes after the pause')


def test_passes_end_when_all_that_were_asked_for_are_done(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder, '--passes', '3') as viewer:
        wait_for(lambda: viewer.saved_picture()[1] >= 3, 'three passes')
        assert [viewer.saved_picture()[1] for _ in range(5)] == [3] * 5


def test_p_writes_files_that_are_not_there_yet(
        display: Display, program: Path, folder: Path) -> None:
    (folder / 'box-2.png').write_text('mine')
    with viewing(display, program, folder) as viewer:
        files = [viewer.saved_picture()[0].name for _ in range(3)]
    assert files == ['box-1.png', 'box-3.png', 'box-4.png']
    assert (folder / 'box-2.png').read_text() == 'mine'
    assert read_png(folder / 'box-4.png').shape == (HEIGHT, WIDTH, 3)
