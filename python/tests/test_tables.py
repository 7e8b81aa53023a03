"""Tables: the columns are those on the pages; damaged files are detected."""

from __future__ import annotations

import csv
import io
import json
import math
import random
import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import skein
from skein import columns
from skein.tables import read_study_table, read_table, read_wide_table


def documented(page: Path, file: str) -> list[tuple[str, str]]:
    """The columns below "### FILE" on docs/results.md: names, and units if the page has a column of units."""
    section = re.search(rf"^### {re.escape(file)}\n(.*?)(?=^#)", page.read_text(), re.MULTILINE | re.DOTALL)
    assert section is not None, file
    table = re.search(r"^\| column \|.*?(?=^[^|])", section[1] + "\n", re.MULTILINE | re.DOTALL)
    assert table is not None, file
    with_units = "| unit |" in table[0].splitlines()[0]
    found = []
    for line in table[0].splitlines():
        cells = [cell.strip() for cell in line.split("|")[1:]]
        names = re.findall(r"`([^`]+)`", cells[0])
        units = cells[1].split(", ") if with_units else [""]
        found += [(name, units[i if len(units) > 1 else 0]) for i, name in enumerate(names)]
    return found


@pytest.mark.parametrize("table", [*columns.RUN_TABLES.values(), columns.HAND], ids=lambda table: table.name)
def test_the_page_lists_these_columns_in_this_order(root: Path, table: columns.Table) -> None:
    listed = documented(root / "docs/results.md", table.file.replace("{uav}", "<uav>"))
    known = [(column.name, column.unit) for column in table.columns]
    if table is columns.DIGESTS:
        known[2:2] = [(f"<uav>.{field}", "") for field in columns.DIGESTS_OF_A_UAV]
    optional = [(column.name, column.unit) for column in table.optional]
    if not any(unit for _, unit in listed):  # the page has no column of units for this table
        known, optional = ([(name, "") for name, _ in names] for names in (known, optional))
    assert listed in (known, known + optional)


def test_every_table_of_the_page_is_known(root: Path) -> None:
    listed = re.findall(r"^### (.+\.csv)$", (root / "docs/results.md").read_text(), re.MULTILINE)
    assert set(listed) == {table.file for table in columns.RUN_TABLES.values()} | {"hand-<uav>.csv"}


def test_the_page_of_studies_lists_these_columns(root: Path) -> None:
    page = (root / "docs/studies.md").read_text()
    for table in (columns.FLIGHTS, columns.PAIRS):
        section = re.search(rf"^\| column in `{table.file}` \|.*?(?=^[^|])", page, re.MULTILINE | re.DOTALL)
        assert section is not None
        cells = [line.split(" | ")[0] for line in section[0].splitlines()[2:]]
        listed = [name for cell in cells for name in re.findall(r"`([^`]+)`", cell)]
        assert sorted(listed) == sorted(table.names)


def plain(text: str) -> list[dict[str, str]]:
    """A slow and simple reader, to compare with."""
    header, *rows = [line.split(",") for line in text.split("\n")[:-1]]
    assert all(len(row) == len(header) for row in rows)
    return [dict(zip(header, row)) for row in rows]


def assert_says(array: Any, rows: list[dict[str, str]]) -> None:
    assert len(array) == len(rows)
    for name in array.dtype.names:
        for value, row in zip(array[name], rows):
            cell = row[name]
            kind = array.dtype[name].kind
            if kind == "U":
                assert str(value) == cell.rstrip("\0")
            elif kind == "b":
                assert cell == str(int(value))
            elif kind in "iu":
                assert int(cell) == int(value)
            else:
                assert math.isnan(value) if cell == "" else float(cell) == value


@pytest.mark.parametrize("name", columns.RUN_TABLES)
def test_an_array_has_the_values_of_the_file(flown: skein.Run, name: str) -> None:
    file = flown.path / columns.RUN_TABLES[name].file
    assert_says(flown.table(name), plain(file.read_text()))


def damaged(draw: random.Random, data: bytes) -> bytes:
    """Data that are truncated, or in which bytes are changed, removed, inserted or repeated."""
    at = draw.randrange(len(data))
    kind = draw.randrange(5)
    if kind == 0:
        return data[:at]
    if kind == 1:
        return data[:at] + bytes([data[at] ^ 1 << draw.randrange(8)]) + data[at + 1 :]
    if kind == 2:
        return data[:at] + data[at + draw.randrange(1, 40) :]
    if kind == 3:
        return data[:at] + bytes([draw.choice(b'\n\r,"-+.eE_0 \t\0\xff\xc3n\'')]) + data[at:]
    return data[:at] + data[max(0, at - draw.randrange(1, 200)) :]


@pytest.mark.parametrize("name", columns.RUN_TABLES)
def test_a_damaged_file_is_refused_or_read_as_it_is(flown: skein.Run, tmp_path: Path, name: str) -> None:
    draw = random.Random(name)
    table = columns.RUN_TABLES[name]
    shutil.copy(flown.path / "result.json", tmp_path)
    lines = (flown.path / table.file).read_bytes().splitlines(keepends=True)
    data = b"".join(lines[: 1 + 12])  # a short file, so that the damage often hits the header or the end
    refused = 0
    for _ in range(400):
        hurt = damaged(draw, data)
        (tmp_path / table.file).write_bytes(hurt)
        try:
            array = skein.Run(tmp_path).table(name)
        except skein.DamagedError as error:
            assert re.search(re.escape(table.file) + r":[0-9]+: ", str(error)), error
            refused += 1
            continue
        assert_says(array, plain(hurt.decode()))
    assert 100 < refused < 400


def test_damage_is_named_with_its_line(flown: skein.Run, tmp_path: Path) -> None:
    good = (flown.path / "captures.csv").read_text()
    lines = good.splitlines()
    for text, message in {
        "": ":1: is empty",
        good[:-1]: f":{len(lines)}: is cut short",
        good.replace("uav,capture", "uav,captures"): ":1: the header lacks 'capture' and has unknown 'captures'",
        "\n".join([*lines[:4], lines[4] + ",1", *lines[5:], ""]): ":5: has 13 cells, not 12",
        "\n".join([*lines[:4], lines[4].replace(",1,", ",,", 1), *lines[5:], ""]): ":5: ",
        "\n".join([*lines[:4], lines[4].replace(lines[4].split(",")[3], "1e999"), *lines[5:], ""]): (
            ":5: time_s must be a number, not '1e999'"),
        "\n".join([*lines[:4], lines[4].replace(lines[4].split(",")[3], "nan"), *lines[5:], ""]): (
            ":5: time_s must be a number, not 'nan'"),
        "\n".join([*lines[:4], "\a" + lines[4], *lines[5:], ""]): ":5: uav is not text",
    }.items():
        (tmp_path / "captures.csv").write_text(text)
        with pytest.raises(skein.DamagedError) as caught:
            read_table(tmp_path, columns.CAPTURES)
        assert f"captures.csv{message}" in str(caught.value)
    (tmp_path / "captures.csv").write_bytes(good.encode().replace(b"\nraffles", b"\nraff\xffes", 1))
    with pytest.raises(skein.DamagedError, match=r"captures\.csv:[0-9]+: .*UTF-8"):
        read_table(tmp_path, columns.CAPTURES)


def test_a_result_that_is_damaged_is_refused(flown: skein.Run, tmp_path: Path) -> None:
    draw = random.Random(3)
    data = (flown.path / "result.json").read_bytes()
    for _ in range(400):
        hurt = damaged(draw, data)
        (tmp_path / "result.json").write_bytes(hurt)
        try:
            result = skein.Run(tmp_path).result
        except skein.DamagedError as error:
            assert re.search(r"result\.json:[0-9]+: ", str(error)), error
            continue
        # The damage may have changed only white space, digits of an exponent, or the name of the checksum's key.
        assert result == flown.result or "checksum" not in result
        assert result == json.loads(hurt)
    for text in ("[" * 100_000, "[]", "1", '{"checksum": "", "a": ' + "[" * 900 + "]" * 900 + "}"):
        (tmp_path / "result.json").write_text(text)
        with pytest.raises(skein.DamagedError):
            skein.Run(tmp_path).result


def test_tables_of_a_study_may_have_quotes(tmp_path: Path) -> None:
    draw = random.Random(5)
    letters = 'ab,"\n \u00e9'
    for _ in range(100):
        rows = [["".join(draw.choices(letters, k=draw.randrange(8))) for _ in range(4)]
                + [str(draw.randrange(9)), *draw.choices(["", "0.5", "-1e-3"], k=5)] for _ in range(draw.randrange(5))]
        out = io.StringIO()
        csv.writer(out, lineterminator="\n").writerows([columns.PAIRS.names, *rows])
        (tmp_path / "pairs.csv").write_text(out.getvalue())
        array = read_study_table(tmp_path, columns.PAIRS)
        assert [[str(row[i]) for i in range(4)] for row in array] == [row[:4] for row in rows]
        assert np.array_equal(array["low"], [float(row[6] or "nan") for row in rows], equal_nan=True)
        hurt = damaged(draw, out.getvalue().encode())
        (tmp_path / "pairs.csv").write_bytes(hurt)
        try:
            array = read_study_table(tmp_path, columns.PAIRS)
        except skein.DamagedError:
            continue
        again = list(csv.DictReader(io.StringIO(hurt.decode(), newline="")))
        assert_says(array, again)


def test_whole_numbers_keep_all_digits(tmp_path: Path) -> None:
    header = ",".join(columns.FLIGHTS.names)
    rest = "," * (len(columns.FLIGHTS.names) - 3)
    (tmp_path / "flights.csv").write_text(f"{header}\ntowers,kios,{(1 << 64) - 1}{rest}\n")
    assert int(read_study_table(tmp_path, columns.FLIGHTS)["seed"][0]) == (1 << 64) - 1
    for seed in ("-1", str(1 << 64), "1.0", "", "9" * 5000, "\N{DEVANAGARI DIGIT ONE}", "1_0"):
        (tmp_path / "flights.csv").write_text(f"{header}\ntowers,kios,{seed}{rest}\n")
        with pytest.raises(skein.DamagedError, match="flights.csv:2: seed must be a whole number"):
            read_study_table(tmp_path, columns.FLIGHTS)


def test_a_planner_without_a_complete_test_has_no_place(tmp_path: Path) -> None:
    rows = "place,planner,ranked_by,test_1,max,median,worst\n1,kios,max,5,5,5,5\n,star,max,,,,\n"
    (tmp_path / "totals.csv").write_text(rows)
    totals = read_wide_table(tmp_path, columns.TOTALS, 3, "test_[0-9]+")
    assert np.array_equal(totals["place"], [1.0, np.nan], equal_nan=True)


def test_a_cell_that_would_take_all_memory_is_refused(tmp_path: Path) -> None:
    rows = "0,0.5,joined,jurong,\n" * 9_000 + "0,0.5,joined," + "j" * 60_000 + ",\n"
    (tmp_path / "events.csv").write_text(",".join(columns.EVENTS.names) + "\n" + rows)
    with pytest.raises(skein.DamagedError, match="events.csv:9002: subject has 60000 characters"):
        read_table(tmp_path, columns.EVENTS)
