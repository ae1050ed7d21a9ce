# SPDX-License-Identifier: GPL-3.0-only
"""Runs one process within limits of time and memory, and tells how it ended."""

import ctypes
import os
import resource
import shutil
import signal
import subprocess
from dataclasses import dataclass
from pathlib import Path

from results import DONE

LIBC = ctypes.CDLL(None)
PR_SET_PDEATHSIG = 1
CRASHES = {signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL}
FILE_BYTES = 2**30  # that a process may write into one file
TAIL_BYTES = 2**16  # in which the last line is looked for


@dataclass(frozen=True)
class Limits:
    """Of one process."""

    seconds: float
    bytes: int  # address space


@dataclass(frozen=True)
class Outcome:
    """How a process ended."""

    status: str
    message: str = ''


def end_with_parent() -> None:
    """Lets this process be killed when the one that started it has ended, in whatever way."""
    LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def last_line(path: Path) -> str:
    """Of what a program printed, fit to be shown; empty where there is nothing."""
    with open(path, 'rb') as stream:
        stream.seek(max(0, path.stat().st_size - TAIL_BYTES))
        lines = stream.read().decode(errors='replace').strip().splitlines()
    return ''.join(c if c.isprintable() else ' ' for c in lines[-1][:300]) if lines else ''


def signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:  # most of the real-time signals have none
        return f'signal {number}'


def _outcome(status: int, message: str) -> Outcome:
    """@param message the last line that the process printed"""
    if status == 0:
        return Outcome(DONE)
    if 'memory' in message.lower() or 'bad_alloc' in message:
        return Outcome('out of memory', message)
    if status > 0:
        return Outcome(f'exit status {status}', message)
    if -status == signal.SIGKILL:
        return Outcome('killed', 'SIGKILL, perhaps for want of memory')
    return Outcome('crashed' if -status in CRASHES else 'killed',
                   f'{signal_name(-status)} {message}'.strip())


def run_process(command: list[str], text: Path, limits: Limits) -> Outcome:
    """Runs a process with all that it prints in a file, and ends it and its children in time."""
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    size = limits.bytes if most == resource.RLIM_INFINITY else min(limits.bytes, most)

    def restrict() -> None:
        end_with_parent()
        resource.setrlimit(resource.RLIMIT_AS, (size, size))
        resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_BYTES, FILE_BYTES))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    errors = text.with_suffix('.errors')
    with open(text, 'wb') as output, open(errors, 'wb') as error_output:
        try:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output,
                                       stderr=error_output, start_new_session=True,
                                       preexec_fn=restrict)
        except (OSError, subprocess.SubprocessError) as error:
            return Outcome('not started', str(error))
        try:
            process.wait(limits.seconds)
            outcome = None
        except subprocess.TimeoutExpired:
            outcome = Outcome('timed out', f'after {limits.seconds:g} s')
        finally:
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()
    with open(text, 'ab') as output, open(errors, 'rb') as error_input:
        shutil.copyfileobj(error_input, output)
    return outcome or _outcome(process.returncode, last_line(errors))
