"""A fleet with one learner, with Gymnasium's interface for one agent (Env)."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from types import TracebackType
from typing import Any

from ..errors import InputError
from . import spaces
from .fleet import Fleet

_Env: Any
try:
    _Env = importlib.import_module("gymnasium").Env
except ImportError:
    _Env = object


class GymEnv(_Env):  # type: ignore[misc]
    """A fleet with exactly one learner. `fleet` is the `skein.Fleet`."""

    spec: Any = None

    def __init__(self, fleet: Fleet) -> None:
        if not isinstance(fleet, Fleet):
            raise InputError(f"fleet must be a skein.Fleet, not {fleet!r:.80}")
        if len(fleet.possible_agents) != 1:
            raise InputError(f"one UAV learns here, not {len(fleet.possible_agents)}: use skein.Fleet for several")
        self.fleet = fleet
        self.agent = fleet.possible_agents[0]
        self.metadata = {**fleet.metadata, "render_fps": round(1.0 / fleet.step_s)}
        self.render_mode = fleet.render_mode
        self.observation_space: spaces.Space = fleet.observation_space(self.agent)
        self.action_space: spaces.Space = fleet.action_space(self.agent)

    @property
    def unwrapped(self) -> GymEnv:
        return self

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
              ) -> tuple[dict[str, Any], dict[str, Any]]:
        observations, infos = self.fleet.reset(seed, options)
        return observations[self.agent], infos[self.agent]

    def step(self, action: Mapping[str, Any]) -> tuple[dict[str, Any], float, bool, bool, dict[str, Any]]:
        if self.agent not in self.fleet.agents:
            raise InputError("the episode is over: call reset()")
        agent = self.agent
        observations, rewards, terminations, truncations, infos = self.fleet.step({agent: action})
        return observations[agent], rewards[agent], terminations[agent], truncations[agent], infos[agent]

    def render(self) -> str | None:
        return self.fleet.render()

    def close(self) -> None:
        self.fleet.close()

    def __enter__(self) -> GymEnv:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()


def gym_env(uav: str, scenario: Any = "towers", **options: Any) -> GymEnv:
    """An environment with the learner `uav`; the other UAVs fly their planner. `options` are arguments of
    `skein.Fleet`."""
    return GymEnv(Fleet(scenario, learners=[uav], **options))
