#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Runs every kernel on every scene and prints a table; images and reports go to bench/results."""

import json
import subprocess
import sys
from pathlib import Path

KERNELS = ['simple-bvh', 'funky-kd']
SCENES = ['cornell', 'conference', 'atrium', 'statue', 'forest', 'hairball', 'stadium']
SIZE = '320x240'
PASSES = 4

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / 'bench' / 'results'
COLUMNS = ['scene', 'kernel', 'initialise s', 'render s', 'Mrays/s', 'kernel MB',
           'average intensity']


def run(kernel: str, scene: str) -> dict | None:
    """The report of one run, None where it failed."""
    base = RESULTS / f'{scene}-{kernel}'
    command = [ROOT / 'build' / f'bwfirt-{kernel}', ROOT / 'scenes' / f'{scene}.scene', '--batch',
               '--camera', ROOT / 'scenes' / f'{scene}.camera', '--size', SIZE,
               '--passes', str(PASSES), '--output', base, '--report', f'{base}.json']
    with open(f'{base}.txt', 'w', encoding='utf-8') as text:
        status = subprocess.run(command, stdout=text, check=False).returncode
    return json.loads(Path(f'{base}.json').read_text(encoding='utf-8')) if status == 0 else None


def row(kernel: str, scene: str, report: dict | None) -> list[str]:
    if report is None:
        return [scene, kernel, 'failed', '', '', '', '']
    return [scene, kernel, f"{report['time']['initialize_s']:.3f}",
            f"{report['time']['render_s']:.2f}", f"{report['rays']['per_second'] / 1e6:.3f}",
            f"{report['memory']['kernel_final_bytes'] / 1e6:.1f}",
            f"{report['average_intensity'][0]:.6f}"]


def main() -> int:
    RESULTS.mkdir(exist_ok=True)
    reports = {(scene, kernel): run(kernel, scene) for scene in SCENES for kernel in KERNELS}
    table = [COLUMNS] + [row(kernel, scene, report) for (scene, kernel), report in reports.items()]
    widths = [max(len(line[i]) for line in table) for i in range(len(COLUMNS))]
    for line in table:
        print('  '.join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip())
    print(f'images and reports are in {RESULTS}')
    return 1 if None in reports.values() else 0


if __name__ == '__main__':
    sys.exit(main())
