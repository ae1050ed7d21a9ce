# SPDX-License-Identifier: GPL-3.0-only
"""What the machine tells in /proc and /sys, and what it does not."""

from pathlib import Path

import pytest

import environment
from environment import CLOCK_TICK, Disturbance

CPU = 'sys/devices/system/cpu'
FILES = {
    'proc/cpuinfo': 'processor\t: 0\nmodel name\t: Imagined 9000: fast\n'
                    'flags\t\t: fpu hypervisor x\n\n'
                    'processor\t: 1\nmodel name\t: Another\n',
    'proc/meminfo': 'MemTotal:       24682416 kB\nHugePages_Total:      12\n',
    'proc/stat': 'cpu  0 0 0 0 0 0 0 0 0 0\ncpu0 1 2 3\n',
    'proc/loadavg': '1.25 0.50 0.25 1/100 12345\n',
    'etc/os-release': 'NAME="Debian"\nPRETTY_NAME="Debian GNU/Linux 12 (bookworm)"\n',
    'sys/kernel/mm/transparent_hugepage/enabled': 'always [madvise] never\n',
    f'{CPU}/cpufreq/boost': '1\n',
    f'{CPU}/cpu0/cache/index0/level': '1\n', f'{CPU}/cpu0/cache/index0/type': 'Data\n',
    f'{CPU}/cpu0/cache/index0/size': '48K\n',
    f'{CPU}/cpu0/cache/index1/level': '3\n', f'{CPU}/cpu0/cache/index1/type': 'Unified\n',
    f'{CPU}/cpu0/cache/index1/size': '36864K\n',
}


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A machine with one processor that tells all."""
    monkeypatch.setattr(environment, 'ROOT', tmp_path)
    monkeypatch.setattr('os.sched_getaffinity', lambda _: {3, 0, 10})
    for name, text in FILES.items():
        write(tmp_path, name, text)
    write(tmp_path, f'{CPU}/cpu0/cpufreq/scaling_governor', 'powersave\n')
    return tmp_path


def write(root: Path, name: str, text: str) -> None:
    (root / name).parent.mkdir(parents=True, exist_ok=True)
    (root / name).write_text(text)


def test_a_machine_that_tells_all(root: Path) -> None:
    machine = environment.machine()
    expected = {'cpu': 'Imagined 9000: fast', 'virtual': True, 'huge_pages': '12', 'boost': 'on',
                'transparent_huge_pages': 'madvise', 'governor': 'powersave',
                'caches': ['L1 Data 48K', 'L3 Unified 36864K'], 'affinity': [0, 3, 10]}
    assert {key: machine[key] for key in expected} == expected
    assert machine['os'].startswith('Debian GNU/Linux 12 (bookworm), Linux ')
    assert machine['memory_bytes'] > 10**6


def test_a_machine_that_tells_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(environment, 'ROOT', tmp_path)
    machine = environment.machine()
    expected = {'virtual': False, 'huge_pages': '', 'boost': '', 'transparent_huge_pages': '',
                'governor': '', 'caches': []}
    assert {key: machine[key] for key in expected} == expected
    assert machine['os'].startswith('Linux ')
    disturbance = Disturbance().end()
    assert disturbance == {'others': 0, 'stolen': 0, 'load_before': 0, 'load_after': 0}


@pytest.mark.parametrize('name', FILES)
def test_each_file_may_be_missing(root: Path, name: str) -> None:
    (root / name).unlink()
    assert environment.machine()['affinity'] == [0, 3, 10]
    assert Disturbance().end()['others'] == 0


@pytest.mark.parametrize('name', FILES)
def test_each_file_may_hold_rubbish(root: Path, name: str) -> None:
    (root / name).write_bytes(b'\xff\xfe : =\n' * 3)
    assert environment.machine()['affinity'] == [0, 3, 10]


@pytest.mark.parametrize('boost, no_turbo, expected', [
    ('1', None, 'on'), ('0', None, 'off'), (None, '0', 'on'), (None, '1', 'off'),
    ('0', '0', 'off'), (None, None, '')])
def test_boost(root: Path, boost: str | None, no_turbo: str | None, expected: str) -> None:
    (root / f'{CPU}/cpufreq/boost').unlink()
    for name, text in [('cpufreq/boost', boost), ('intel_pstate/no_turbo', no_turbo)]:
        if text is not None:
            write(root, f'{CPU}/{name}', f'{text}\n')
    assert environment.boost() == expected


def stat(*seconds: float) -> str:
    return f"cpu  {' '.join(str(round(CLOCK_TICK * x)) for x in seconds)} 0 0\n"


def test_shares_of_processor_time(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 100 s: 60 busy, of which 45 are the child's; 35 idle, 5 stolen."""
    class Usage:
        ru_utime = ru_stime = 0.0
    usage = Usage()
    monkeypatch.setattr('resource.getrusage', lambda _: usage)
    write(root, 'proc/stat', stat(1000, 10, 100, 5000, 50, 1, 2, 3))
    disturbance = Disturbance()
    before = disturbance.end()
    assert (before['others'], before['stolen']) == (0, 0)
    usage.ru_utime, usage.ru_stime = 40.0, 5.0
    disturbance.before.children = 0.0
    write(root, 'proc/stat', stat(1050, 12, 106, 5030, 55, 2, 3, 8))
    write(root, 'proc/loadavg', '2.50 1 1 1/1 1\n')
    assert disturbance.end() == pytest.approx({'others': 0.15, 'stolen': 0.05, 'load_before': 1.25,
                                               'load_after': 2.5})


def test_a_short_line_of_an_old_machine(root: Path) -> None:
    write(root, 'proc/stat', 'cpu  1 2 3 4\n')
    assert Disturbance().end()['stolen'] == 0
