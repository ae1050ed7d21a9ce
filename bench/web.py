# SPDX-License-Identifier: GPL-3.0-only
"""Writes bench.html: one file that needs no network, from templates/bench.html, .css and .js."""

import base64
import hashlib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import jinja2

TEMPLATES = Path(__file__).resolve().parent / 'templates'


def data_uri(data: bytes, kind: str) -> str:
    return f'data:{kind};base64,{base64.b64encode(data).decode()}'


def png(file: Path) -> str:
    return data_uri(file.read_bytes(), 'image/png')


def distinct(pictures: Iterable[Any]) -> list[list[Any]]:
    """Pictures whose files are the same to the byte, together; in the order of the first ones."""
    groups: dict[bytes, list[Any]] = {}
    for picture in pictures:
        groups.setdefault(picture.file.read_bytes(), []).append(picture)
    return list(groups.values())


def is_numeric(rows: list[list[Any]], column: int) -> bool:
    """Whether a reader sorts a column of a table by numbers."""
    return any(row[column].value is not None for row in rows)


def digest(text: str) -> str:
    """Of a script or a style, for a Content-Security-Policy that allows no other."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def write_html(shown: dict[str, Any], names: Iterable[str], folder: Path) -> bytes:
    """@param shown report.content()
    @param names of the figures, which are in the folder as NAME.svg
    """
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), undefined=jinja2.StrictUndefined,
        autoescape=True, trim_blocks=True, lstrip_blocks=True)
    environment.filters |= {'png': png, 'distinct': distinct, 'digest': digest}
    environment.tests |= {'numeric_in': lambda column, rows: is_numeric(rows, column)}
    images = {name: data_uri((folder / f'{name}.svg').read_bytes(), 'image/svg+xml')
              for name in names}
    text = environment.get_template('bench.html').render(shown | {'figures': images})
    return text.encode('utf-8', errors='replace')  # file names may hold what is no character
