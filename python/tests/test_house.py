"""Rules for the project's Python code, in addition to those of tests/layers."""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path


def sources(root: Path) -> list[Path]:
    found = [file for file in (root / "python").rglob("*.py")]
    assert len(found) > 10
    return found


def test_the_package_needs_nothing_but_numpy_to_be_imported(root: Path) -> None:
    for file in sources(root):
        if root / "python" / "skein" not in file.parents:
            continue
        for node in ast.parse(file.read_text()).body:  # imports within functions are allowed
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.level == 0:
                names = [node.module or ""]
            for name in names:
                top = name.split(".")[0]
                assert top in sys.stdlib_module_names or top == "numpy", f"{file}: {name}"


def test_tests_read_no_clock(root: Path) -> None:
    clock = re.compile(r"\b(time\.(time|monotonic|perf_counter|sleep)|(import|from) time|datetime)\b")
    for file in sources(root):
        if "tests" in file.parts and file.name != "test_house.py":
            assert not clock.search(file.read_text()), file


def test_the_package_says_that_it_is_typed(root: Path) -> None:
    assert (root / "python/skein/py.typed").exists()
