# SPDX-License-Identifier: GPL-3.0-only
"""Clicks in the viewer pick triangles, make lights of them, and Ctrl+S saves those."""

import os
import re
from pathlib import Path

import numpy as np
import pytest

from box import box_triangles, replace_line
from display import HEIGHT, WIDTH, Display, Viewer, batch_picture, is_smooth, viewing, wait_for
from program import batch_command, complaint, render, run

POSITION, DEPTH, FILM_HEIGHT = np.array([0, 0, 0.9]), 1, 1.5
ON_LIGHT = (60, 2)
COMMENTED = """\
# A box.
triangles box.ra2   # beside this file
lights 1 12 13 10   # below the ceiling
# Grey walls.
reflectance 0.5
"""
ORANGE = (255, 170, 60)


def seen_at(x: int, y: int, width: int = WIDTH, height: int = HEIGHT) -> tuple[int, float]:
    """Triangle and distance at the centre of a pixel, as the camera of the box sees it."""
    direction = np.array([FILM_HEIGHT * width / height * ((x + 0.5) / width - 0.5),
                          FILM_HEIGHT * (0.5 - (y + 0.5) / height), -DEPTH])
    direction /= np.linalg.norm(direction)
    a, b, c = box_triangles().transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    with np.errstate(divide='ignore', invalid='ignore'):
        distance = ((a - POSITION) * normal).sum(axis=1) / (normal @ direction)
        point = POSITION + distance[:, None] * direction
    is_inside = distance > 0
    for corner, following in [(a, b), (b, c), (c, a)]:
        is_inside &= (np.cross(following - corner, point - corner) * normal).sum(axis=1) > 0
    triangle = np.where(is_inside, distance, np.inf).argmin()
    return int(triangle), float(distance[triangle])


def lights_of(text: str) -> list[tuple[int, int, float]]:
    """The last lights that a text has: first and last triangle, and exitance."""
    count, *numbers = text[text.rindex('lights ') + len('lights '):].split()
    entries = [numbers[3 * i:3 * i + 3] for i in range(int(count))]
    return [(int(first), int(last), float(exitance)) for first, last, exitance in entries]


def lights_after(viewer: Viewer, *words: object) -> list[tuple[int, int, float]]:
    """The lights that the viewer prints after this command of xdotool."""
    return lights_of(viewer.answer(r'^lights \d+\n?(.*\d\n)*', *words)[0])


def lights_after_click(viewer: Viewer, x: int, y: int) -> list[tuple[int, int, float]]:
    return lights_after(viewer, 'mousemove', x, y, 'click', 1)


def saved(viewer: Viewer) -> tuple[str, str]:
    """Names of the scene and of the copy of the old one."""
    match = viewer.answer(r'^scene (.*) backup (.*)\n', 'key', 'ctrl+s')
    return Path(match[1]).name, Path(match[2]).name


def picked(viewer: Viewer, x: int, y: int, button: int = 1) -> re.Match:
    return viewer.answer(
        r'^triangle (\d+) distance (\S+) point (\S+) (\S+) (\S+) normal (\S+) (\S+) (\S+) '
        r'area (\S+)\n', 'mousemove', x, y, 'click', button)


# Pixels of the wall behind, the floor, the left wall, the light and the right wall.
PIXELS = [(70, 40), (64, 105), (5, 60), (60, 5), (124, 40)]


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
    (folder / 'brighter.scene').write_text(COMMENTED.replace(' 10 ', ' 16 '))
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


def test_saved_lights_give_what_the_same_scene_written_by_hand_gives(
        display: Display, program: Path, folder: Path) -> None:
    (folder / 'box.scene').write_text(COMMENTED)
    floor = seen_at(64, 105)[0]
    with viewing(display, program, folder) as viewer:
        viewer.press('l')
        lights_after_click(viewer, 64, 105)
        lights = lights_after(viewer, 'key', 'Up')
        assert lights == [(floor, floor, 12.5), (12, 13, 10)]
        assert saved(viewer) == ('box.scene', 'box.scene.bak')
    assert (folder / 'box.scene.bak').read_text() == COMMENTED
    text = (folder / 'box.scene').read_text()
    assert lights_of(text) == lights
    assert re.findall('#.*', text) == re.findall('#.*', COMMENTED)
    (folder / 'hand.scene').write_text(
        f'triangles box.ra2 lights 2 12 13 10 {floor} {floor} 12.5 reflectance 0.5')
    averages = [render(program, folder, '--passes', '8', '--size', '64x48',
                       scene=scene)['average_intensity']
                for scene in ['box.scene', 'hand.scene', 'box.scene.bak']]
    assert averages[0] == pytest.approx(averages[1], rel=0.05), 'other random numbers'
    assert averages[0][0] > 1.2 * averages[2][0]


def test_saving_writes_only_what_has_changed_and_keeps_every_copy(
        display: Display, program: Path, folder: Path) -> None:
    with viewing(display, program, folder) as viewer:
        viewer.press('ctrl+s')
        lights_after(viewer, 'key', 'Up')
        assert saved(viewer) == ('box.scene', 'box.scene.bak')
        viewer.press('ctrl+s', 'ctrl+s')
        lights_after(viewer, 'key', 'Up')
        assert saved(viewer) == ('box.scene', 'box.scene.bak2')
        assert (viewer.camera()['position'] == POSITION).all(), 'Ctrl+S is no s'
    exitances = [lights_of((folder / f'box.scene{end}').read_text())[0][2]
                 for end in ['.bak', '.bak2', '']]
    assert exitances == [10, 12.5, 16]
    assert len(list(folder.glob('*.bak*'))) == 2


def test_a_scene_without_lights_gets_some(display: Display, program: Path, folder: Path) -> None:
    dark = 'triangles box.ra2\nreflectance 0.5\n'
    (folder / 'box.scene').write_text(dark)
    assert 'light' in complaint(run(*batch_command(program), cwd=folder), program, 1)
    ceiling = seen_at(60, 5)[0]
    with viewing(display, program, folder) as viewer:
        assert is_smooth(viewer.picture()[-8:])
        viewer.press('l')
        assert lights_after_click(viewer, 60, 5) == [(ceiling, ceiling, 100)]
        saved(viewer)
    assert (folder / 'box.scene.bak').read_text() == dark
    assert (folder / 'box.scene').read_text() == f'{dark}lights 1 {ceiling} {ceiling} 100\n'
    (folder / 'hand.scene').write_text(
        f'triangles box.ra2 reflectance 0.5 lights 1 {ceiling} {ceiling} 100')
    by_hand = render(program, folder, scene='hand.scene')['average_intensity']
    assert render(program, folder)['average_intensity'] == by_hand


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


def test_a_scene_that_lost_all_its_lights_opens_again(
        display: Display, program: Path, folder: Path) -> None:
    (folder / 'box.scene').write_text('lights 1 12 12 3 triangles box.ra2')
    pixels = {seen_at(x, y)[0]: (x, y) for x in range(WIDTH) for y in range(5)}
    with viewing(display, program, folder) as viewer:
        viewer.press('l')
        assert lights_after_click(viewer, *pixels[12]) == []
        saved(viewer)
    assert (folder / 'box.scene').read_text() == 'lights 0 triangles box.ra2'
    with viewing(display, program, folder) as viewer:
        viewer.press('l')
        assert lights_after_click(viewer, *pixels[13]) == [(13, 13, 100)]


def without_right_to_write() -> tuple:
    """What starts a program that folders of mode 555 are closed to."""
    if os.geteuid() != 0:
        return ()
    command = ('setpriv', '--bounding-set=-dac_override')
    if run(*command, 'true').returncode != 0:
        pytest.skip('root cannot give up its right to write everywhere here')
    return command


def test_a_scene_in_a_read_only_folder_is_kept_and_so_are_the_lights(
        display: Display, program: Path, folder: Path) -> None:
    closed = folder / 'closed'
    closed.mkdir()
    for name in ['box.scene', 'box.ra2']:
        (folder / name).rename(closed / name)
    closed.chmod(0o555)
    old = (closed / 'box.scene').read_text()
    with viewing(display, program, folder, scene='closed/box.scene',
                 before=without_right_to_write(), errors=rf'({program.name}: .*closed.*\n)+'
                 ) as viewer:
        lights_after(viewer, 'key', 'Up')
        viewer.press('ctrl+s')
        wait_for(lambda: viewer.errors().count('\n') == 1, 'a complaint')
        assert lights_after(viewer, 'key', 'Up') == [(12, 13, 16)]
        closed.chmod(0o755)
        assert saved(viewer) == ('box.scene', 'box.scene.bak')
    assert (closed / 'box.scene.bak').read_text() == old
    assert lights_of((closed / 'box.scene').read_text()) == [(12, 13, 16)]


@pytest.mark.parametrize('key', ['c', 'p'])
def test_a_working_folder_that_cannot_be_written_is_a_complaint(
        display: Display, program: Path, folder: Path, key: str) -> None:
    closed = folder / 'closed'
    closed.mkdir(mode=0o555)
    with viewing(display, program, closed, '--camera', '../box.camera', scene='../box.scene',
                 before=without_right_to_write(), errors=rf'{program.name}: box-1\..*\n'
                 ) as viewer:
        viewer.press(key)
        wait_for(viewer.errors, 'a complaint')
        picked(viewer, 70, 40)
    assert list(closed.iterdir()) == []


def test_a_scene_that_does_not_fit_on_the_disk_is_kept(
        display: Display, program: Path, folder: Path) -> None:
    """A limit of the size of files is as good as a small disk."""
    old = COMMENTED + '# and so on\n' * 1000
    (folder / 'box.scene').write_text(old)
    with viewing(display, program, folder, before=('prlimit', '--fsize=4096'),
                 errors=rf'{program.name}: .*box.scene.*\n') as viewer:
        lights_after(viewer, 'key', 'Up')
        viewer.press('ctrl+s')
        wait_for(viewer.errors, 'a complaint')
        lights_after(viewer, 'key', 'Up')
    assert (folder / 'box.scene').read_text() == old
    assert sorted(path.name for path in folder.iterdir()) == ['box.camera', 'box.ra2', 'box.scene']
