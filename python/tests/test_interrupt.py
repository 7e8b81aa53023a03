"""After Ctrl-C, or the end of the program that flies a fleet, no process remains, and the results so far are there. A
fleet that is flown step by step can be used again, or says that it cannot."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import skein
from interrupts import Interrupts
from processes import PATIENCE_S, Watch, processes_in
from skein.stepping import worker

_FLIGHT = """
import sys
sys.path.insert(0, {package!r})
import skein
try:
    skein.run("towers", planner="kios", duration=600, verbose=True, no_report=True, {options})
except KeyboardInterrupt as interrupt:
    print("said:", interrupt)
    raise SystemExit(5)
"""


def start(folder: Path, options: str = "") -> subprocess.Popen[str]:
    """Starts a Python program that flies a fleet in `folder`, in a session of its own. Returns when the fleet flies."""
    code = _FLIGHT.format(package=str(Path(skein.__file__).parents[1]), options=options)
    child = subprocess.Popen([sys.executable, "-c", code], cwd=folder, text=True, start_new_session=True,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)
    assert child.stderr is not None
    seen = []
    for line in child.stderr:
        seen.append(line)
        if line.startswith("simulated "):
            return child
    raise AssertionError(f"it did not fly: {seen}")


@pytest.mark.parametrize("how, options", [("terminal", ""), ("notebook", "one_process=True")])
def test_an_interrupt_ends_the_fleet_and_keeps_the_result(tmp_path: Path, how: str, options: str) -> None:
    child = start(tmp_path, options)
    assert len(processes_in(tmp_path)) > (2 if options else 7)
    # A terminal sends SIGINT to its whole foreground process group, a notebook only to the interpreter.
    os.killpg(child.pid, signal.SIGINT) if how == "terminal" else child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=PATIENCE_S)
    assert child.returncode == 5
    folder = tmp_path / "runs" / "towers-kios-0"
    assert f"said: interrupted; what was flown until then is in {folder.relative_to(tmp_path)}\n" in out
    assert processes_in(tmp_path) == {}
    assert skein.Run(folder).status == "interrupted"


def test_a_program_that_is_killed_leaves_no_orphan(tmp_path: Path) -> None:
    child = start(tmp_path)
    watch = Watch(tmp_path)
    assert len(watch.names) > 7
    child.kill()
    child.communicate(timeout=PATIENCE_S)
    assert watch.still_there_after_waiting() == []
    assert skein.Run(tmp_path / "runs" / "towers-kios-0").status == "interrupted"


def test_an_exception_in_the_users_code_ends_the_fleet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Enough(Exception):
        pass

    class Stream:
        """A user's stream that raises an exception during the flight."""

        def write(self, text: str) -> None:
            if "simulated" in text:
                raise Enough

        def flush(self) -> None:
            pass

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "stderr", Stream())
    with pytest.raises(Enough):
        skein.run("towers", planner="kios", duration=600, one_process=True, verbose=True)
    others = {pid: name for pid, name in processes_in(tmp_path).items() if pid != os.getpid()}
    assert others == {}


def test_the_users_signal_handler_stays_installed(tmp_path: Path) -> None:
    def mine(_number: int, _frame: object) -> None:
        pass

    program = tmp_path / "launcher"
    program.write_text(f"#!/bin/sh\necho 'results   {tmp_path}'\nkill -INT {os.getpid()}\n")
    program.chmod(0o755)
    before = signal.signal(signal.SIGINT, mine)
    try:
        assert skein.run(launcher=program).path == tmp_path
        assert signal.getsignal(signal.SIGINT) is mine
    finally:
        signal.signal(signal.SIGINT, before)
    with pytest.raises(KeyboardInterrupt, match="what was flown until then is in"):
        skein.run(launcher=program)
    assert signal.getsignal(signal.SIGINT) is before


def test_ctrl_c_while_the_launcher_starts_reaches_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / "launcher"
    program.write_text(f"#!/bin/sh\ntrap 'echo \"results   {tmp_path}\"; exit 130' INT\n"
                       "while :; do sleep 0.05; done\n")
    program.chmod(0o755)
    popen, children = subprocess.Popen, []

    def interrupted_popen(*words: Any, **options: Any) -> Any:
        child = popen(*words, **options)
        children.append(child)
        os.kill(os.getpid(), signal.SIGINT)  # before Popen() has returned the process to its caller
        return child

    monkeypatch.setattr(subprocess, "Popen", interrupted_popen)
    with pytest.raises(KeyboardInterrupt):
        skein.run(launcher=program)
    assert children and children[0].poll() is not None


def interrupted(interrupts: Interrupts, number: int, call: Any) -> bool:
    """Interrupts a call at an instruction. Returns whether the call has so many."""
    try:
        with interrupts.at_instruction(number):
            call()
    except KeyboardInterrupt:
        return True
    return False


def open_files() -> set[str]:
    return set(os.listdir("/proc/self/fd"))


def test_closing_a_process_can_be_interrupted_at_any_instruction_and_repeated() -> None:
    interrupts, number, goes_on = Interrupts(), 0, True
    before = open_files()
    while goes_on:
        number += 1
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        theirs.setblocking(False)
        process = worker._Process(ours, worker._memory_file("log"))
        goes_on = interrupted(interrupts, number, process.let_go)
        assert process.closed == (ours.fileno() < 0), f"instruction {number}"
        with open(os.devnull, "rb") as other:  # this file may get the number of one that close() has just closed
            process.let_go()
            process.let_go()
            assert process.closed and other.read() == b"", f"instruction {number}"
        assert theirs.recv(1) == b"", "the connection is still open, so the process would not end"
        theirs.close()
        assert open_files() == before, f"instruction {number}"
    assert number > 10, "hardly any instruction was interrupted"


def test_a_fleet_whose_reset_was_interrupted_flies_the_new_mission_or_refuses_to_fly() -> None:
    interrupts = Interrupts()
    with skein.Fleet("towers", learners=["jurong"], duration=10, no_check=True) as fleet:
        fleet.reset(seed=1)
        interrupted(interrupts, 0, lambda: fleet.reset(seed=1))
        count = interrupts.instructions
        struck, flown, refused = 0, 0, 0
        for number in range(count // 3, count, count // 45):  # most of these are in the new process's time
            struck += interrupted(interrupts, number, lambda: fleet.reset(seed=1))
            try:
                times_s = [fleet.step()[0]["jurong"]["time_s"] for _ in range(2)]
                assert times_s[0] < times_s[1], f"instruction {number} of {count}: not its own mission"
                flown += 1
            except skein.InputError:
                refused += 1
    assert struck > 20 and flown > 0 and refused > 0, (struck, flown, refused)
