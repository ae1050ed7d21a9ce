# SPDX-License-Identifier: GPL-3.0-only
"""The viewer in a window, what its user does and sees, and what a batch run renders instead."""

import os
import re
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

import numpy as np

from display import POLL_S, Display, wait_for
from image import read_exr, read_png, srgb
from program import TIMEOUT_S, render

WIDTH, HEIGHT = 128, 112
PASSES = 8
OPTIONS = {'--camera': 'box.camera', '--size': f'{WIDTH}x{HEIGHT}', '--passes': f'{PASSES}',
           '--threads': '2'}
NO_FILE = 'no file'
QUIT = 'Escape'


def content(file: IO) -> str:
    """All that a process has written so far, without a move of the position that they share."""
    return os.pread(file.fileno(), os.fstat(file.fileno()).st_size, 0).decode()


class Viewer:
    """A viewer that runs, and what its user does and sees."""

    def __init__(self, display: Display, command: list, folder: Path) -> None:
        self.display = display
        self.folder = folder
        self._output, self._errors = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        self.process = subprocess.Popen(
            [str(word) for word in command], cwd=folder, env=display.environment,
            stdin=subprocess.DEVNULL, stdout=self._output, stderr=self._errors,
            # A shell lets what it runs in the background ignore this signal.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))

    def wait_for_window(self) -> None:
        """Until it has the focus, and something has been drawn."""
        def find() -> str | None:
            assert self.process.poll() is None, self.errors()
            found = self.display.try_xdotool('search', '--onlyvisible', '--pid', self.process.pid)
            return found.split()[0] if found else None
        self.window = wait_for(find, 'the window')
        self.activate()
        wait_for(lambda: self.picture().std() > 1, 'a text, or the picture')

    def is_active(self) -> bool:
        active = self.display.try_xdotool('getactivewindow')
        return active is not None and active.strip() == self.window

    def activate(self) -> None:
        """Gives the window the keyboard, also where it is an icon."""
        if not self.is_active():
            self.display.xdotool('windowactivate', self.window)
        wait_for(self.is_active, 'the focus')

    def press(self, *keys: str) -> None:
        self.display.xdotool('key', *keys)

    def click(self, x: int, y: int, button: int = 1) -> None:
        self.display.xdotool('mousemove', x, y, 'click', button)

    def drag(self, button: int, *path: tuple[int, int]) -> None:
        """Holds a button from the first of these points to the last."""
        first, *others = path
        moves = [word for point in others for word in ('mousemove', *point)]
        self.display.xdotool('mousemove', *first, 'mousedown', button, *moves, 'mouseup', button)

    def output(self) -> str:
        return content(self._output)

    def errors(self) -> str:
        return content(self._errors)

    def answer(self, pattern: str, *words: object) -> re.Match:
        """What the viewer prints after this command of xdotool, as soon as it fits."""
        seen = len(self.output())
        self.display.xdotool(*words)
        return wait_for(lambda: re.search(pattern, self.output()[seen:], re.M), pattern)

    def size(self) -> tuple[int, int]:
        """Width and height of the window."""
        answer = self.display.xdotool('getwindowgeometry', '--shell', self.window)
        values = dict(line.split('=') for line in answer.splitlines())
        return int(values['WIDTH']), int(values['HEIGHT'])

    def picture(self) -> np.ndarray:
        """What the window shows, panels included."""
        width, height = self.size()
        return self.display.screen()[:height, :width]

    def wait_for_picture(self, what: str = 'the first picture') -> None:
        """Until the scene is seen. While it loads, all is black but for a panel in the middle."""
        wait_for(lambda: self.picture()[-8:].std() > 1, what)

    def wait_until_shown(self, expected: np.ndarray, rows: slice = slice(None)) -> None:
        """Until the window agrees with an image to one level of 255, here in some of its rows."""
        def is_shown() -> bool:
            picture = self.picture()
            return (picture.shape == expected.shape
                    and np.abs(picture[rows] - expected[rows]).max() <= 1)
        wait_for(is_shown, 'the picture that is expected')

    def wait_until_changed(self, old: np.ndarray, rows: slice = slice(None)) -> None:
        """Until a pixel of these rows differs from an image by more than a level."""
        def is_changed() -> bool:
            return np.abs(self.picture()[rows].astype(int) - old[rows]).max() > 1
        wait_for(is_changed, 'another picture')

    def steady_picture(self) -> np.ndarray:
        """What the window shows once it has stopped to change."""
        def steady() -> list[np.ndarray]:
            before = self.picture()
            time.sleep(5 * POLL_S)
            after = self.picture()
            return [after.astype(int)] if np.array_equal(before, after) else []
        return wait_for(steady, 'a picture that does not change')[0]

    def saved_picture(self) -> tuple[Path, int]:
        """Writes the picture; its file and how many passes it has."""
        match = self.answer(r'^picture (.*) passes (\d+)\n', 'key', 'p')
        return self.folder / match[1], int(match[2])

    def final_picture(self) -> np.ndarray:
        """The picture when all passes are done, without panels."""
        def final() -> Path | None:
            path, passes = self.saved_picture()
            return path if passes == PASSES else None
        return read_png(wait_for(final, f'{PASSES} passes')).astype(int)

    def camera(self) -> dict[str, np.ndarray]:
        """Where the camera is, as it prints it."""
        text = self.answer(r'^# .*\ntype pinhole\n(.*\n)*sensorResponse .*\n', 'key', 'c')[0]
        lines = [line.split() for line in text.splitlines()[2:]]
        return {key: np.array(values, float) for key, *values in lines}

    def quit(self) -> None:
        self.activate()
        self.press(QUIT)

    def status(self) -> int:
        """The exit status, once it has ended."""
        return self.process.wait(TIMEOUT_S)


def with_defaults(options: tuple[str | Path, ...]) -> list[str | Path]:
    """These options and those of OPTIONS that are not given; none whose value is NO_FILE."""
    settings = OPTIONS | dict(zip(options[::2], options[1::2]))
    return [word for name, value in settings.items() if value != NO_FILE for word in (name, value)]


@contextmanager
def viewing(display: Display, program: Path, folder: Path, *options: str | Path,
            scene: str | Path = 'box.scene', before: tuple = (), errors: str = '',
            is_ready: bool = True) -> Iterator[Viewer]:
    """A viewer with OPTIONS, unless they are given, that ends well and has no complaints.

    It has ended when the test is over, or is asked to. The errors are a regular expression; before
    is what starts the program, where something has to. A viewer that is not ready may be loading.
    """
    viewer = Viewer(display, [*before, program, *with_defaults(options), scene], folder)
    try:
        viewer.wait_for_window()
        if is_ready:
            viewer.wait_for_picture()
        yield viewer
        if viewer.process.poll() is None:
            viewer.quit()
        assert viewer.status() == 0, viewer.errors()
        assert re.fullmatch(errors, viewer.errors()), viewer.errors()
    finally:
        viewer.process.kill()
        viewer.process.wait()


def batch_picture(program: Path, folder: Path, *options: str | Path, scene: str = 'box.scene',
                  factor: float = 1) -> np.ndarray:
    """What a batch run with OPTIONS gives, in sRGB, made brighter by a factor before."""
    render(program, folder, *with_defaults(options), '--output', 'expected', scene=scene)
    return srgb(factor * read_exr(folder / 'expected.exr'))


def is_smooth(image: np.ndarray) -> bool:
    """Whether neighbours are alike, as they are not in a picture of some passes of light."""
    return bool(np.median(np.abs(np.diff(image[..., 0].astype(int), axis=1))) <= 1)
