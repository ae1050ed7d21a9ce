# SPDX-License-Identifier: GPL-3.0-only
"""Typesets bench.pdf by LaTeX, from templates/bench.tex."""

import os
import shutil
import subprocess
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import jinja2

from tables import Table

TEMPLATES = Path(__file__).resolve().parent / 'templates'
PROGRAMS = [('pdflatex', 'texlive-latex-recommended and lmodern'),  # and their Debian packages
            ('epstopdf', 'texlive-font-utils'), ('gs', 'ghostscript')]
LINE, CHARACTER, GAP = 495, 3.8, 8  # widths in a table: of all, of a character, of a gap, in points

SPECIAL = {'\\': r'\textbackslash{}', '~': r'\textasciitilde{}', '^': r'\textasciicircum{}',
           '-': '-{}', '\u2212': '$-$', '\u2013': '--', '\u2019': "'", '<': r'\textless{}',
           '>': r'\textgreater{}', '|': r'\textbar{}', '"': r'\textquotedbl{}',
           **{character: '\\' + character for character in '&%$#_{}'}}


class LatexError(Exception):
    """LaTeX is missing, or fails."""


def tex(text: str) -> str:
    """Text as LaTeX shows it. What Latin-1 does not have becomes a question mark."""
    latin = ''.join(c if c in SPECIAL or (c.isprintable() and ord(c) < 256) else '?' for c in text)
    return ''.join(SPECIAL.get(character, character) for character in latin)


def breakable(text: str) -> str:
    """The same with places where lines may break: in paths, flags and checksums."""
    pieces = []
    for position, character in enumerate(text):
        pieces.append(tex(character))
        if not character.isalnum() or position % 8 == 7:
            pieces.append(r'\allowbreak{}')
    return ''.join(pieces)


def fitting(table: Table) -> list[Table]:
    """As few tables as fit the page, about equally wide, with some of the columns each.

    The first column is in all.
    """
    def width(column: int) -> float:
        texts = [' '.join([row[column].text, row[column].error]).strip() for row in table.rows]
        return GAP + CHARACTER * max(map(len, [table.columns[column], *texts]))
    widths = [width(column) for column in range(len(table.columns))]

    def parts(line: float) -> list[list[int]]:
        parts: list[list[int]] = [[]]
        for column in range(1, len(widths)):
            if parts[-1] and sum(widths[c] for c in [0, *parts[-1], column]) > line:
                parts.append([])
            parts[-1].append(column)
        return parts
    fewest = len(parts(LINE))
    narrowest = next(parts(line) for line in range(LINE + 1) if len(parts(line)) == fewest)
    return [replace(table, columns=[table.columns[c] for c in [0, *part]],
                    rows=[[row[c] for c in [0, *part]] for row in table.rows])
            for part in narrowest]


def require_latex() -> None:
    """@throws LatexError where it is not installed"""
    for program, package in PROGRAMS:
        if shutil.which(program) is None:
            raise LatexError(f'{program} is missing: install the Debian packages {package}')


def run_quietly(command: list[str], folder: Path) -> None:
    result = subprocess.run(command, cwd=folder, check=False, stdin=subprocess.DEVNULL,
                            capture_output=True, text=True, errors='replace')
    if result.returncode:
        errors = [line for line in result.stdout.splitlines() if line.startswith('!')]
        raise LatexError(f"{command[0]}: {' '.join(errors) or result.stderr.strip()}")


def write_pdf(shown: dict[str, Any], names: Iterable[str], folder: Path) -> bytes:
    """Converts figures by epstopdf, and typesets all by LaTeX.

    @param shown report.content()
    @param names of the figures, which are in the folder as NAME.eps
    """
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda name: run_quietly(['epstopdf', f'{name}.eps'], folder), names))
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), undefined=jinja2.StrictUndefined,
        block_start_string='<%', block_end_string='%>', variable_start_string='<<',
        variable_end_string='>>', comment_start_string='<#', comment_end_string='#>',
        trim_blocks=True, lstrip_blocks=True)
    environment.filters |= {'tex': tex, 'breakable': breakable, 'fitting': fitting}
    text = environment.get_template('bench.tex').render(shown | {'figures': set(names)})
    (folder / 'bench.tex').write_text(text, encoding='utf-8')
    for _ in range(2):  # the second time, long tables know their widths
        run_quietly(['pdflatex', '-interaction=nonstopmode', '-halt-on-error', '-no-shell-escape',
                     'bench.tex'], folder)
    return (folder / 'bench.pdf').read_bytes()
