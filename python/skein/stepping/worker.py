"""Processes in which fleets fly, and the protocol with which this program controls them (one_process/session.hpp).

The first process of a family is the launcher, which turns into a process without a fleet. All others are copies: of the
first process, with a new fleet, or of another one, with its fleet in its present state. A process ends when its socket
is closed at this end, which happens in whatever way this program ends.
"""

from __future__ import annotations

import contextlib
import fcntl
import io
import json
import mmap
import os
import shutil
import signal
import socket
import struct
import subprocess
import weakref
from typing import Any

import numpy as np

from ..errors import Error, InputError, ProcessError
from ..launch import Finished, find_launcher
from .observations import Field

_LONGEST_ANSWER = 1 << 20
_MOST_LINES = 20
_FRAME = "  at "  # prefix of the stack addresses that a crash prints (process/health/crash_notes.hpp)
_FIRST_SESSION = 64  # lowest descriptor: a checkout's launcher starts as a shell script, and shells use those below 10
_LOOK_S = 1  # interval between checks of a process that does not answer
_PATIENCE_S = 30.0  # timeout for a process that was told to end

_all: weakref.WeakSet[_Process] = weakref.WeakSet()


def _forget_all() -> None:
    """In a copy of this program (os.fork): closes its copies of the sockets, so that the fleets end with the parent."""
    for process in list(_all):
        process.let_go()


os.register_at_fork(after_in_child=_forget_all)


def _memory_file(name: str) -> io.FileIO:
    return io.FileIO(os.memfd_create(name, os.MFD_CLOEXEC), "r+")


def _content(file: io.FileIO) -> bytes:
    size = os.fstat(file.fileno()).st_size
    return os.pread(file.fileno(), size, 0)


class _Process:
    """This program's end of the socket of a fleet's process, and the output of that process.

    Ctrl-C may interrupt each method at any instruction. At any time, one of these holds: this end is closed, no reply
    is due, or the reply to begin_steps() is due and its caller will wait for it. So a caller that is interrupted
    between a message and its reply closes this end. The socket itself is the only record of whether this end is
    closed, so an interrupted let_go() leaves it closed or open, and a further call completes it.
    """

    def __init__(self, ours: socket.socket, log: io.FileIO) -> None:
        self._socket = ours
        self._log = log
        self._owner = os.getpid()
        self.pid = 0
        self.patience_s = 60.0  # timeout of a step, with the launcher's default
        # A timeout by the kernel: a timeout by Python calls poll(2) before each call, two more system calls per step.
        ours.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, struct.pack("@ll", int(_LOOK_S), 0))
        _all.add(self)

    @property
    def closed(self) -> bool:
        return self._socket.fileno() < 0

    def let_go(self) -> None:
        """Closes this end of the socket; the process at the other end then ends. May be called again, and completes
        what an interrupted call has left."""
        self._socket.close()
        self._log.close()

    def __del__(self) -> None:
        self.let_go()

    def _open(self) -> socket.socket:
        if self.closed:
            if os.getpid() != self._owner:
                raise InputError("this Python program is a copy (os.fork, multiprocessing), and the fleet is that of "
                                 "the one that it was copied from: make a fleet here")
            raise InputError("the fleet's process has ended: call reset(), or make another fleet")
        return self._socket

    def check(self) -> None:
        """Raises InputError if the fleet's process has ended, or belongs to the parent of this program."""
        self._open()

    def said(self) -> str:
        """The last lines of the process's output."""
        lines = [line for line in _content(self._log).decode(errors="replace").strip().splitlines()
                 if not line.startswith(_FRAME)]
        return "\n".join(lines[-_MOST_LINES:])

    def send(self, text: str, files: tuple[int, ...] = ()) -> None:
        ours = self._open()
        try:
            socket.send_fds(ours, [text.encode()], list(files)) if files else ours.send(text.encode())
        except OSError:
            raise self._failure(self._last_words()) from None

    def receive(self) -> bytes:
        """Waits for the reply. If the wait is interrupted (Ctrl-C), the fleet ends. Raises ProcessError if the process
        has failed."""
        ours = self._open()
        try:
            answer = self._wait_for(ours)
        except OSError:
            answer = b""
        except BaseException:
            self.let_go()
            raise
        if not answer or answer[:1] in b"\n{":
            told = json.loads(answer) if answer.strip() else {}
            if not answer or "failed" in told or "fatal" in told:
                raise self._failure(told)
        return answer

    def exchange(self, text: str, files: tuple[int, ...] = ()) -> bytes:
        """Sends a message and waits for the reply. An interrupt in between (Ctrl-C) ends the fleet: otherwise this
        reply would count as the reply to the next message."""
        try:
            self.send(text, files)
            return self.receive()
        except BaseException:
            self.let_go()
            raise

    def _wait_for(self, ours: socket.socket) -> bytes:
        stopped_s = 0.0
        while True:
            try:
                return ours.recv(_LONGEST_ANSWER)
            except BlockingIOError:
                stopped_s = stopped_s + _LOOK_S if self._is_stopped() else 0.0
                if stopped_s > 1.5 * self.patience_s > 0.0:  # only a stopped process misses its own timeout
                    raise self._failure({"failed": "is stopped (SIGSTOP), and does not go on"}) from None

    def _is_stopped(self) -> bool:
        try:
            with open(f"/proc/{self.pid}/stat", encoding="utf-8") as file:
                return file.read().rpartition(")")[2].split()[0] == "T"
        except OSError:
            return False

    def _last_words(self) -> dict[str, Any]:
        with contextlib.suppress(OSError, ValueError):
            words = json.loads(self._socket.recv(_LONGEST_ANSWER, socket.MSG_DONTWAIT) or b"{}")
            return words if isinstance(words, dict) else {}
        return {}

    def _failure(self, told: dict[str, Any]) -> Error:
        """The exception for a process that has ended or failed. Kills the process if it is stopped."""
        who = told.get("ended") or told.get("program") or "the fleet's process"
        number = int(told.get("signal", 0))
        if number:
            how = f"ended by signal {number} ({signal.strsignal(number) or 'unknown'})"
        elif told.get("code"):
            how = f"ended with exit code {told['code']}"
        else:
            how = str(told.get("failed", "ended without a word (killed, or out of memory?)"))
        said = self.said()
        if self._is_stopped():
            with contextlib.suppress(OSError):
                os.kill(self.pid, signal.SIGKILL)
        self.let_go()
        return ProcessError(f"{who} {how}" + (f"; the end of what was printed:\n{said}" if said else ""), 3)

    def hello(self) -> dict[str, Any]:
        told: dict[str, Any] = json.loads(self.receive())
        self.pid = int(told["pid"])
        return told


class Family:
    """The processes of fleets with the same arguments. It owns the first one, which is copied for each new fleet."""

    def __init__(self, words: list[str], launcher: str | os.PathLike[str] | None, patience_s: Any = None) -> None:
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        log = _memory_file("skein-fleet-log")
        session = fcntl.fcntl(theirs, fcntl.F_DUPFD_CLOEXEC, _FIRST_SESSION)
        theirs.close()
        command = [find_launcher(launcher), *words, f"--session={session}"]
        # If this program dies while the launcher still prepares, the kernel ends the launcher. Later the process itself
        # ends when its socket is closed.
        if setpriv := shutil.which("setpriv"):
            command = [setpriv, "--pdeathsig", "TERM", "--", *command]
        self._root = _Process(ours, log)
        with contextlib.suppress(TypeError, ValueError):  # the launcher reports an invalid value
            self._root.patience_s = float(patience_s)
        try:
            child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                     pass_fds=(session,), start_new_session=True)
        except (OSError, ValueError) as error:
            self._root.let_go()
            raise InputError(f"the launcher cannot be started: {error}") from error
        finally:
            os.close(session)
        self._end = weakref.finalize(self, _end, self._root, child)
        try:
            self.about: dict[str, Any] = self._greet(child)["about"]
        except BaseException:
            self.close()
            raise

    def _greet(self, child: subprocess.Popen[bytes]) -> dict[str, Any]:
        with io.FileIO(os.dup(self._root._log.fileno())) as log:
            try:
                return self._root.hello()
            except ProcessError as error:  # the launcher refused
                finished = Finished("", _content(log).decode(errors="replace"), child.wait(_PATIENCE_S))
                raise finished.error() or error from None

    @property
    def closed(self) -> bool:
        """Whether the first process has ended or was closed after an interrupt, so that a new family must replace this
        one. Always False in a copy of the interpreter, which cannot replace its parent's family."""
        return self._root.closed and os.getpid() == self._root._owner

    def close(self) -> None:
        self._end()

    def worker(self, seed: int) -> Worker:
        """A process with a new fleet."""
        return Worker(self, self._root, {"do": "reset", "seed": seed})


def _end(root: _Process, child: subprocess.Popen[bytes]) -> None:
    """Ends the first process of a family. The processes with fleets go on until they are closed themselves."""
    if root.closed and os.getpid() != root._owner:
        return
    root.let_go()
    try:
        child.wait(0.0 if child.poll() is not None else 1.0)
    except subprocess.TimeoutExpired:  # the launcher was still preparing
        with contextlib.suppress(ProcessLookupError):
            os.killpg(child.pid, signal.SIGTERM)
        try:
            child.wait(_PATIENCE_S)
        except subprocess.TimeoutExpired:
            child.kill()
            child.wait()


class Worker(_Process):
    """The process of one fleet, and the memory block that it shares with this program."""

    def __init__(self, family: Family, original: _Process, order: dict[str, Any],
                 fields: list[Field] | None = None) -> None:
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        log = _memory_file("skein-fleet-log")
        super().__init__(ours, log)
        self.patience_s = original.patience_s
        block = _memory_file("skein-fleet")
        try:
            original.exchange(json.dumps(order), (theirs.fileno(), block.fileno(), log.fileno()))
            theirs.close()
            told = self.hello()
            self.block = mmap.mmap(block.fileno(), int(told["bytes"]))
        except BaseException:
            self.let_go()
            raise
        finally:
            theirs.close()
            block.close()
        self._family = family
        self.fields = fields or told["fields"]
        self.views: dict[str, Any] = {name: np.ndarray(shape, kind, self.block, offset)
                                      for name, kind, shape, offset in self.fields}

    def fork(self) -> Worker:
        """A copy of this process and its fleet."""
        return Worker(self._family, self, {"do": "fork"}, self.fields)

    def begin_steps(self, count: int) -> None:
        self.send(f"s {count}")

    def end_steps(self) -> bool:
        """Waits until the fleet has flown the steps. Returns whether its run has ended."""
        return self.receive() == b"e"

    def ask(self, what: str) -> Any:
        with _memory_file("skein-fleet-answer") as file:
            self.exchange(json.dumps({"do": what}), (file.fileno(),))
            return json.loads(_content(file))
