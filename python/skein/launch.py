"""Runs the launcher, `skein`, as a child process.

Keyword arguments become options of the command line: `one_process=True` is `--one-process`, `duration=60` is
`--duration=60`, a list of texts repeats the option, and a list or range of whole numbers is one value with commas.
"""

from __future__ import annotations

import codecs
import contextlib
import operator
import os
import selectors
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeVar

from .errors import CheckError, Error, InputError, Interrupted, ProcessError

_Results = TypeVar("_Results")
_EXIT_ERRORS: dict[int, type[Error]] = {1: CheckError, 2: InputError, 3: ProcessError, 130: Interrupted}
_PATIENCE_S = 30.0  # timeout for a launcher that was told to end
_MOST_LINES = 25  # most lines of the launcher's output in a message


def find_launcher(launcher: str | os.PathLike[str] | None = None) -> str:
    """Path of the launcher: `launcher`, else the environment variable SKEIN, else this checkout's `./skein`, else
    `skein` in PATH. Raises InputError if there is none."""
    named = path_text("launcher", launcher) if launcher is not None else os.environ.get("SKEIN")
    if named:
        found = shutil.which(named) if "\0" not in named else None
        if found is None:
            raise InputError(f"there is no program {named!r}" + ("" if launcher is not None else ", which SKEIN names"))
        return found
    checkout = Path(__file__).absolute().parents[2] / "skein"
    if checkout.is_file() and os.access(checkout, os.X_OK):
        return str(checkout)
    found = shutil.which("skein")
    if found is None:
        raise InputError("there is no skein in PATH: install the package skein, or set SKEIN to the launcher's path")
    return found


def path_text(name: str, value: Any) -> str:
    """A path as text. Raises InputError for a value that is no path; bytes are none either."""
    text = os.fspath(value) if isinstance(value, (str, os.PathLike)) else None
    if not isinstance(text, str):
        raise InputError(f"{name} must be a path, not {value!r:.80}")
    return text


def _is_whole(value: Any) -> bool:
    try:  # an array has __index__, too, which raises TypeError unless the array is a single whole number
        operator.index(value)
    except TypeError:
        return False
    return not isinstance(value, bool)


def _text(name: str, value: Any) -> str:
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if _is_whole(value):
        return str(operator.index(value))
    if hasattr(value, "__float__"):
        with contextlib.suppress(TypeError, ValueError, OverflowError):  # a class, or an array of several numbers
            return repr(float(value))
    raise InputError(f"{name}: an option is a text, a number, a path, True, or a list of these, not {value!r}")


def _is_flag(value: Any) -> bool:
    return isinstance(value, bool) or type(value).__name__ in ("bool_", "bool")  # NumPy has its own type


def flag(name: str, value: Any) -> bool:
    """True or False, of Python or of NumPy. Raises InputError for any other value."""
    if not _is_flag(value):
        raise InputError(f"{name} must be True or False, not {value!r:.80}")
    return bool(value)


def option_arguments(options: Mapping[str, Any]) -> list[str]:
    """Keyword arguments as words of the command line. False and None leave an option out."""
    words: list[str] = []
    for name, value in options.items():
        option = "--" + name.rstrip("_").replace("_", "-")
        if value is None or (_is_flag(value) and not value):
            continue
        if _is_flag(value):
            words.append(option)
        elif isinstance(value, Mapping):
            raise InputError(f"{name}: an option is not a dictionary; write {value!r} as on the command line")
        elif isinstance(value, Iterable) and not isinstance(value, (str, bytes)) and getattr(value, "ndim", 1) != 0:
            items = list(value)
            if items and all(_is_whole(item) for item in items):
                words.append(f"{option}={','.join(_text(name, item) for item in items)}")
            else:
                words.extend(f"{option}={_text(name, item)}" for item in items)
        else:
            words.append(f"{option}={_text(name, value)}")
    return words


def positional(name: str, value: str | os.PathLike[str]) -> str:
    """A positional argument as a word of the command line. Raises InputError if it would count as an option."""
    text = os.fspath(value) if isinstance(value, (str, os.PathLike)) else None
    if not isinstance(text, str) or not text or text.startswith("-"):
        raise InputError(f"{name} must be a name or a path, not {value!r:.80}; options are keywords of this function")
    return text


class Finished:
    """Output and exit code of a launcher that has ended."""

    def __init__(self, out: str, err: str, code: int) -> None:
        self.out, self.err, self.code = out, err, code

    def error(self) -> Error | None:
        """The exception that the exit code stands for; None: success."""
        if self.code == 0:
            return None
        lines = [line for line in self.err.splitlines() if line and not line.startswith("simulated ")]
        message = "\n".join(lines[-_MOST_LINES:]) or f"the launcher ended with exit code {self.code} and said nothing"
        if self.code < 0:
            message = f"the launcher was killed by signal {-self.code}\n{message}"
        return _EXIT_ERRORS.get(self.code, Error)(message, self.code)


def call(words: list[str], folder_of: Callable[[Finished], Path | None], *,
         launcher: str | os.PathLike[str] | None = None, verbose: bool = False) -> Finished:
    """Runs the launcher to its end. `verbose`: its output goes to sys.stdout and sys.stderr during the run, too.
    `folder_of` finds the results folder in its output.

    Ctrl-C goes to the launcher, which ends the fleet at its next step and writes the result; then KeyboardInterrupt is
    raised here. A second Ctrl-C ends it at once, a third kills it. If this program dies, the launcher gets SIGTERM.
    """
    verbose = flag("verbose", verbose)
    command = [find_launcher(launcher), *words]
    # The kernel sends this signal even if this program is killed. preexec_fn, which runs between fork and exec, could
    # request the same, but is not safe if the program has other threads.
    if setpriv := shutil.which("setpriv"):
        command = [setpriv, "--pdeathsig", "TERM", "--", *command]
    with _passing_on_interrupts() as interrupts:
        try:
            # The launcher has a session of its own, so that a terminal's Ctrl-C reaches only this program, which passes
            # it on. In one process group, the launcher would get two signals from a terminal, but one from a notebook.
            child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                     start_new_session=True)
        except (OSError, ValueError) as error:  # it cannot be executed; a word contains NUL
            raise InputError(f"the launcher cannot be started: {error}") from error
        interrupts.to(child)
        try:
            out, err = _read_both(child, verbose)
            code = child.wait()
        finally:
            _end(child)
    finished = Finished(out, err, code)
    if interrupts.count:
        folder = folder_of(finished)
        raise KeyboardInterrupt("interrupted" + (f"; what was flown until then is in {folder}" if folder else ""))
    return finished


def _read_both(child: subprocess.Popen[bytes], verbose: bool) -> tuple[str, str]:
    assert child.stdout is not None and child.stderr is not None
    said: dict[int, bytearray] = {child.stdout.fileno(): bytearray(), child.stderr.fileno(): bytearray()}
    sinks = {child.stdout.fileno(): sys.stdout, child.stderr.fileno(): sys.stderr}
    # Incremental, because a read may end in the middle of a character.
    decoders = {descriptor: codecs.getincrementaldecoder("utf-8")(errors="replace") for descriptor in said}
    with selectors.DefaultSelector() as selector:
        for descriptor in said:
            selector.register(descriptor, selectors.EVENT_READ)
        while selector.get_map():
            for key, _ in selector.select():
                data = os.read(key.fd, 1 << 16)
                said[key.fd] += data
                if verbose:
                    sinks[key.fd].write(decoders[key.fd].decode(data, final=not data))
                    sinks[key.fd].flush()
                if not data:
                    selector.unregister(key.fd)
    out, err = (bytes(text).decode(errors="replace") for text in said.values())
    return out, err


def _signal_group(child: subprocess.Popen[bytes], number: int) -> None:
    if child.poll() is None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(child.pid, number)


class _Interrupts:
    """Passes Ctrl-C on to a child process. A Ctrl-C from before the child's start is passed on after it."""

    def __init__(self) -> None:
        self.count = 0
        self._child: subprocess.Popen[bytes] | None = None

    def to(self, child: subprocess.Popen[bytes]) -> None:
        self._child = child
        if self.count:
            _signal_group(child, signal.SIGINT)

    def pass_on(self, _number: int, _frame: object) -> None:
        self.count += 1
        if self._child is not None:
            _signal_group(self._child, signal.SIGINT if self.count < 3 else signal.SIGKILL)


@contextlib.contextmanager
def _passing_on_interrupts() -> Iterator[_Interrupts]:
    """A context in which Ctrl-C goes to the child. If the user has installed another handler, that one stays."""
    interrupts = _Interrupts()
    ours = (threading.current_thread() is threading.main_thread()
            and signal.getsignal(signal.SIGINT) is signal.default_int_handler)
    if ours:
        signal.signal(signal.SIGINT, interrupts.pass_on)
    try:
        yield interrupts
    finally:
        if ours:
            signal.signal(signal.SIGINT, signal.default_int_handler)


def _end(child: subprocess.Popen[bytes]) -> None:
    """Closes the pipes. After an exception in this program it also ends the launcher, and so the fleet."""
    if child.poll() is None:
        _signal_group(child, signal.SIGINT)
        try:
            child.wait(_PATIENCE_S)
        except subprocess.TimeoutExpired:
            _signal_group(child, signal.SIGKILL)
            child.wait()
    for pipe in (child.stdout, child.stderr):
        if pipe is not None:
            pipe.close()


def fly(words: list[str], folder_of: Callable[[Finished], Path | None], results: Callable[[Path], _Results], name: str,
        *, launcher: str | os.PathLike[str] | None = None, verbose: bool = False) -> _Results:
    """Runs the launcher to its end, as `call` does, and returns its results: `results(folder)`. If the exit code is an
    error, the exception has the results as its attribute `name`."""
    finished = call(words, folder_of, launcher=launcher, verbose=verbose)
    folder, error = folder_of(finished), finished.error()
    left = results(folder) if folder is not None else None
    if error is not None:
        setattr(error, name, left)
        raise error
    if left is None:  # success without a flight, for example `help=True`
        raise Error("the launcher named no results folder; it said:\n" + (finished.out + finished.err).strip(), 0)
    return left
