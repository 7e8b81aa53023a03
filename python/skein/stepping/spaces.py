"""Spaces of observations and actions. If Gymnasium is installed, these names are its classes. Otherwise they are the
classes below, which have the part of its interface that a fleet needs: `contains`, `sample`, `seed` and attributes.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np


class Space:
    """A set of values. Base of all spaces."""

    def __init__(self, shape: tuple[int, ...] | None, dtype: Any, seed: int | None = None) -> None:
        self.shape = shape
        self.dtype = None if dtype is None else np.dtype(dtype)
        self._random = np.random.default_rng(seed)

    @property
    def np_random(self) -> np.random.Generator:
        return self._random

    def seed(self, seed: int | None = None) -> list[int]:
        """Seeds `sample()`."""
        drawn = int(np.random.SeedSequence().generate_state(1)[0]) if seed is None else int(seed)
        self._random = np.random.default_rng(drawn)
        return [drawn]

    def contains(self, x: Any) -> bool:
        raise NotImplementedError

    def sample(self) -> Any:
        raise NotImplementedError

    def __contains__(self, x: Any) -> bool:
        return self.contains(x)

class Box(Space):
    """Arrays of one shape and type, with bounds for each number."""

    def __init__(self, low: Any, high: Any, shape: tuple[int, ...] | None = None, dtype: Any = np.float32,
                 seed: int | None = None) -> None:
        if shape is None:
            shape = np.broadcast_shapes(np.shape(low), np.shape(high))
        super().__init__(tuple(shape), dtype, seed)
        self.low = np.full(shape, low, dtype)
        self.high = np.full(shape, high, dtype)

    def contains(self, x: Any) -> bool:
        if not isinstance(x, np.ndarray):
            return False
        return bool(np.can_cast(x.dtype, self.dtype) and x.shape == self.shape and np.all(x >= self.low)
                    and np.all(x <= self.high))

    def sample(self) -> Any:
        if self.dtype is not None and self.dtype.kind == "i":
            whole = self._random.integers(self.low.astype("i8"), self.high.astype("i8"), self.shape, endpoint=True)
            return np.asarray(whole, self.dtype)
        low, high = self.low.astype(float), self.high.astype(float)
        bounded = np.isfinite(low) & np.isfinite(high)
        drawn: Any = self._random.uniform(np.where(bounded, low, 0.0), np.where(bounded, high, 1.0), self.shape)
        tail = self._random.exponential(size=self.shape)
        drawn = np.where(bounded, drawn, np.where(np.isfinite(low), low + tail,
                                                  np.where(np.isfinite(high), high - tail, drawn)))
        return np.asarray(drawn, self.dtype)

    def __eq__(self, other: object) -> bool:
        return (isinstance(other, Box) and self.shape == other.shape and self.dtype == other.dtype
                and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high))

    def __repr__(self) -> str:
        return f"Box({self.low.min(initial=np.inf)}, {self.high.max(initial=-np.inf)}, {self.shape}, {self.dtype})"

class Discrete(Space):
    """Whole numbers from 0 to n - 1."""

    def __init__(self, n: int, seed: int | None = None) -> None:
        super().__init__((), np.int64, seed)
        self.n = int(n)

    def contains(self, x: Any) -> bool:
        whole = isinstance(x, (int, np.integer)) and not isinstance(x, bool)
        if isinstance(x, np.ndarray):
            whole = x.shape == () and x.dtype.kind in "iu"
        return bool(whole and 0 <= int(x) < self.n)

    def sample(self) -> Any:
        return np.int64(self._random.integers(self.n))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Discrete) and self.n == other.n

    def __repr__(self) -> str:
        return f"Discrete({self.n})"

class Dict(Space):
    """Dictionaries with fixed keys, and a space for the values of each key."""

    def __init__(self, spaces: Mapping[str, Space], seed: int | None = None) -> None:
        super().__init__(None, None, seed)
        self.spaces = dict(spaces)

    def seed(self, seed: int | None = None) -> list[int]:
        drawn = super().seed(seed)
        numbers = np.random.SeedSequence(drawn[0]).generate_state(len(self.spaces))
        for space, number in zip(self.spaces.values(), numbers):
            space.seed(int(number))
        return drawn

    def contains(self, x: Any) -> bool:
        return (isinstance(x, dict) and x.keys() == self.spaces.keys()
                and all(space.contains(x[name]) for name, space in self.spaces.items()))

    def sample(self) -> Any:
        return {name: space.sample() for name, space in self.spaces.items()}

    def __getitem__(self, name: str) -> Space:
        return self.spaces[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.spaces)

    def __len__(self) -> int:
        return len(self.spaces)

    def keys(self) -> Any:
        return self.spaces.keys()

    def items(self) -> Any:
        return self.spaces.items()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Dict) and self.spaces == other.spaces

    def __repr__(self) -> str:
        return "Dict(" + ", ".join(f"{name!r}: {space}" for name, space in self.spaces.items()) + ")"


def _use_gymnasium() -> bool:
    """Replaces the classes of this module with Gymnasium's, if it is installed. Returns whether it is."""
    try:
        theirs = importlib.import_module("gymnasium.spaces")
    except ImportError:
        return False
    globals().update({name: getattr(theirs, name) for name in ("Box", "Dict", "Discrete", "Space")})
    return True


GYMNASIUM = _use_gymnasium()

__all__ = ["Box", "Dict", "Discrete", "GYMNASIUM", "Space"]
