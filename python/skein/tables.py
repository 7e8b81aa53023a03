"""Reads CSV files into structured arrays of NumPy: the complete file, or a `skein.Error` names file and line."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from .columns import KINDS, Column, Table
from .errors import DamagedError, Error, MissingError

Array = NDArray[Any]

_MOST_BYTES = 1 << 31  # largest array of a column of texts
_NUMBER = frozenset("0123456789+-.eE")
_WHOLE = {"count": frozenset("0123456789-"), "seed": frozenset("0123456789")}
_UNPRINTABLE = frozenset(map(chr, [*range(32), 127]))
_FOUND_AS = {"number": "a number", "number?": "a number", "count": "a whole number", "seed": "a whole number",
             "flag": "0 or 1", "text": "a text"}


class _Rows:
    """The cells of a file by column, and the number of the line on which each row begins."""

    def __init__(self, file: Path, header: list[str], columns: list[list[str]], lines: Sequence[int]) -> None:
        self.file, self.header, self.columns, self.lines = file, header, columns, lines

    def fail(self, row: int, what: str) -> NoReturn:
        raise DamagedError(f"{self.file}:{self.lines[row]}: {what}")


def read_text(file: Path, missing: str) -> str:
    """The contents of a text file. `missing`: the likely reason if the file is missing, for the message."""
    try:
        data = file.read_bytes()
    except FileNotFoundError:
        raise MissingError(f"there is no {file}: {missing}") from None
    except (OSError, ValueError) as error:
        raise Error(f"{file} cannot be read: {error}") from error
    try:
        return data.decode()
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise DamagedError(f"{file}:{line}: is damaged: it is not UTF-8") from None


def _whole_lines(file: Path, missing: str) -> str:
    text = read_text(file, missing)
    if not text:
        raise DamagedError(f"{file}:1: is empty, it has not even a header; was the disk full?")
    if not text.endswith("\n"):
        raise DamagedError(f"{file}:{text.count(chr(10)) + 1}: is cut short within this line")
    return text


def _plain_rows(file: Path, missing: str) -> _Rows:
    """The rows of a file without quoted cells. All tables of a run are such files."""
    first, *rows = _whole_lines(file, missing)[:-1].split("\n")
    header = first.split(",")
    commas = len(header) - 1
    for number, row in enumerate(rows, 2):
        if row.count(",") != commas:
            raise DamagedError(f"{file}:{number}: has {row.count(',') + 1} cells, not {commas + 1}")
    cells = ",".join(rows).split(",") if rows else []
    return _Rows(file, header, [cells[i :: commas + 1] for i in range(commas + 1)], range(2, len(rows) + 2))


def _quoted_rows(file: Path, missing: str) -> _Rows:
    """The rows of a file with quoted cells (RFC 4180). The tables of a study are such files."""
    reader = csv.reader(io.StringIO(_whole_lines(file, missing), newline=""), strict=True)
    rows: list[list[str]] = []
    lines: list[int] = []
    begin = 1
    try:
        for row in reader:
            if rows and len(row) != len(rows[0]):
                raise DamagedError(f"{file}:{begin}: has {len(row)} cells, not {len(rows[0])}")
            rows.append(row)
            lines.append(begin)
            begin = reader.line_num + 1
    except csv.Error as error:
        raise DamagedError(f"{file}:{begin}: is damaged: {error}") from None
    header = rows[0]
    columns = [list(column) for column in zip(*rows[1:])] if len(rows) > 1 else [[] for _ in header]
    return _Rows(file, header, columns, lines[1:])


def _numbers(rows: _Rows, column: Column, cells: list[str]) -> Array:
    if column.kind == "number?":
        cells = [cell or "nan" for cell in cells] if "" in cells else cells
        strange = set("".join(cells)) - _NUMBER - set("na")
    else:
        strange = set("".join(cells)) - _NUMBER
    try:
        values = np.fromiter(map(float, cells), np.float64, len(cells))
    except ValueError:
        _fail_at_first(rows, column, cells)
    if strange or not all(cells[i] == "nan" for i in np.flatnonzero(~np.isfinite(values))):
        _fail_at_first(rows, column, cells)
    return values


def _counts(rows: _Rows, column: Column, cells: list[str]) -> Array:
    try:
        if set("".join(cells)) - _WHOLE[column.kind]:
            raise ValueError
        return np.array(list(map(int, cells)), KINDS[column.kind])
    except (ValueError, OverflowError):
        _fail_at_first(rows, column, cells)


def _flags(rows: _Rows, column: Column, cells: list[str]) -> Array:
    if set(cells) - {"0", "1"}:
        _fail_at_first(rows, column, cells)
    return np.array([cell == "1" for cell in cells], bool)


def _texts(rows: _Rows, column: Column, cells: list[str], allowed: str) -> Array:
    longest = max(map(len, cells), default=0)
    if 4 * longest * len(cells) > _MOST_BYTES:
        row = next(i for i, cell in enumerate(cells) if len(cell) == longest)
        rows.fail(row, f"{column.name} has {longest} characters")
    if (set("".join(cells)) & _UNPRINTABLE) - set(allowed):
        row = next(i for i, cell in enumerate(cells) if (set(cell) & _UNPRINTABLE) - set(allowed))
        rows.fail(row, f"{column.name} is not text: {cells[row]!r:.60}")
    return np.array(cells, f"U{max(longest, 1)}")


def _is_good(column: Column, cell: str) -> bool:
    if column.kind == "flag":
        return cell in ("0", "1")
    if column.kind == "count":
        return bool(re.fullmatch(r"-?[0-9]{1,19}", cell)) and -(1 << 63) <= int(cell) < 1 << 63
    if column.kind == "seed":
        return bool(re.fullmatch(r"[0-9]{1,20}", cell)) and int(cell) < 1 << 64
    if column.kind == "number?" and cell in ("", "nan"):
        return True
    if not re.fullmatch(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?", cell):
        return False
    return bool(np.isfinite(float(cell)))


def _fail_at_first(rows: _Rows, column: Column, cells: list[str]) -> NoReturn:
    row = next((i for i, cell in enumerate(cells) if not _is_good(column, cell)), 0)
    rows.fail(row, f"{column.name} must be {_FOUND_AS[column.kind]}, not {cells[row]!r:.60}")


def _array(rows: _Rows, columns: Sequence[Column], allowed: str) -> Array:
    arrays = []
    for column, cells in zip(columns, rows.columns):
        if column.kind in ("number", "number?"):
            if column.kind == "number?" and "nan" in cells:  # the file itself says nan
                rows.fail(cells.index("nan"), f"{column.name} must be a number, or empty, not 'nan'")
            arrays.append(_numbers(rows, column, cells))
        elif column.kind in ("count", "seed"):
            arrays.append(_counts(rows, column, cells))
        elif column.kind == "flag":
            arrays.append(_flags(rows, column, cells))
        else:
            arrays.append(_texts(rows, column, cells, allowed))
    table = np.empty(len(rows.lines), [(c.name, a.dtype) for c, a in zip(columns, arrays)])
    for column, array in zip(columns, arrays):
        table[column.name] = array
    table.flags.writeable = False  # Run and Study keep it, and return the same array again
    return table


def _check_header(rows: _Rows, columns: Sequence[Column]) -> None:
    wanted = [column.name for column in columns]
    if rows.header == wanted:
        return
    differences = [f"{what} {', '.join(names)!r:.200}" for what, names in (
        ("lacks", [name for name in wanted if name not in rows.header]),
        ("has unknown", [name for name in rows.header if name not in wanted])) if names]
    raise DamagedError(f"{rows.file}:1: the header {' and '.join(differences) or 'has another order'}; is it damaged, "
                       "or of another version of Skein?")


def read_table(folder: Path, table: Table, file: str | None = None) -> Array:
    """A table of a run, in the file's order, as a read-only array."""
    rows = _plain_rows(folder / (file or table.file), table.missing)
    columns = (*table.columns, *(column for column in table.optional if column.name in rows.header))
    _check_header(rows, columns)
    return _array(rows, columns, "")


def read_wide_table(folder: Path, table: Table, before: int, extra: str) -> Array:
    """A table with additional columns after the first `before` ones, whose whole names match `extra`. They hold numbers
    in totals.csv, and texts in a table of a run."""
    of_study = table.file == "totals.csv"
    rows = (_quoted_rows if of_study else _plain_rows)(folder / table.file, table.missing)
    after = len(table.columns) - before
    between = rows.header[before : len(rows.header) - after]
    columns = [*table.columns[:before],
               *(Column(name, "number?" if of_study else "text") for name in between if re.fullmatch(extra, name)),
               *table.columns[before:]]
    _check_header(rows, columns)
    if len(set(rows.header)) != len(rows.header):
        raise DamagedError(f"{rows.file}:1: two columns have the same name")
    return _array(rows, columns, "\n\t\r" if of_study else "")


def read_study_table(folder: Path, table: Table) -> Array:
    """A table of a study, in the file's order, as a read-only array."""
    rows = _quoted_rows(folder / table.file, table.missing)
    _check_header(rows, table.columns)
    return _array(rows, table.columns, "\n\t\r")
