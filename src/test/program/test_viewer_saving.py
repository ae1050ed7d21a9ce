# SPDX-License-Identifier: GPL-3.0-only
"""Ctrl+S in the viewer writes the lights into the scene file, and never loses any."""

import os
import re
from pathlib import Path

import pytest

from display import Display, wait_for
from picking import (POSITION, lights_after, lights_after_click, lights_of, picked, saved,
                     seen_at)
from program import batch_command, complaint, mounted_disk, render, run
from viewer import WIDTH, is_smooth, viewing

COMMENTED = """\
# A box.
triangles box.ra2   # beside this file
lights 1 12 13 10   # below the ceiling
# Grey walls.
reflectance 0.5
"""


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
    old = COMMENTED + '# and so on\n' * 1000
    with mounted_disk(folder, '16k') as disk:
        (disk / 'box.scene').write_text(old)
        (disk / 'box.ra2').symlink_to(folder / 'box.ra2')
        with viewing(display, program, folder, scene=disk / 'box.scene',
                     errors=rf'{program.name}: .*box.scene.*\n') as viewer:
            lights_after(viewer, 'key', 'Up')
            viewer.press('ctrl+s')
            wait_for(viewer.errors, 'a complaint')
            lights_after(viewer, 'key', 'Up')
        assert (disk / 'box.scene').read_text() == old
        assert sorted(path.name for path in disk.iterdir()) == ['box.ra2', 'box.scene']


def test_a_scene_that_was_spoilt_or_removed_meanwhile_is_a_complaint(
        display: Display, program: Path, folder: Path) -> None:
    scene = folder / 'box.scene'
    with viewing(display, program, folder,
                 errors=rf'({program.name}: .*box.scene: ?.*\n){{2}}') as viewer:
        lights_after(viewer, 'key', 'Up')
        scene.unlink()
        viewer.press('ctrl+s')
        wait_for(lambda: viewer.errors().count('\n') == 1, 'a complaint')
        scene.write_text('garbage')
        viewer.press('ctrl+s')
        wait_for(lambda: viewer.errors().count('\n') == 2, 'another complaint')
        assert scene.read_text() == 'garbage' and not list(folder.glob('*.bak*'))
        scene.write_text(COMMENTED)
        assert saved(viewer) == ('box.scene', 'box.scene.bak')
    assert lights_of(scene.read_text()) == [(12, 13, 12.5)]
