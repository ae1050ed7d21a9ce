# SPDX-License-Identifier: GPL-3.0-only
"""Clicks in the viewer pick triangles, and make lights of them."""

from pathlib import Path

import numpy as np
import pytest

from box import SCENE, box_triangles, replace_line
from display import Display, wait_for
from picking import POSITION, lights_after, lights_after_click, picked, seen_at
from viewer import HEIGHT, WIDTH, batch_picture, is_smooth, viewing

ON_LIGHT = (60, 2)
ORANGE = (255, 170, 60)

# Pixels of the wall behind, the floor, the left wall, the light and the right wall.
PIXELS = [(70, 40), (64, 105), (5, 60), ON_LIGHT, (124, 40)]


@pytest.mark.parametrize('button', [1, 2, 3])
def test_a_click_picks_the_triangle_under_it(
        display: Display, program: Path, folder: Path, button: int) -> None:
    assert len({seen_at(*pixel)[0] for pixel in PIXELS}) == len(PIXELS)
    with viewing(display, program, folder) as viewer:
        for x, y in PIXELS:
            numbers = [float(word) for word in picked(viewer, x, y, button).groups()]
            triangle, distance = seen_at(x, y)
            assert numbers[0] == triangle
            assert numbers[1] == pytest.approx(distance, rel=1e-5)
            point, normal = np.array(numbers[2:5]), np.array(numbers[5:8])
            corners = box_triangles()[triangle]
            assert np.linalg.norm(point - POSITION) == pytest.approx(distance, rel=1e-5)
            expected = np.cross(corners[1] - corners[0], corners[2] - corners[0])
            assert normal == pytest.approx(expected / np.linalg.norm(expected), abs=1e-6)
            assert numbers[8] == pytest.approx(np.linalg.norm(expected) / 2, rel=1e-5)


def test_a_click_of_a_hand_that_trembles_is_still_a_click(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder) as viewer:
        match = viewer.answer(r'^triangle (\d+) ', 'mousemove', 70, 40, 'mousedown', 1,
                              'mousemove', 72, 41, 'mouseup', 1)
        assert int(match[1]) == seen_at(72, 41)[0]
        assert (viewer.camera()['direction'] == [0, 0, -2]).all()


def test_a_click_beside_all_triangles_says_so(
        display: Display, program: Path, folder: Path) -> None:
    replace_line(folder / 'box.camera', 'position', 'position 0 0 5')
    replace_line(folder / 'box.camera', 'direction', 'direction 0 2 -4')
    with viewing(display, program, folder, '--view', 'normals') as viewer:
        viewer.answer(r'^triangle none\n', 'mousemove', 10, 10, 'click', 1)
        viewer.answer(r'^triangle \d+ ', 'mousemove', WIDTH // 2, HEIGHT - 5, 'click', 1)


def test_the_picked_triangle_gets_an_outline(
        display: Display, program: Path, folder: Path) -> None:
    size = '400x300'
    below_text = slice(150, 300)
    picture = batch_picture(program, folder, '--size', size)
    with viewing(display, program, folder, '--size', size) as viewer:
        viewer.wait_until_shown(picture)
        viewer.click(200, 290)
        wait_for(lambda: (viewer.picture()[below_text] == ORANGE).all(axis=2).sum() > 100,
                 'an orange line')


def test_clicks_make_lights_in_light_mode_only(
        display: Display, program: Path, folder: Path) -> None:
    wall, floor = seen_at(70, 40)[0], seen_at(64, 105)[0]
    with viewing(display, program, folder) as viewer:
        picked(viewer, 70, 40)
        viewer.press('l')
        assert lights_after_click(viewer, 64, 105) == [(floor, floor, 10), (12, 13, 10)]
        viewer.press('l')
        picked(viewer, 70, 40)
        viewer.press('l')
        assert lights_after_click(viewer, 70, 40) == sorted(
            [(wall, wall, 10), (floor, floor, 10), (12, 13, 10)])
        assert viewer.output().count('lights ') == 2


def test_a_click_on_a_light_removes_it_and_u_undoes(
        display: Display, program: Path, folder: Path) -> None:
    triangle = seen_at(*ON_LIGHT)[0]
    other, = {12, 13} - {triangle}
    with viewing(display, program, folder) as viewer:
        viewer.press('l')
        assert lights_after_click(viewer, *ON_LIGHT) == [(other, other, 10)]
        assert lights_after_click(viewer, *ON_LIGHT) == [(12, 13, 10)]
        assert lights_after(viewer, 'key', 'u') == [(other, other, 10)]
        assert lights_after(viewer, 'key', 'u') == [(12, 13, 10)]
        viewer.press('u', 'u')
        assert lights_after_click(viewer, *ON_LIGHT) == [(other, other, 10)]


def test_up_and_down_change_the_exitance_and_the_picture(
        display: Display, program: Path, folder: Path) -> None:
    top = slice(HEIGHT // 2)
    (folder / 'brighter.scene').write_text(SCENE.replace('12 13 10', '12 13 16'))
    normal, brighter = (batch_picture(program, folder, scene=scene)
                        for scene in ['box.scene', 'brighter.scene'])
    with viewing(display, program, folder) as viewer:
        assert lights_after(viewer, 'key', 'Up') == [(12, 13, 12.5)]
        assert lights_after(viewer, 'key', 'Up') == [(12, 13, 16)]
        viewer.wait_until_shown(brighter, top)
        assert lights_after(viewer, 'key', 'Down') == [(12, 13, 12.5)]
        assert lights_after(viewer, 'key', 'Down') == [(12, 13, 10)]
        viewer.wait_until_shown(normal, top)
        assert lights_after(viewer, 'key', 'Down') == [(12, 13, 8)]
        assert lights_after(viewer, 'key', 'u') == [(12, 13, 10)]


def test_all_lights_may_go_and_come_back(display: Display, program: Path, folder: Path) -> None:
    height = 180
    below_text = slice(140, height)
    pixels = {seen_at(x, y, height=height)[0]: (x, y) for x in range(WIDTH) for y in range(9)}
    light = batch_picture(program, folder, '--size', f'{WIDTH}x{height}')
    with viewing(display, program, folder, '--size', f'{WIDTH}x{height}') as viewer:
        viewer.press('l')
        lights_after_click(viewer, *pixels[12])
        assert lights_after_click(viewer, *pixels[13]) == []
        viewer.press('l')
        wait_for(lambda: is_smooth(viewer.picture()[below_text]), 'even light')
        viewer.press('l')
        assert lights_after_click(viewer, *pixels[13]) == [(13, 13, 10)]
        assert lights_after_click(viewer, *pixels[12]) == [(12, 13, 10)]
        viewer.press('l')
        viewer.wait_until_shown(light, below_text)
