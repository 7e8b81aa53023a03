"""Stepped fleets: the rules of PettingZoo's and Gymnasium's interfaces, digests, and observations of learners."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import skein
from skein.stepping.actions import Orders

LEARNERS = ["jurong", "sentosa"]  # an explorer and a photographer


def drawn_action(random: np.random.Generator) -> dict[str, Any]:
    return {"velocity": random.uniform([-2.0, -2.0, -0.5], [2.0, 2.0, 1.5]), "yaw_rate": random.uniform(-0.5, 0.5),
            "gimbal_rate": random.uniform(-0.3, 0.3, 2)}


def fly(fleet: skein.Fleet, random: np.random.Generator, until_s: float) -> None:
    """Flies with random actions, in steps of random length."""
    while not fleet.over and (left := round(min(until_s - fleet.truth.time_s, 1e6) / 0.05)) > 0:
        fleet.step({uav: drawn_action(random) for uav in fleet.agents},
                   step_s=0.05 * min(left, int(random.integers(1, 12))))


def same(a: Any, b: Any) -> bool:
    return a.keys() == b.keys() and all(np.array_equal(a[name], b[name]) for name in a)


@pytest.fixture(scope="module")
def fleet() -> Iterator[skein.Fleet]:
    """A fleet that several tests use. A test that needs a new mission calls reset()."""
    with skein.Fleet("towers", planner="patrol", seed=3, learners=LEARNERS, stop_at=6, step_s=0.1) as made:
        yield made


# -- PettingZoo's ParallelEnv, clause by clause -----------------------------------------------------------------------

def test_a_fleet_has_the_attributes_of_a_parallel_env(fleet: skein.Fleet) -> None:
    assert isinstance(fleet.metadata["name"], str) and "ansi" in fleet.metadata["render_modes"]
    assert fleet.possible_agents == LEARNERS and fleet.max_num_agents == 2
    for uav in LEARNERS:
        assert fleet.observation_space(uav) is fleet.observation_space(uav), "each call must return the same object"
        assert fleet.action_space(uav) is fleet.action_space(uav)
    assert fleet.observation_spaces.keys() == fleet.action_spaces.keys() == set(LEARNERS)
    assert fleet.unwrapped is fleet
    with pytest.raises(skein.InputError, match="no learner 'raffles'"):
        fleet.observation_space("raffles")


def test_an_episode_keeps_the_interface_from_reset_to_its_end(fleet: skein.Fleet) -> None:
    observations, infos = fleet.reset(seed=5)
    assert fleet.agents == LEARNERS and fleet.num_agents == 2
    assert observations.keys() == infos.keys() == set(LEARNERS)
    for uav in LEARNERS:
        fleet.action_space(uav).seed(7)
    steps = 0
    while fleet.agents:
        agents = list(fleet.agents)
        actions = {uav: fleet.action_space(uav).sample() for uav in agents}
        assert all(fleet.action_space(uav).contains(actions[uav]) for uav in agents)
        observations, rewards, terminations, truncations, infos = fleet.step(actions)
        for part in (observations, rewards, terminations, truncations, infos):
            assert part.keys() == set(agents)
        for uav in agents:
            assert fleet.observation_space(uav).contains(observations[uav]), uav
            assert type(rewards[uav]) is float
            assert type(terminations[uav]) is bool and type(truncations[uav]) is bool
            assert isinstance(infos[uav], dict)
            assert (uav in fleet.agents) == (not terminations[uav] and not truncations[uav])
        assert fleet.state_space.contains(fleet.state())
        steps += 1
    assert steps == 60 and fleet.over and all(truncations.values())
    with pytest.raises(skein.InputError, match="reset"):
        fleet.step({})
    fleet.reset()
    assert fleet.agents == LEARNERS and not fleet.over


@pytest.mark.parametrize("step_s", [1e9, 1.8e19 * 0.05, 1e300])
def test_a_step_beyond_the_end_ends_at_it(fleet: skein.Fleet, step_s: float) -> None:
    fleet.reset(seed=5)
    fleet.step({})
    truncations = fleet.step({}, step_s=step_s)[3]
    assert fleet.over and truncations == dict.fromkeys(LEARNERS, True)


def test_the_seed_determines_the_flight(fleet: skein.Fleet) -> None:
    flights = []
    for seed in (11, 12, 11, None):
        begin, infos = fleet.reset(seed=seed)
        assert infos["jurong"]["seed"] == (12 if seed is None else seed), "reset() without a seed must use the next one"
        fly(fleet, np.random.default_rng(1), 1.5)
        flights.append((begin["jurong"], fleet.result()["digest"]))
    assert same(flights[0][0], flights[2][0]) and flights[0][1] == flights[2][1]
    assert flights[1][1] == flights[3][1] != flights[0][1]
    assert not same(flights[0][0], flights[1][0]), "two seeds gave the same starts"


@pytest.mark.parametrize(("actions", "wrong", "match"), [
    *(("goal", {"path": path}, "path must") for path in (5, None, [1, 2], [(0, 0, 1), (1, 2)], {"x": 1})),
    ("goal", {"goal": 10**400}, "goal must"), ("goal", {"goal": (0, 0, 1), "speed": "fast"}, "speed must"),
    ("goal", {"path": [], "yaw": [1]}, "yaw must"), ("velocity", {"velocity": (0, 10**400, 0)}, "velocity must"),
    ("velocity", {"look_at": 5}, "look_at must"), ("velocity", {"trigger": [1, [2]]}, "trigger must"),
])
def test_a_wrong_value_in_an_action_is_named(actions: str, wrong: Any, match: str) -> None:
    with pytest.raises(skein.InputError, match=match):
        Orders("jurong", actions, {}).read(wrong)


def test_later_steps_do_not_change_earlier_observations(fleet: skein.Fleet) -> None:
    first, _ = fleet.reset(seed=1)
    kept = {name: value.copy() for name, value in first["jurong"].items()}
    fly(fleet, np.random.default_rng(2), 2.0)
    assert same(first["jurong"], kept)


def test_a_uav_that_collides_terminates_and_the_others_go_on() -> None:
    with skein.Fleet("towers", planner="hover", learners=LEARNERS, safe=False, duration=60, step_s=0.5) as fleet:
        fleet.reset()
        up, down = {"velocity": (0, 0, 3)}, {"velocity": (0, 0, 0)}
        for _ in range(8):
            fleet.step({"jurong": up, "sentosa": up})
        here, there = fleet.truth.position[[0, fleet.uavs.index("sentosa")]]
        gone: dict[str, bool] = {}
        # Flies towards the other UAV. The heading is 0, so the velocity in W is the one that the action needs.
        while fleet.agents and not fleet.over and not gone.get("jurong"):
            here, there = fleet.truth.position[[0, fleet.uavs.index("sentosa")]]
            way = there - here
            _, _, gone, cut, _ = fleet.step({"jurong": {"velocity": 4.0 * way / np.linalg.norm(way)}, "sentosa": down})
        assert gone["jurong"] and not cut["jurong"] and "jurong" not in fleet.agents
        assert not fleet.truth.alive[0]
        assert {hit["uav"] for hit in fleet.result()["collisions"]} >= {"jurong"}
        time_s = fleet.truth.time_s
        fleet.step({})
        assert fleet.truth.time_s > time_s, "the fleet did not fly on"


def test_only_fork_copies_a_fleet(fleet: skein.Fleet) -> None:
    """Two objects with the same process would read each other's replies."""
    for copied in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(skein.InputError, match=r"fork\(\)"):
            copied(fleet)
    with fleet.fork() as other:
        assert other.truth.step == fleet.truth.step


def test_render_returns_text_only_with_render_mode_ansi(fleet: skein.Fleet) -> None:
    fleet.reset()
    assert fleet.render() is None
    with skein.Fleet("towers", learners=["jurong"], render_mode="ansi", duration=3) as drawn:
        text = drawn.render()
        assert text is not None and "jurong" in text and "learner" in text


# -- Gymnasium's Env --------------------------------------------------------------------------------------------------

def test_a_fleet_with_one_learner_is_a_gymnasium_env() -> None:
    with skein.gym_env("changi", "towers", stop_at=2, step_s=0.2, seed=4) as env:
        observation, info = env.reset(seed=9)
        assert env.observation_space.contains(observation) and isinstance(info, dict)
        env.action_space.seed(3)
        ended = False
        for step in range(10):
            observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
            assert env.observation_space.contains(observation)
            assert type(reward) is float and type(terminated) is bool and type(truncated) is bool
            ended = terminated or truncated
            assert ended == (step == 9)
        with pytest.raises(skein.InputError, match="reset"):
            env.step(env.action_space.sample())
        again, _ = env.reset(seed=9)
        assert env.unwrapped is env and env.observation_space.contains(again)
    with pytest.raises(skein.InputError, match="one UAV"):
        skein.GymEnv(skein.Fleet("towers", learners=LEARNERS, duration=2))


# -- the same flight as on the command line ---------------------------------------------------------------------------

@pytest.mark.parametrize("scenario, planner, seed", [("towers", "patrol", 3), ("cranes", "kios", 1)])
def test_a_fleet_without_learners_flies_the_launchers_flight(
        scenario: str, planner: str, seed: int, tmp_path: Path) -> None:
    run = skein.run(scenario, planner=planner, seed=seed, duration=12, one_process=True, no_oracle=True,
                    no_report=True, out=tmp_path / "run")
    with skein.Fleet(scenario, planner=planner, seed=seed, duration=12) as fleet:
        fly(fleet, np.random.default_rng(seed), 1e9)
        result = fleet.result()
    assert result["digest"] == run.digest
    assert result["score"] == run.score
    assert result["over"] and result["sim_time_s"] == run.sim_time_s
    assert [uav["captures"] for uav in result["uavs"]] == [uav["captures"] for uav in run.result["uavs"]]


@pytest.mark.parametrize("safe", [True, False])
def test_the_launcher_flies_the_commands_of_learners_again(safe: bool, tmp_path: Path) -> None:
    random = np.random.default_rng(8)
    with skein.Fleet("towers", planner="patrol", seed=2, learners=LEARNERS, safe=safe, duration=10) as fleet:
        fleet.reset()
        fleet.step({uav: {**drawn_action(random), "velocity": (0, 0, 1.5)} for uav in LEARNERS}, step_s=3)
        fly(fleet, random, 1e9)
        files = {uav: fleet.save_commands(uav, tmp_path / f"{uav}.csv") for uav in LEARNERS}
        result = fleet.result()
        moved = [uav["distance_m"] for uav in result["uavs"] if uav["name"] in LEARNERS]
    hands = ",".join(f"{uav}=hand:file={file},safe={str(safe).lower()}" for uav, file in files.items())
    run = skein.run("towers", planner=f"patrol,{hands}", seed=2, duration=10, one_process=True, no_oracle=True,
                    no_report=True, out=tmp_path / "run")
    assert run.digest == result["digest"] and max(moved) > 2.0


def test_the_length_of_steps_does_not_change_the_flight() -> None:
    digests = set()
    for steps in (1, 5, 20):
        with skein.Fleet("towers", seed=1, learners=["raffles"], duration=30) as fleet:
            fleet.reset()
            for i in range(4):
                action = {"raffles": {"velocity": (0.5 * i, 0.2, 1.0), "yaw_rate": 0.1, "gimbal_rate": (0, 0.1)}}
                for _ in range(20 // steps):
                    fleet.step(action, step_s=0.05 * steps)
            digests.add(fleet.result()["digest"])
    assert len(digests) == 1


def test_a_uav_reaches_its_goal_and_observes_that() -> None:
    with skein.Fleet("towers", planner="hover", learners=["jurong"], actions="goal", duration=60) as fleet:
        observations, _ = fleet.reset()
        start = observations["jurong"]["position"]
        goal = start + (0.0, 0.0, 6.0)
        observations, *_ = fleet.step({"jurong": {"goal": goal, "speed": 2.0, "look_at": (0, 0, 5)}}, step_s=1)
        while observations["jurong"]["goal"] not in (2, 3, 4) and not fleet.over:
            observations, *_ = fleet.step(step_s=0.5)
        assert observations["jurong"]["goal"] == 2
        assert np.linalg.norm(observations["jurong"]["position"] - goal) < 1.0
        assert observations["jurong"]["airborne"] == 1 and observations["jurong"]["map"].max() >= 0


def test_without_the_filter_a_path_is_flown_unchanged() -> None:
    with skein.Fleet("towers", planner="hover", learners=["jurong"], actions="goal", safe=False, scans=True,
                     duration=60) as fleet:
        observations, _ = fleet.reset()
        start = observations["jurong"]["position"]
        assert observations["jurong"]["scan"].shape[1] == 3
        path = start + np.array([(0, 0, 3), (2, 0, 3)])
        observations, *_ = fleet.step({"jurong": {"path": path, "speed": 2.0, "yaw": 0.5, "trigger": True}}, step_s=10)
        assert np.linalg.norm(observations["jurong"]["position"] - path[-1]) < 0.5
        assert 0.0 <= observations["jurong"]["scan_age_s"] < 1.0 and observations["jurong"]["scan_points"] > 0
        with pytest.raises(skein.InputError, match="actions='velocity'"):
            fleet.save_commands("jurong", "x.csv")


def test_rewards_are_scores_at_the_station_or_those_of_the_users_function() -> None:
    with skein.Fleet("towers", planner="patrol", seed=2, learners=["nanyang"], step_s=5, duration=60) as fleet:
        fleet.reset()
        total = 0.0
        while not fleet.over:
            _, rewards, *_ = fleet.step()
            total += rewards["nanyang"]
        assert total == pytest.approx(fleet.result()["score"]) and total == pytest.approx(fleet.truth.score)
        points = fleet.truth.points
        assert points["delivered"][points["delivered"] >= 0.2].sum() == pytest.approx(total, rel=1e-4)
    with skein.Fleet("towers", learners=["nanyang"], stop_at=5, step_s=1,
                     reward=lambda fleet, uav: -fleet.truth.time_s) as fleet:
        fleet.reset()
        assert fleet.step()[1] == {"nanyang": -1.0}


def test_the_truth_differs_from_the_observations_of_a_uav(faults: Path, tmp_path: Path) -> None:
    file = tmp_path / "jump.yaml"
    file.write_text("faults:\n  - {at_s: 1, odometry_jump: {uav: jurong, offset_m: [5, 0, 0]}}\n")
    with skein.Fleet("towers", learners=["jurong"], faults=file, duration=10) as fleet:
        fleet.reset()
        observations, *_ = fleet.step(step_s=2)
        assert observations["jurong"]["position"][0] - fleet.truth.position[0, 0] == pytest.approx(5.0)
        assert len(fleet.truth.boxes) > 0 and len(fleet.truth.points) > 100
    kills = tmp_path / "kill.yaml"
    kills.write_text("faults:\n  - {at_s: 1, until_s: 2, kill: station}\n")
    with pytest.raises(skein.InputError, match="kill or pause"):
        skein.Fleet("towers", faults=kills)


def test_calls_after_close_are_refused_with_a_message() -> None:
    fleet = skein.Fleet("towers", learners=["jurong"], duration=5)
    truth = fleet.truth
    fleet.close()
    for call in (fleet.step, fleet.reset, fleet.fork, fleet.result, fleet.state, lambda: fleet.truth,
                 lambda: truth.points):
        with pytest.raises(skein.InputError, match="closed|ended"):
            call()
    assert "closed" in repr(fleet)
