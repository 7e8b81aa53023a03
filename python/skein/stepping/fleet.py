"""A fleet that your program advances step by step, with PettingZoo's interface for several agents (ParallelEnv)."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

from ..errors import InputError
from ..launch import flag, option_arguments, path_text, positional
from . import settings, spaces
from .actions import Orders, action_space
from .observations import Observations
from .saved import hand_file
from .truth import Truth
from .worker import Family, Worker

Observation = dict[str, Any]
Reward = Callable[["Fleet", str], float]
_ACTIONS = {"velocity": "velocity", "goal": "way"}  # value of the parameter `flies` of the planner `learner`
_MOST_STEPS = 1 << 40  # every run ends sooner; the process counts with 64 bits
_STATE = ("position", "velocity", "attitude", "angular_velocity", "gimbal")  # parts of Fleet.state(), by learner


class Fleet:
    """A fleet in a process of its own, whose simulated time stands still between two calls of `step()`.

    The UAVs in `learners` carry out the actions that `step()` passes; each other UAV flies its planner. Only one thread
    at a time may use a fleet. docs/how-to-python.md has more.
    """

    metadata: dict[str, Any] = {"name": "skein_v0", "render_modes": ["ansi"], "is_parallelizable": True}

    def __init__(self, scenario: str | os.PathLike[str] = "towers", *, planner: str = "flock", seed: int = 0,
                 learners: Iterable[str] = (), step_s: float = 0.05, actions: str = "velocity", safe: bool = True,
                 scans: bool = False, map_window: tuple[int, int, int] = (16, 16, 8), map_cell_m: float = 1.0,
                 detections: int = 256, reward: Reward | None = None, render_mode: str | None = None,
                 launcher: str | os.PathLike[str] | None = None, **options: Any) -> None:
        """`options` are the options of `skein fleet --help`: `duration=60`, `scene_seed=3`, `faults="a.yaml"`.

        Raises InputError if an argument is wrong, for options with the launcher's message.
        """
        self.possible_agents: list[str] = settings.names("learners", learners)
        self._actions = settings.one_of("actions", actions, _ACTIONS)
        self.render_mode = settings.one_of("render_mode", render_mode, (None, *self.metadata["render_modes"]))
        self._safe, self._reward = flag("safe", safe), reward
        if reward is not None and not callable(reward):
            raise InputError(f"reward must be a function, not {reward!r:.80}")
        self._seed = settings.whole("seed", seed)
        map_x, map_y, map_z = settings.cells("map_window", map_window)
        learner = ",".join(f"{name}={value}" for name, value in {
            "flies": _ACTIONS[actions], "safe": str(self._safe).lower(), "scans": str(flag("scans", scans)).lower(),
            "detections": settings.whole("detections", detections), "map_x": map_x, "map_y": map_y, "map_z": map_z,
            "map_cell_m": settings.number("map_cell_m", map_cell_m)}.items())
        planner = settings.text("planner", planner)
        self._planner = ",".join([planner, *(f"{uav}=learner:{learner}" for uav in self.possible_agents)])
        self._scenario, self._launcher, self._options = scenario, launcher, dict(options)
        self._families: dict[Any, Family] = {}
        self._worker: Worker | None = None
        self._observations: dict[str, Observations] = {}
        self._orders: dict[str, Orders] = {}
        self._log: dict[str, list[tuple[int, dict[str, Any]]]] = {}  # checked actions, with their steps
        self._started: tuple[int, Any] = (0, None)  # seed and scene
        self._score = 0.0  # delivered score after the last step
        self._flying = self._closed = False
        self.agents: list[str] = []
        self._over = False
        self._resets = 0
        scene_seed = options.get("scene_seed")
        if scene_seed is not None and not isinstance(scene_seed, str):  # the launcher reads a text
            self._options["scene_seed"] = scene_seed = settings.whole("scene_seed", scene_seed)
        about = self._family(scene_seed).about
        self._uavs: tuple[str, ...] = tuple(uav["name"] for uav in about["uavs"])
        self._index = {uav: i for i, uav in enumerate(self._uavs)}
        self._period_s = float(about["exchange_period_s"])
        self._steps = self._steps_of(step_s)
        self._about = about
        self._action_spaces = {uav: action_space(actions) for uav in self.possible_agents}
        self._start(self._seed)  # the fleet's process announces the observation spaces
        self._observation_spaces = {uav: self._observations[uav].space() for uav in self.possible_agents}

    # -- properties ---------------------------------------------------------------------------------------------------

    @property
    def uavs(self) -> tuple[str, ...]:
        """Names of all UAVs, in fleet order."""
        return self._uavs

    @property
    def step_s(self) -> float:
        """Simulated time of a step [s]."""
        return self._steps * self._period_s

    @property
    def over(self) -> bool:
        """Whether the mission has ended."""
        return self._over

    @property
    def num_agents(self) -> int:
        return len(self.agents)

    @property
    def max_num_agents(self) -> int:
        return len(self.possible_agents)

    @property
    def unwrapped(self) -> Fleet:
        return self

    def observation_space(self, agent: str) -> spaces.Space:
        space: spaces.Space = self._of(self._observation_spaces, agent)
        return space

    def action_space(self, agent: str) -> spaces.Space:
        space: spaces.Space = self._of(self._action_spaces, agent)
        return space

    @property
    def observation_spaces(self) -> dict[str, spaces.Space]:
        return dict(self._observation_spaces)

    @property
    def action_spaces(self) -> dict[str, spaces.Space]:
        return dict(self._action_spaces)

    @property
    def state_space(self) -> spaces.Space:
        size = sum(self._observations[uav].views[name].shape[0] for uav in self.possible_agents for name in _STATE)
        return spaces.Box(-np.inf, np.inf, (size,), np.float64)

    def _of(self, table: Mapping[str, Any], agent: str) -> Any:
        if not isinstance(agent, str) or agent not in table:
            known = ", ".join(self.possible_agents) or "none"
            raise InputError(f"there is no learner {agent!r:.80}; there are: {known}")
        return table[agent]

    @property
    def truth(self) -> Truth:
        """The true state of the world, which no UAV knows."""
        return Truth(self._running(), self._uavs)

    def state(self) -> Any:
        """The learners' own estimates of their states, in one array: position, velocity, attitude, angular velocity and
        gimbal of each of `possible_agents`. This is not the truth."""
        self._running()
        parts = [self._observations[uav].views[name] for uav in self.possible_agents for name in _STATE]
        return np.concatenate(parts) if parts else np.zeros(0)

    # -- flying -------------------------------------------------------------------------------------------------------

    def reset(self, seed: int | None = None, options: Mapping[str, Any] | None = None
              ) -> tuple[dict[str, Observation], dict[str, dict[str, Any]]]:
        """Begins a new mission. Without `seed`, the first mission uses the fleet's seed, and each later mission the
        next number. `options={"scene_seed": 3}` chooses another scene of a procedural family."""
        self._check_open()
        if options is not None and not isinstance(options, Mapping):
            raise InputError(f"reset(options=...) must be a dictionary, as {{'scene_seed': 3}}, not {options!r:.80}")
        unknown = set(options or {}) - {"scene_seed"}
        if unknown:
            raise InputError(f"reset(options=...) knows scene_seed, not {', '.join(sorted(map(repr, unknown)))}")
        if seed is not None:
            self._seed = settings.whole("seed", seed)
        elif self._resets > 0:
            self._seed += 1
        if options and "scene_seed" in options:
            self._options["scene_seed"] = settings.whole("scene_seed", options["scene_seed"])
        as_it_is = (self._resets == 0 and self._started == (self._seed, self._scene())
                    and self._running().views["truth.step"] == 0)  # the constructor has started it
        if not as_it_is:
            self._start(self._seed)
        self._resets += 1
        observations = {uav: self._observations[uav].read() for uav in self.agents}
        return observations, {uav: self._info() for uav in self.agents}

    def step(self, actions: Mapping[str, Mapping[str, Any]] | None = None, *, step_s: float | None = None
             ) -> tuple[dict[str, Observation], dict[str, float], dict[str, bool], dict[str, bool],
                        dict[str, dict[str, Any]]]:
        """Flies for `step_s` [simulated s]. A learner without an action continues its last one.

        Returns observations, rewards, terminations, truncations and infos of all learners that were in `agents` before.
        Raises InputError for an invalid action, before the fleet moves, and ProcessError if the process has failed."""
        self.begin_step(actions, step_s=step_s)
        return self.end_step()

    def begin_step(self, actions: Mapping[str, Mapping[str, Any]] | None = None, *,
                   step_s: float | None = None) -> None:
        """The first half of `step()`: starts the flight, and returns at once. `end_step()` must follow."""
        worker = self._running()
        if self._over:
            raise InputError("the mission is over: call reset()")
        if self._flying:
            raise InputError("the fleet is flying already: call end_step() before")
        steps = self._steps if step_s is None else self._steps_of(step_s)
        if actions is not None and not isinstance(actions, Mapping):
            raise InputError(f"actions must be a dictionary from learners to their actions, not {actions!r}")
        values = {}
        for uav, action in (actions or {}).items():
            if uav not in self._orders:
                self._of(self._orders, uav)
            if uav in self.agents:
                values[uav] = self._orders[uav].read(action)
        now = int(worker.views["truth.step"])
        try:
            for uav, value in values.items():
                self._orders[uav].write(value)
                self._log.setdefault(uav, []).append((now, value))
            worker.begin_steps(steps)
            self._flying = True
        except BaseException:  # after Ctrl-C, the state of the fleet would be unknown
            worker.let_go()
            raise

    def end_step(self) -> tuple[dict[str, Observation], dict[str, float], dict[str, bool], dict[str, bool],
                                dict[str, dict[str, Any]]]:
        """The second half of `step()`: waits until the fleet has flown the step. Returns the same as `step()`."""
        worker = self._running()
        if not self._flying:
            raise InputError("the fleet stands: call begin_step() before")
        try:
            self._over = worker.end_steps()
            self._flying = False
        except BaseException:
            worker.let_go()
            raise
        agents, alive, score = self.agents, worker.views["truth.alive"], float(worker.views["truth.score"][()])
        gain, self._score = score - self._score, score
        alive = alive.tolist()
        terminations = {uav: not alive[self._index[uav]] for uav in agents}
        truncations = {uav: self._over and not terminations[uav] for uav in agents}
        observations = {uav: self._observations[uav].read() for uav in agents}
        info = self._info()
        infos = {uav: info.copy() for uav in agents}
        self.agents = [uav for uav in agents if not terminations[uav] and not truncations[uav]]
        rewards = {uav: gain if self._reward is None else float(self._reward(self, uav)) for uav in agents}
        return observations, rewards, terminations, truncations, infos

    def fork(self) -> Fleet:
        """A copy of the fleet in its present state, including the state of its planners. Original and copy are
        independent; given the same actions, both fly identically."""
        worker = self._running()
        if self._flying:
            raise InputError("a fleet that flies cannot be copied: call end_step() before")
        copy = object.__new__(Fleet)
        copy.__dict__.update(self.__dict__)
        copy.agents = list(self.agents)
        copy._families, copy._options = dict(self._families), dict(self._options)
        copy._log = {uav: list(entries) for uav, entries in self._log.items()}
        copy._take(worker.fork())
        return copy

    def __reduce_ex__(self, protocol: Any) -> Any:
        raise InputError("a fleet is a process, which the modules copy and pickle cannot copy: fork() does")

    def result(self) -> dict[str, Any]:
        """Digest, score, and the work of each UAV, up to now. Writes no files."""
        result: dict[str, Any] = self._running().ask("result")
        return {"scenario": self._about["scenario"], "planner": self._planner, "seed": self._started[0], **result}

    def save_commands(self, uav: str, file: str | os.PathLike[str]) -> Path:
        """Writes the actions of a learner since reset() to a file for the planner `hand`. `skein run --planner
        patrol,UAV=hand:FILE` then repeats the flight, and writes all files of a run. Only for actions="velocity"."""
        self._of(self._orders, uav)
        if self._actions != "velocity":
            raise InputError("only velocities can be flown again: actions='velocity'")
        return hand_file(uav, self._log.get(uav, []), self._period_s, Path(path_text("file", file)))

    def render(self) -> str | None:
        """With render_mode="ansi": the fleet's state as text."""
        if self.render_mode is None:
            return None
        truth = self.truth
        lines = [f"{self._about['scenario']} {truth.time_s:.2f} s  mission {truth.mission}  score {truth.score:.3f}"]
        for uav, p, v, alive in zip(self._uavs, truth.position, truth.velocity, truth.alive):
            what = f"{np.sqrt(v @ v):.1f} m/s" if alive else "out"
            lines.append(f"  {uav:12} ({p[0]:7.2f}, {p[1]:7.2f}, {p[2]:6.2f})  {what}"
                         + ("  learner" if uav in self.possible_agents else ""))
        return "\n".join(lines)

    def close(self) -> None:
        """Ends the fleet and its process. Copies of the fleet go on."""
        if self._worker is not None:
            self._worker.let_go()
        self._worker, self._closed, self.agents = None, True, []
        self._families.clear()  # a family that no copy of this fleet uses ends

    def __enter__(self) -> Fleet:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        state = "closed" if self._worker is None else f"at {self.truth.time_s:.2f} s"
        return f"<skein.Fleet {os.fspath(self._scenario)}, learners {self.possible_agents}, {state}>"

    # -- its process --------------------------------------------------------------------------------------------------

    def _scene(self) -> Any:
        return self._options.get("scene_seed")

    def _family(self, scene_seed: Any) -> Family:
        if scene_seed not in self._families or self._families[scene_seed].closed:
            options = {**self._options, "scene_seed": scene_seed}
            words = ["fleet", positional("scenario", self._scenario), f"--planner={self._planner}",
                     *option_arguments(options)]
            self._families[scene_seed] = Family(words, self._launcher, self._options.get("agent_timeout"))
        return self._families[scene_seed]

    def _start(self, seed: int) -> None:
        if self._worker is not None:
            self._worker.let_go()
            self._worker = None
        worker = self._family(self._scene()).worker(seed)
        self._log = {}
        self._started = (seed, self._scene())
        self._over = False
        self._score = float(worker.views["truth.score"][()])
        self.agents = list(self.possible_agents)
        self._take(worker)

    def _take(self, worker: Worker) -> None:
        self._flying = False
        self._observations = {uav: Observations(uav, worker.fields, worker.block) for uav in self.possible_agents}
        self._orders = {uav: Orders(uav, self._actions, worker.views) for uav in self.possible_agents}
        self._worker = worker  # last: if Ctrl-C comes before, the fleet refuses to fly with the arrays of two processes

    def _give_up(self) -> None:
        """Ends the fleet if it flies. Otherwise, its reply to this step would count as the reply to the next one."""
        if self._flying and self._worker is not None:
            self._worker.let_go()

    def _check_open(self) -> None:
        if self._closed:
            raise InputError("the fleet is closed: make another one, or do not call close() before")

    def _running(self) -> Worker:
        self._check_open()
        if self._worker is None:
            raise InputError("the fleet could not begin: call reset()")
        self._worker.check()
        return self._worker

    def _steps_of(self, step_s: float) -> int:
        try:
            steps = settings.number("step_s", step_s) / self._period_s
        except InputError:
            steps = 0.0
        if steps < 0.5 or abs(steps - round(steps)) > 1e-6:
            raise InputError(f"step_s must be a multiple of {self._period_s:g} s, the exchange's period, "
                             f"not {step_s!r:.80}")
        return min(round(steps), _MOST_STEPS)

    def _info(self) -> dict[str, Any]:
        return {"seed": self._started[0], "step": int(self._running().views["truth.step"])}
