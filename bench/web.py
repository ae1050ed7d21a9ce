# SPDX-License-Identifier: GPL-3.0-only
"""Writes bench.html: one file that needs no network, from templates/bench.html, .css and .js."""

import base64
import hashlib
import io
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import jinja2

TEMPLATES = Path(__file__).resolve().parent / 'templates'


def data_uri(data: bytes, kind: str) -> str:
    return f'data:{kind};base64,{base64.b64encode(data).decode()}'


def png(file: Path) -> str:
    return data_uri(file.read_bytes(), 'image/png')


def svg(figure: Any) -> str:
    """The same bytes for the same figure: figures.py sets what element names are made of."""
    output = io.BytesIO()
    figure.savefig(output, format='svg', bbox_inches='tight', pad_inches=0.02,
                   metadata={'Date': None, 'Creator': None})
    return data_uri(output.getvalue(), 'image/svg+xml')


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


def write_html(shown: dict[str, Any], drawn: Iterable[tuple[str, Any]]) -> bytes:
    """@param shown report.content()
    @param drawn figures.draw_all()
    """
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), undefined=jinja2.StrictUndefined,
        autoescape=True, trim_blocks=True, lstrip_blocks=True)
    environment.filters |= {'png': png, 'distinct': distinct, 'digest': digest}
    environment.tests |= {'numeric_in': lambda column, rows: is_numeric(rows, column)}
    images = {name: svg(figure) for name, figure in drawn}
    text = environment.get_template('bench.html').render(shown | {'figures': images})
    return text.encode('utf-8', errors='replace')  # file names may hold what is no character
