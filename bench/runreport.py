# SPDX-License-Identifier: GPL-3.0-only
"""Reads the run report that a kernel wrote (doc/file-formats), and refuses what is none.

Whatever is read from a report later is looked at here, so that no kernel stops the benchmark.
"""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from metrics import ANSWERS, RATE, Report, metrics_of
from plan import REPLAY

UNREADABLE = 'unreadable report'  # there is none, or not all of it
WRONG = 'wrong report'  # of another run, or with figures that cannot be

TEXTS = [f'program.{key}' for key in ['version', 'commit', 'compiler', 'flags', 'kernel_flags']]
NUMBERS = ['triangles', 'width', 'height', 'passes', 'time.render_s', 'memory.kernel_leaked_bytes',
           'memory.process_peak_bytes']
COLOURS = ['average_intensity', 'standard_error', 'reference_average_intensity']
REPLAYED = ['replay.rays.intersect', 'replay.rays.visibility', 'replay.in_flight',
            'replay.answers.max_relative_distance_error',
            *(f'replay.{answers}.{name}' for answers in ['answers', 'answers_in_flight']
              for name in ANSWERS)]


class BadReport(Exception):
    """A report that is unreadable or wrong."""

    def __init__(self, status: str, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.message = message[:300]


def read_report(path: Path, kind: str, asked: Mapping[str, Any]) -> Report:
    """@param kind   of the run: plan.RENDER, CONTROL, RECORD or REPLAY
    @param asked  values that the report must have, or it tells of another run
    @throws BadReport
    """
    if path.exists() and not path.is_file():
        raise BadReport(UNREADABLE, 'is no file')
    try:
        report = json.loads(path.read_text(encoding='utf-8'))
    except FileNotFoundError:
        raise BadReport(UNREADABLE, 'there is none') from None
    except (OSError, ValueError, RecursionError) as error:
        raise BadReport(UNREADABLE, str(error)) from None
    for key, expected in asked.items():
        if _value(report, key) != expected:
            raise BadReport(WRONG, f'{key} is {_value(report, key)}, not {expected}')
    for key in TEXTS + ['replay.recorded_by'] * (kind == REPLAY):
        _require(isinstance(_value(report, key), str), UNREADABLE, f'{key} is no text')
    for key in NUMBERS + REPLAYED * (kind == REPLAY):
        _require_number(key, _value(report, key))
    _require(report['triangles'] > 0, WRONG, 'triangles is 0')
    if kind != REPLAY:
        _require_colours(report)
    _require_warnings(report)
    _require_metrics(report, kind)
    return report


def _require(holds: bool, status: str, message: str) -> None:
    if not holds:
        raise BadReport(status, message)


def _value(report: Any, key: str) -> Any:
    """Nested keys are joined by a point."""
    for name in key.split('.'):
        _require(isinstance(report, dict) and name in report, UNREADABLE, f'{key} is missing')
        report = report[name]
    return report


def _require_number(key: str, value: Any) -> None:
    """JSON has no NaN: null stands for it."""
    _require(value is None or isinstance(value, (int, float)), UNREADABLE, f'{key} is no number')
    try:
        finite = value is not None and math.isfinite(value)
    except OverflowError:  # a whole number that is beyond all
        finite = False
    _require(finite, WRONG, f'{key} is not finite')
    _require(value >= 0, WRONG, f'{key} is negative')


def _require_colours(report: Report) -> None:
    for key in COLOURS:
        colour = _value(report, key)
        if key != 'average_intensity' and colour in (None, [None] * 3):  # which is not known
            continue
        _require(isinstance(colour, list) and len(colour) == 3, UNREADABLE, f'{key} is no colour')
        for channel in colour:
            _require_number(key, channel)
    _require(report['standard_error'] is not None, UNREADABLE, 'standard_error is no colour')


def _require_warnings(report: Report) -> None:
    warnings = report.get('warnings', [])
    _require(isinstance(warnings, list) and all(isinstance(text, str) for text in warnings),
             UNREADABLE, 'warnings are no texts')


def _require_metrics(report: Report, kind: str) -> None:
    for metric in metrics_of(kind):
        try:
            value = metric.value(report)
        except (KeyError, TypeError, AttributeError, ArithmeticError) as error:
            raise BadReport(UNREADABLE, f'{metric.name}: {type(error).__name__}: {error}') from None
        _require_number(metric.name, value)
    if kind != REPLAY:
        _require(RATE.value(report) > 0, WRONG, f'{RATE.name} is 0')
