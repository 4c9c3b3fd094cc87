"""Read a table of numbers that a person or another program wrote as CSV."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rover_common.errors import RoverError

# The comma comes last: where it separates decimals, another one separates cells.
SEPARATORS = (";", "\t", ",")
UTF_16 = (b"\xff\xfe", b"\xfe\xff")


class TableError(RoverError, ValueError):
    """A file is no such table."""


class CellError(TableError):
    """A row of a table has not the value that is asked for."""


@dataclass(frozen=True)
class Row:
    """One row by its header; made by `read_table`."""

    line: int  # of the file, from 1
    names: tuple[str, ...]  # in lower case
    cells: tuple[str, ...]
    decimal: str

    def text(self, name: str) -> str:
        """The cell of a column; raises CellError where the row has not the header's cells."""
        if len(self.cells) != len(self.names):
            raise CellError(f"line {self.line}: {len(self.cells)} cells, not {len(self.names)}")
        return self.cells[self.names.index(name)]

    def number(self, name: str) -> float:
        """A finite number; raises CellError."""
        text = self.text(name)
        try:
            value = float(text.replace(self.decimal, "."))
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise CellError(f"line {self.line}: {name} '{text[:40]}' is no finite number")
        return value


def read_table(
    path: Path, columns: Sequence[str], *, text_column: str = "", needs_header: bool = True
) -> list[Row]:
    """The rows below the header, which names these columns and maybe others, in any order.

    Read are UTF-8 and UTF-16, with or without a byte order mark; the separators `;`, tab and `,`;
    names in any case, with blanks around; and a decimal comma where no comma separates. A header in
    the middle begins a new part. Without `needs_header`, the first line may be a row of the
    columns in the usual order. A row with too many cells has the rest in `text_column`, which
    holds paths that nobody quoted.

    Raises TableError for what is no text, or has no header; OSError.
    """
    lines = [
        (number, line.replace("\0", ""))
        for number, line in enumerate(re.split(r"\r\n|\r|\n", _text(path)), 1)
        if line.strip()
    ]
    if not lines:
        raise TableError(f"{path}: line 1: the file is empty, expected {_header(columns)}")
    separator = _separator(lines[0][1], len(columns))
    names = tuple(columns)
    rows: list[Row] = []
    for index, (number, line) in enumerate(lines):
        cells = _cells(line, separator)
        found = tuple(cell.lower() for cell in cells)
        if set(columns) <= set(found):
            names = found
        elif index == 0 and needs_header:
            raise TableError(f"{path}: line {number}: '{line[:60]}', expected {_header(columns)}")
        else:
            fitted = _fitted(cells, names, text_column, separator)
            rows.append(Row(number, names, fitted, "." if separator == "," else ","))
    return rows


def _text(path: Path) -> str:
    content = path.read_bytes()
    encoding = "utf-16" if content.startswith(UTF_16) else "utf-8-sig"
    return content.decode(encoding, errors="replace")


def _header(columns: Sequence[str]) -> str:
    return f"a header with the columns {', '.join(columns)}"


def _separator(line: str, count: int) -> str:
    """The first that makes as many cells as there are columns."""
    return next((each for each in SEPARATORS if line.count(each) >= count - 1), ",")


def _cells(line: str, separator: str) -> list[str]:
    """Line by line: a quote that nobody closed ends with its line."""
    try:
        cells = next(csv.reader([line], delimiter=separator)) or [""]
    except csv.Error:  # a cell of more than 128 KiB
        cells = line.split(separator)
    cells[0] = cells[0].lstrip("# ")  # before the header that NumPy writes
    return [cell.strip() for cell in cells]


def _fitted(
    cells: list[str], names: tuple[str, ...], text_column: str, separator: str
) -> tuple[str, ...]:
    """Without empty cells at the end that the header lacks, and with the text in one cell."""
    while len(cells) > len(names) and not cells[-1]:
        cells = cells[:-1]
    excess = len(cells) - len(names)
    if excess <= 0 or text_column not in names:
        return tuple(cells)
    at = names.index(text_column)
    text = separator.join(cells[at : at + excess + 1])
    return (*cells[:at], text, *cells[at + excess + 1 :])
