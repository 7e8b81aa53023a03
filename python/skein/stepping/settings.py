"""Checks the arguments of a fleet before a process is started. All functions raise InputError."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ..errors import InputError

_MOST = 1 << 63


def whole(name: str, value: Any, least: int = 0) -> int:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)) or not least <= value < _MOST:
        raise InputError(f"{name} must be a whole number, {least} or above, not {value!r:.80}")
    return int(value)


def number(name: str, value: Any) -> float:
    known = isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool)
    try:
        found = float(value) if known else math.nan
    except OverflowError:  # an int that is too large for a float
        found = math.inf
    if not math.isfinite(found):
        raise InputError(f"{name} must be a number, not {str(value):.80}")
    return found


def one_of(name: str, value: Any, known: Iterable[str | None]) -> Any:
    if not (value is None or isinstance(value, str)) or value not in (known := list(known)):
        raise InputError(f"{name} must be one of {', '.join(map(repr, known))}, not {value!r:.80}")
    return value


def names(name: str, value: Any) -> list[str]:
    """A list of UAVs' names, from one name or several. Repeated names count once."""
    listed = [value] if isinstance(value, str) else value
    if not isinstance(listed, (Sequence, set, frozenset, dict)) or not all(isinstance(one, str) for one in listed):
        raise InputError(f"{name} must be a UAV's name or a list of such names, not {value!r:.80}")
    return list(dict.fromkeys(listed))


def cells(name: str, value: Any) -> list[int]:
    single = not isinstance(value, (Sequence, np.ndarray)) or isinstance(value, str) or getattr(value, "ndim", 1) == 0
    if single or len(value) != 3:
        raise InputError(f"{name} must be three numbers of cells, along x, y and z, not {value!r:.80}")
    return [whole(f"{name}[{axis}]", size) for axis, size in enumerate(value)]


def text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise InputError(f"{name} must be a text, not {value!r:.80}")
    return value
