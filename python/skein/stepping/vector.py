"""Several fleets that fly in parallel, each in a process of its own."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from types import TracebackType
from typing import Any

import numpy as np

from ..errors import InputError
from . import settings
from .fleet import Fleet


class FleetVector:
    """Fleets that fly their steps in parallel, on all cores. Results are lists with the results of each `Fleet`."""

    def __init__(self, fleets: Sequence[Fleet]) -> None:
        listed = isinstance(fleets, Sequence) and len(fleets) > 0
        if not listed or not all(isinstance(fleet, Fleet) for fleet in fleets):
            raise InputError(f"fleets must be a list of one or more skein.Fleet, not {fleets!r:.80}")
        self.fleets = list(fleets)

    @property
    def num_envs(self) -> int:
        return len(self.fleets)

    def __len__(self) -> int:
        return len(self.fleets)

    def __iter__(self) -> Iterator[Fleet]:
        return iter(self.fleets)

    def __getitem__(self, index: int) -> Fleet:
        return self.fleets[index]

    def reset(self, seed: int | Sequence[int] | None = None, options: Mapping[str, Any] | None = None
              ) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
        """Begins a new mission in each fleet. A single seed is for the first fleet; the others get the next numbers."""
        seeds: Sequence[int | None]
        if seed is None:
            seeds = [None] * len(self.fleets)
        elif isinstance(seed, (int, np.integer)):
            seeds = [settings.whole("seed", seed) + i for i in range(len(self.fleets))]
        else:
            seeds = seed
        self._check_length("seeds", seeds)
        both = [fleet.reset(one, options) for fleet, one in zip(self.fleets, seeds)]
        return [observations for observations, _ in both], [infos for _, infos in both]

    def step(self, actions: Sequence[Mapping[str, Any] | None], *, step_s: float | None = None
             ) -> tuple[list[dict[str, Any]], list[dict[str, float]], list[dict[str, bool]], list[dict[str, bool]],
                        list[dict[str, Any]]]:
        """Flies one step of each fleet. A fleet whose mission is over stays as it is and returns empty dictionaries."""
        self._check_length("actions", actions)
        flying = []
        try:
            try:
                for fleet, one in zip(self.fleets, actions):
                    if not fleet.over:
                        fleet.begin_step(one, step_s=step_s)
                        flying.append(fleet)
            except InputError:
                for fleet in flying:  # fleets that have begun the step finish it
                    fleet.end_step()
                raise
            parts: list[tuple[Any, ...]] = [fleet.end_step() if fleet in flying else ({}, {}, {}, {}, {})
                                            for fleet in self.fleets]
        except BaseException:  # after Ctrl-C or a failure of one fleet, the replies of the others are never read
            for fleet in self.fleets:
                fleet._give_up()
            raise
        observations, rewards, terminations, truncations, infos = (list(part) for part in zip(*parts))
        return observations, rewards, terminations, truncations, infos

    def _check_length(self, name: str, values: Sequence[Any]) -> None:
        if not isinstance(values, (Sequence, np.ndarray)) or getattr(values, "ndim", 1) == 0:
            raise InputError(f"{name} must be a list with one for each fleet, not {values!r:.80}")
        if len(values) != len(self.fleets):
            raise InputError(f"there are {len(self.fleets)} fleets, and {len(values)} {name}")

    def close(self) -> None:
        for fleet in self.fleets:
            fleet.close()

    def __enter__(self) -> FleetVector:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()


def vector_env(n: int, scenario: Any = "towers", *, seed: int = 0, **options: Any) -> FleetVector:
    """Makes `n` fleets with the seeds `seed`, `seed + 1`, ...; `options` are arguments of `skein.Fleet`."""
    if settings.whole("n", n) < 1:
        raise InputError("n must be 1 or more")
    first = settings.whole("seed", seed)
    with contextlib.ExitStack() as stack:
        fleets = [stack.enter_context(Fleet(scenario, seed=first + i, **options)) for i in range(n)]
        stack.pop_all()
    return FleetVector(fleets)
