# SPDX-License-Identifier: GPL-3.0-only
"""The machine that runs are made on, and what else it does meanwhile."""

import os
import platform
import resource
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path('/')  # below which proc, sys and etc are
CPU = Path('sys/devices/system/cpu')
CLOCK_TICK = os.sysconf('SC_CLK_TCK')


def first_line(path: Path | str) -> str:
    """Of a file below ROOT. Empty where it cannot be read."""
    try:
        return (ROOT / path).read_text(encoding='utf-8', errors='replace').split('\n')[0].strip()
    except OSError:
        return ''


def value(path: Path | str, key: str, separator: str = ':') -> str:
    """The value behind a key in a file of lines KEY SEPARATOR VALUE; empty where there is none."""
    try:
        lines = (ROOT / path).read_text(encoding='utf-8', errors='replace').splitlines()
    except OSError:
        return ''
    pairs = (line.partition(separator) for line in lines)
    return next((text.strip().strip('"') for name, _, text in pairs if name.strip() == key), '')


def caches() -> list[str]:
    """Of the first processor, such as 'L1 Data 48K'."""
    folders = sorted((ROOT / CPU / 'cpu0/cache').glob('index*'))
    return [f"L{first_line(folder / 'level')} {first_line(folder / 'type')} "
            f"{first_line(folder / 'size')}" for folder in folders]


def boost() -> str:
    """'on', 'off', or empty where the machine does not tell."""
    state = first_line(CPU / 'cpufreq/boost')
    no_turbo = first_line(CPU / 'intel_pstate/no_turbo')
    return {'1': 'on', '0': 'off'}.get(state, {'0': 'on', '1': 'off'}.get(no_turbo, ''))


def chosen(text: str) -> str:
    """The word in brackets of a line such as 'always [madvise] never'."""
    return text.partition('[')[2].partition(']')[0] or text


def memory_bytes() -> int:
    """Main memory of the machine."""
    return os.sysconf('SC_PAGE_SIZE') * os.sysconf('SC_PHYS_PAGES')


def machine() -> dict[str, Any]:
    """What does not change while a benchmark runs. Empty text stands for what cannot be read."""
    affinity = sorted(os.sched_getaffinity(0))
    system = f'{platform.system()} {platform.release()}'
    return {
        'cpu': value('proc/cpuinfo', 'model name') or platform.processor(),
        'caches': caches(),
        'cores': os.cpu_count() or 0,
        'affinity': affinity,
        'governor': first_line(CPU / f'cpu{affinity[0]}/cpufreq/scaling_governor'),
        'boost': boost(),
        'virtual': 'hypervisor' in value('proc/cpuinfo', 'flags').split(),
        'memory_bytes': memory_bytes(),
        'transparent_huge_pages': chosen(
            first_line('sys/kernel/mm/transparent_hugepage/enabled')),
        'huge_pages': value('proc/meminfo', 'HugePages_Total'),
        'os': ', '.join(name for name in [value('etc/os-release', 'PRETTY_NAME', '='), system]
                        if name),
        'python': platform.python_version(),
    }


@dataclass
class _Times:
    """Processor time in seconds since the machine was started."""

    busy: float
    stolen: float  # by other virtual machines
    total: float
    children: float  # of this process, that have ended


def _times() -> _Times:
    """All 0 where the machine does not tell."""
    words = first_line('proc/stat').split()[1:9]
    ticks = [int(word) if word.isdecimal() else 0 for word in words]
    user, nice, system, _, _, interrupts, soft_interrupts, stolen = (ticks + [0] * 8)[:8]
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return _Times((user + nice + system + interrupts + soft_interrupts) / CLOCK_TICK,
                  stolen / CLOCK_TICK, sum(ticks) / CLOCK_TICK,
                  children.ru_utime + children.ru_stime)


def load() -> float:
    """Average of a minute; 0 where the machine does not tell."""
    words = first_line('proc/loadavg').split()
    return float(words[0]) if words else 0.0


class Disturbance:
    """What else the machine does while a child process runs."""

    def __init__(self) -> None:
        self.load_before = load()
        self.before = _times()

    def end(self) -> dict[str, float]:
        """After the child was waited for: shares of the machine's processor time, and the load."""
        after = _times()
        total = max(after.total - self.before.total, 1 / CLOCK_TICK)
        others = (after.busy - self.before.busy) - (after.children - self.before.children)
        return {'others': max(0, others) / total,
                'stolen': (after.stolen - self.before.stolen) / total,
                'load_before': self.load_before, 'load_after': load()}
