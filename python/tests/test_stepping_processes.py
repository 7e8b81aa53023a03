"""Processes of stepped fleets: copies, crashes, wrong input, and processes that remain."""

from __future__ import annotations

import gc
import json
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import skein
from processes import Watch, processes_in
from test_stepping import drawn_action, fly

HERE = Path(__file__).parent


def workers() -> dict[int, str]:
    """All descendants of this process, by id."""
    parents = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                words = (entry / "stat").read_text().rsplit(")", 1)[1].split()
            except OSError:
                continue
            parents[int(entry.name)] = (int(words[1]), words[0])
    below, grown = {os.getpid()}, True
    while grown:
        more = {pid for pid, (parent, _) in parents.items() if parent in below} - below
        below |= more
        grown = bool(more)
    return {pid: parents[pid][1] for pid in below - {os.getpid()}}


def wait_for_end(pid: int) -> None:
    try:
        descriptor = os.pidfd_open(pid)
    except ProcessLookupError:
        return
    import select
    poll = select.poll()
    poll.register(descriptor, select.POLLIN)
    assert poll.poll(60_000), f"process {pid} is still there"
    os.close(descriptor)


def pid_of(fleet: skein.Fleet) -> int:
    assert fleet._worker is not None
    return fleet._worker.pid


# -- copies -----------------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("planner, seed", [("patrol", 1), ("kios", 2), ("star", 3)])
def test_a_copy_flies_as_its_original(planner: str, seed: int) -> None:
    random = np.random.default_rng(seed)
    with skein.Fleet("towers", planner=planner, seed=seed, learners=["jurong"], duration=40) as fleet:
        fleet.reset()
        fly(fleet, random, float(random.uniform(2, 8)))
        with fleet.fork() as copy:
            assert pid_of(copy) != pid_of(fleet) and copy.truth.step == fleet.truth.step
            with copy.fork() as other:  # flies differently, which must not affect the others
                fly(other, np.random.default_rng(99), copy.truth.time_s + 2)
                until_s = copy.truth.time_s + 3
                fly(copy, np.random.default_rng(seed), until_s)
                fly(fleet, np.random.default_rng(seed), until_s)
                assert copy.result()["digest"] == fleet.result()["digest"] != other.result()["digest"]
        fly(fleet, random, fleet.truth.time_s + 1)


def test_a_copy_outlives_its_original_and_an_original_its_copy() -> None:
    fleet = skein.Fleet("towers", learners=["jurong"], duration=10)
    copies = [fleet.fork() for _ in range(3)]
    gone = [pid_of(fleet), pid_of(copies[1])]
    fleet.close()
    copies[1].close()
    for pid in gone:
        wait_for_end(pid)
    copies[0].step({"jurong": {"velocity": (0, 0, 1)}})
    again = copies[2].fork()
    again.step()
    again.reset(seed=4)
    for one in (copies[0], copies[2], again):
        one.close()


def test_fleets_side_by_side_fly_as_alone() -> None:
    def flights(together: bool) -> list[str]:
        digests = []
        with skein.vector_env(3, "towers", planner="patrol", seed=5, learners=["jurong"], duration=4) as fleets:
            fleets.reset(seed=[7, 8, 9])
            for step in range(20):
                random = np.random.default_rng(step)
                actions = [{"jurong": drawn_action(random)} for _ in fleets]
                if together:
                    fleets.step(actions, step_s=0.1)
                else:
                    for fleet, action in zip(fleets, actions):
                        fleet.step(action, step_s=0.1)
            digests = [fleet.result()["digest"] for fleet in fleets]
        return digests

    together = flights(True)
    assert together == flights(False) and len(set(together)) == 3


def test_a_vector_refuses_wrong_input_and_stays_usable() -> None:
    with skein.vector_env(2, "towers", learners=["jurong"], stop_at=1, step_s=0.5) as fleets:
        fleets.reset(seed=1)
        with pytest.raises(skein.InputError, match="2 fleets, and 1 actions"):
            fleets.step([{}])
        with pytest.raises(skein.InputError, match="finite"):
            fleets.step([{}, {"jurong": {"velocity": (0, 0, np.nan)}}])
        assert [fleet.truth.time_s for fleet in fleets] == [0.5, 0.0]
        fleets[1].step()
        fleets.step([{}, None])
        assert fleets.step([{}, {}])[0] == [{}, {}], "fleets whose missions are over returned observations"
    with pytest.raises(skein.InputError, match="1 or more"):
        skein.vector_env(0)


# -- ends -------------------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT])
def test_a_crash_is_an_exception_and_reset_begins_anew(number: signal.Signals) -> None:
    with skein.Fleet("towers", planner="patrol", learners=["jurong"]) as fleet:
        fleet.reset(seed=1)
        copy = fleet.fork()
        fleet.begin_step(step_s=600)
        os.kill(pid_of(fleet), number)
        with pytest.raises(skein.ProcessError) as caught:
            fleet.end_step()
        assert caught.value.exit_code == 3
        with pytest.raises(skein.InputError, match="reset"):
            fleet.step()
        copy.step()
        copy.close()
        fleet.reset(seed=1)
        fleet.step()


def test_an_order_that_does_not_exist_is_refused() -> None:
    for unknown in ("results", "Scene", ""):
        with skein.Fleet("towers", planner="hover", learners=["jurong"]) as fleet:
            fleet.reset(seed=1)
            assert fleet._worker is not None
            with pytest.raises(skein.ProcessError, match=f'no order "{unknown}"'):
                fleet._worker.ask(unknown)


def test_a_process_that_cannot_load_its_scene_says_why(tmp_path: Path) -> None:
    program = Path(skein.find_launcher()).with_name("uav_agent_fleet")
    if not program.exists():
        pytest.skip(f"{program} is not built")
    plan = tmp_path / "plan.json"
    plan.write_text('{"about": {}, "uavs": [], "programs": []}')
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    words = [program, "--session", str(theirs.fileno()), "--plan", plan]
    with ours, subprocess.Popen(words, pass_fds=(theirs.fileno(),), stderr=subprocess.PIPE, text=True) as process:
        theirs.close()
        assert "no sim_server" in json.loads(ours.recv(4096))["failed"]
        assert "no sim_server" in process.communicate()[1] and process.returncode == 3


NAMED = ["throws", "throws_number", "segfaults", "aborts", "exits", "overflows", "hangs"]


@pytest.mark.parametrize("how", [*NAMED, "stops", "closes", "exits_now", "becomes"])
def test_each_failure_of_a_planner_is_an_exception_that_names_it(how: str) -> None:
    agent = Path(skein.find_launcher()).parents[1] / "tests" / "nasty_agent"
    if not agent.exists():
        pytest.skip(f"{agent} is not built")
    with skein.Fleet("towers", planner=f"hover,raffles=nasty:how={how},at_s=0.5", learners=["jurong"], agent=agent,
                     agent_timeout=1, no_check=True) as fleet:
        fleet.reset()
        fleet.step(step_s=0.3)
        fleet.begin_step(step_s=1)
        with pytest.raises(skein.ProcessError) as caught:
            fleet.end_step()
        if how in NAMED:
            assert "uav_agent-raffles" in str(caught.value) and f"nasty {how}" in str(caught.value)
        pid = pid_of(fleet)
        fleet.reset()
        fleet.step(step_s=0.3)
    wait_for_end(pid)


def test_closed_and_deleted_fleets_leave_nothing_behind() -> None:
    before = set(workers())
    fleet = skein.Fleet("towers", learners=["jurong"], duration=5)
    fleet.reset(seed=2)
    copy = fleet.fork()
    started = set(workers()) - before
    assert len(started) >= 3
    fleet.close()
    fleet.close()  # a second call does nothing
    del copy  # deleted without close()
    gc.collect()
    for pid in started:
        wait_for_end(pid)
    assert not set(workers()) - before


def test_many_resets_grow_neither_memory_nor_files_nor_processes() -> None:
    def figures(fleet: skein.Fleet) -> tuple[int, int, int]:
        root = fleet._families[None]._root.pid
        text = Path(f"/proc/{root}/status").read_text()
        own = Path("/proc/self/statm").read_text().split()[1]
        return (int(text.split("VmRSS:")[1].split()[0]), int(own) * os.sysconf("SC_PAGE_SIZE") // 1024,
                len(list(Path("/proc/self/fd").iterdir())))

    with skein.Fleet("towers", planner="hover", learners=["jurong"], duration=5) as fleet:
        for seed in range(10):
            fleet.reset(seed=seed)
        first = figures(fleet)
        for seed in range(60):
            fleet.reset(seed=seed)
            fleet.step()
        gc.collect()
        last = figures(fleet)
        assert last[0] <= first[0] + 512 and last[1] <= first[1] + 4096 and last[2] <= first[2]
        assert sum(state != "Z" for state in workers().values()) <= 8


def test_a_long_log_is_emptied_and_goes_on_at_its_beginning() -> None:
    with skein.Fleet("towers", planner="hover", learners=["jurong"]) as fleet:
        fleet.reset()
        assert fleet._worker is not None
        log = fleet._worker._log.fileno()
        os.write(log, b"x" * (5 << 20))  # the offset is shared with the process
        for _ in range(1024):  # one check of the log's length
            fleet.step(step_s=0.05)
        os.write(log, b"news")
        content = os.pread(log, 6 << 20, 0)
        assert content.endswith(b"news") and len(content) < 1 << 20 and b"\0" not in content


SCRIPT = """
import os, signal, sys
sys.path.insert(0, {package!r})
import skein
fleet = skein.Fleet("towers", learners=["jurong"])
copies = [fleet.fork(), fleet.fork()]
{then}
"""


def started(folder: Path, then: str) -> subprocess.Popen[str]:
    """Starts a program with the working folder `folder`, by which its processes are found. Returns when it is ready."""
    child = subprocess.Popen([sys.executable, "-c", SCRIPT.format(package=str(HERE.parent), then=then)], cwd=folder,
                             stdout=subprocess.PIPE, stdin=subprocess.PIPE, text=True, stderr=subprocess.STDOUT)
    assert child.stdout is not None and child.stdout.readline() == "ready\n"
    return child


@pytest.mark.parametrize("then", ["print('ready', flush=True); input()",
                                  "print('ready', flush=True); fleet.step(step_s=600)"])
def test_a_killed_script_takes_all_its_processes_along(then: str, tmp_path: Path) -> None:
    child = started(tmp_path, then)
    watch = Watch(tmp_path)
    assert len(watch.names) >= 5
    child.kill()
    child.communicate()
    assert watch.still_there_after_waiting() == []


def test_ctrl_c_is_an_interrupt_and_leaves_nothing(tmp_path: Path) -> None:
    then = ("try:\n    print('ready', flush=True)\n    fleet.step(step_s=600)\n"
            "except KeyboardInterrupt:\n    print('interrupted', flush=True)\n"
            "copies[0].step()\n"
            "fleet.reset(seed=2)\n"
            "fleet.step()\n"
            "print('flies', flush=True)")
    child = started(tmp_path, then)
    watch = Watch(tmp_path)
    child.send_signal(signal.SIGINT)
    said, _ = child.communicate()
    assert said.split() == ["interrupted", "flies"], said
    assert watch.still_there_after_waiting() == [] and processes_in(tmp_path) == {}


def test_a_forked_interpreter_cannot_use_the_fleet() -> None:
    with skein.Fleet("towers", learners=["jurong"], duration=5) as fleet:
        fleet.reset()
        read, write = os.pipe()
        hold_read, hold_write = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(hold_write)
            said = "no exception"
            try:
                fleet.step()
            except skein.InputError as error:
                said = str(error)
            os.write(write, said.encode())
            os.read(hold_read, 1)  # the copy lives longer than the fleet
            os._exit(0)
        os.close(hold_read)
        os.close(write)
        assert "copy" in os.read(read, 1000).decode()
        fleet.step()
        pid = pid_of(fleet)
    wait_for_end(pid)
    os.close(hold_write)
    os.waitpid(child, 0)
    os.close(read)


# -- input that is wrong ----------------------------------------------------------------------------------------------

@pytest.mark.parametrize("scenario, options, said", [
    ("towrs", {}, "towers"),
    ("towers", {"planner": "partol"}, "patrol"),
    ("towers", {"learners": ["jurng"]}, "jurng"),
    ("towers", {"durration": 3}, "--durration"),
    ("towers", {"duration": -1}, "--duration"),
    ("towers", {"one_process": True}, "--one-process"),
    ("towers", {"step_s": 0.07}, "multiple of 0.05"),
    ("towers", {"step_s": float("nan")}, "multiple of 0.05"),
    ("towers", {"actions": "thrust"}, "'velocity'"),
    ("towers", {"render_mode": "human"}, "ansi"),
    ("towers", {"seed": -1}, "seed"),
    ("towers", {"seed": 1.5}, "seed"),
    ("towers", {"map_window": (4, 4)}, "three numbers"),
    ("towers", {"learners": ["jurong"], "map_cell_m": 0.1}, "map_cell_m"),
    ("towers", {"planner": "patrol,jurong=exec:true"}, "exec"),
])
def test_a_fleet_that_cannot_be_flown_is_refused(scenario: str, options: dict[str, Any], said: str) -> None:
    before = set(workers())
    with pytest.raises(skein.InputError, match=said):
        skein.Fleet(scenario, **options)
    gc.collect()
    for pid in set(workers()) - before:
        wait_for_end(pid)


def bad_actions() -> list[tuple[dict[str, Any], str]]:
    """Actions with an invalid value in one part, and the expected message; partly random."""
    random = np.random.default_rng(4)
    shapes: dict[str, tuple[int, ...]] = {"velocity": (3,), "yaw_rate": (), "gimbal_rate": (2,), "gimbal": (2,),
                                          "look_at": (3,)}
    found: list[tuple[dict[str, Any], str]] = [
        ({"velocity": "fast"}, "numbers"), ({"speed": 3}, "no 'speed'"), ({"trigger": 2}, "0 or 1"),
        ({"trigger": [1]}, "0 or 1"), ({"gimbal": (0, 0), "look_at": (0, 0, 0)}, "one of"),
        ({"velocity": None}, "velocity"),
        ({"velocity": [[1], [2, 3]]}, "numbers"), ({3: 4}, "there is no 3")]
    for name, shape in shapes.items():
        for _ in range(4):
            wrong = tuple(int(size) for size in random.integers(0, 5, int(random.integers(0, 3))))
            if wrong != shape:
                found.append(({name: random.normal(size=wrong)}, "shape"))
            value = np.array(random.normal(size=shape))
            value.flat[int(random.integers(max(value.size, 1)))] = random.choice([np.nan, np.inf, -np.inf])
            found.append(({name: value}, "finite"))
    return found


def test_refused_actions_and_calls_do_not_change_the_flight() -> None:
    with skein.Fleet("towers", learners=["jurong", "raffles"], duration=5) as fleet, fleet.fork() as other:
        good = {"velocity": (0, 0, 1), "gimbal_rate": (0, 0)}
        for action, said in bad_actions():
            with pytest.raises(skein.InputError, match=said):
                fleet.step({"raffles": good, "jurong": action})
        for actions in ({"nobody": good}, {"changi": good}, [good], "jurong"):
            with pytest.raises(skein.InputError):
                fleet.step(actions)  # type: ignore[arg-type]
        with pytest.raises(skein.InputError, match="dictionary"):
            fleet.step({"jurong": 3})  # type: ignore[dict-item]
        with pytest.raises(skein.InputError, match="multiple"):
            fleet.step({}, step_s=0.01)
        with pytest.raises(skein.InputError, match="knows scene_seed"):
            fleet.reset(options={"wind": 3})
        with pytest.raises(skein.InputError, match="begin_step"):
            fleet.end_step()
        assert fleet.truth.step == 0
        for one in (fleet, other):
            one.step({"jurong": good}, step_s=2)
        assert fleet.result()["digest"] == other.result()["digest"]
        fleet.begin_step()
        for call in (fleet.begin_step, fleet.fork):
            with pytest.raises(skein.InputError, match="end_step"):
                call()
        fleet.end_step()
