# SPDX-License-Identifier: GPL-3.0-only
"""A display without a monitor, driven by xdotool and seen as a file.

Windows have no borders and open in the upper left corner, so that a pixel of the only window is the
same pixel of the screen.
"""

import os
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

import numpy as np

from program import TIMEOUT_S, run

SCREEN_WIDTH, SCREEN_HEIGHT = 640, 480
POLL_S = 0.02

WINDOW_MANAGER = """\
<openbox_config xmlns="http://openbox.org/3.4/rc">
  <theme><keepBorder>no</keepBorder></theme>
  <focus><focusNew>yes</focusNew></focus>
  <keyboard><keybind key="A-F4"><action name="Close"/></keybind></keyboard>
  <applications>
    <application class="*">
      <decor>no</decor>
      <position force="yes"><x>0</x><y>0</y></position>
    </application>
  </applications>
</openbox_config>
"""

Value = TypeVar('Value')


def wait_for(state: Callable[[], Value], what: str) -> Value:
    """Looks until there is something true, which it returns."""
    end = time.monotonic() + TIMEOUT_S
    while True:
        value = state()
        if value:
            return value
        assert time.monotonic() < end, f'{what}: not within {TIMEOUT_S} s'
        time.sleep(POLL_S)


class Display:
    """A screen that is a file, with a window manager, a keyboard and a mouse."""

    def __init__(self, number: int, frame_buffer: Path) -> None:
        self.environment = {name: value for name, value in os.environ.items()
                            if name != 'WAYLAND_DISPLAY'} | {'DISPLAY': f':{number}'}
        self._frame_buffer = frame_buffer

    def try_xdotool(self, *words: object) -> str | None:
        """What xdotool says; None where it fails, as it does where it finds no window."""
        result = run('xdotool', *map(str, words), env=self.environment)
        return result.stdout if result.returncode == 0 else None

    def xdotool(self, *words: object) -> str:
        answer = self.try_xdotool(*words)
        assert answer is not None, f'xdotool {words} failed'
        return answer

    def screen(self) -> np.ndarray:
        """Rows, columns and RGB of all that is seen now. The file's format is that of xwd."""
        data = self._frame_buffer.read_bytes()
        header = np.frombuffer(data, '>u4', 25)
        header_size, width, height, line_size, colours = header[[0, 4, 5, 12, 19]]
        rows = np.frombuffer(data, np.uint8, height * line_size, header_size + 12 * colours)
        return rows.reshape(height, line_size // 4, 4)[:, :width, 2::-1]


@contextmanager
def ended(process: subprocess.Popen) -> Iterator[None]:
    try:
        yield
    finally:
        process.terminate()
        process.wait(TIMEOUT_S)


@contextmanager
def virtual_display(folder: Path) -> Iterator[Display]:
    """Keys of this display never repeat: how long one is held depends on the machine's load."""
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        ['Xvfb', '-displayfd', str(write_end), '-fbdir', folder, '-screen', '0',
         f'{SCREEN_WIDTH}x{SCREEN_HEIGHT}x24', '-nocursor', '-r', '-noreset', '-nolisten', 'tcp'],
        pass_fds=[write_end], stderr=subprocess.DEVNULL)
    os.close(write_end)
    with ended(server):
        with open(read_end) as answer:
            number = answer.readline()
        assert number, 'Xvfb did not start'
        display = Display(int(number), folder / 'Xvfb_screen0')
        settings = folder / 'openbox.xml'
        settings.write_text(WINDOW_MANAGER)
        manager = subprocess.Popen(['openbox', '--config-file', settings], env=display.environment,
                                   stderr=subprocess.DEVNULL)
        with ended(manager):
            wait_for(lambda: display.try_xdotool('get_num_desktops'), 'the window manager')
            yield display
