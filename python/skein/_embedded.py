"""For agents only: the Python part of the support for planners in Python (the C++ part is in uav_agent/python).

Each planner has its own module objects, of its file and of the modules that it imports from beside that file. UAVs in
one process share none of them.
"""

from __future__ import annotations

import dataclasses
import difflib
import hashlib
import importlib.util
import inspect
import io
import linecache
import os
import random
import sys
import traceback
import types
import typing
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .planner import FlightConfig, Planner

#: Folders of installed packages. A virtual environment below the planner's folder may contain them.
_OTHERS = ("site-packages", "dist-packages")


def _open_streams() -> None:
    """Opens sys.stdout and sys.stderr if Python considers them closed. It does if all agents share one process, because
    C's streams then write to the log of the calling thread and have no descriptors. Planners in Python run one at a
    time, and while one runs, descriptors 1 and 2 lead to its log."""
    for descriptor, name in ((1, "stdout"), (2, "stderr")):
        if getattr(sys, name) is not None:
            continue
        raw = io.FileIO(descriptor, "w", closefd=False)
        stream = io.TextIOWrapper(raw, encoding="utf-8", errors="backslashreplace", write_through=True)
        setattr(sys, name, stream)
        setattr(sys, f"__{name}__", stream)


_open_streams()


class Wrong(Exception):
    """The user's input is wrong. The text says what would be right."""


# ---- loading -----------------------------------------------------------------------------------------------------


def load(file: str, class_name: str) -> type[Planner]:
    """Loads the planner in a file. sys.path must begin with the file's folder. Exceptions other than Wrong come from
    the user's code."""
    name = Path(file).stem
    if not name.isidentifier() or name in sys.modules:
        name = f"planner_{name}"
    spec = importlib.util.spec_from_file_location(name, file)
    if spec is None or spec.loader is None:
        raise Wrong(f"{file}: is not a file of Python; its name must end with .py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return _chosen(module, file, class_name)


def _chosen(module: types.ModuleType, file: str, class_name: str) -> type[Planner]:
    planners = {name: value for name, value in vars(module).items()
                if inspect.isclass(value) and issubclass(value, Planner) and value.__module__ == module.__name__
                and not inspect.isabstract(value)}
    if class_name:
        value = getattr(module, class_name, None)
        if inspect.isclass(value) and issubclass(value, Planner) and value is not Planner:
            return value
        if value is not None:
            raise Wrong(f"{file}: {class_name} is not a planner: it must be a class derived from skein.planner.Planner")
        near = difflib.get_close_matches(class_name, planners, 1)
        raise Wrong(f"{file}: there is no class '{class_name}' in it; "
                    + (f"did you mean '{near[0]}'?" if near else _known(planners)))
    if len(planners) == 1:
        return next(iter(planners.values()))
    if planners:
        raise Wrong(f"{file}: which of its planners? Write py:FILE:CLASS with one of {', '.join(planners)}")
    raise Wrong(f"{file}: there is no planner in it: a class derived from skein.planner.Planner")


def _known(planners: dict[str, type[Planner]]) -> str:
    return f"its planners are {', '.join(planners)}" if planners else "it has no planner at all"


_KINDS: dict[Any, str] = {bool: "bool", int: "int", float: "float", str: "str"}


def _kind_of(owner: str, name: str, declared: Any) -> tuple[str, bool]:
    """Kind of a parameter, and whether it may be None."""
    arguments = typing.get_args(declared)
    if type(None) in arguments:
        others = [argument for argument in arguments if argument is not type(None)]
        if len(others) == 1:
            return _kind_of(owner, name, others[0])[0], True
    if declared in _KINDS:
        return _KINDS[declared], False
    element = arguments[0] if arguments and typing.get_origin(declared) in (list, tuple) else None
    if element in _KINDS and element is not bool and (len(arguments) == 1 or arguments[1:] == (...,)):
        return _KINDS[element] + "s", False
    raise Wrong(f"{owner}.{name}: a parameter is bool, int, float, str, list[float], list[int] or list[str], or one of "
                f"these or None, and not {declared}")


def parameters(planner: type[Planner]) -> list[tuple[str, str, bool, bool, float, float]]:
    """The fields of the planner's Config: name, kind ("flight": a FlightConfig), whether it may be None, whether it is
    required, least and greatest value."""
    config = planner.Config
    owner = f"{planner.__name__}.Config"
    if not dataclasses.is_dataclass(config):
        raise Wrong(f"{owner} must be a dataclass: write @dataclass before it")
    hints = typing.get_type_hints(config, vars(sys.modules[config.__module__]) | vars(planner))
    found = []
    for field in dataclasses.fields(config):
        if not field.init:
            continue
        required = field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
        if hints[field.name] is FlightConfig:
            found.append((field.name, "flight", False, False, 0.0, 0.0))
            continue
        kind, optional = _kind_of(owner, field.name, hints[field.name])
        found.append((field.name, kind, optional, required, float(field.metadata.get("at_least", -np.inf)),
                      float(field.metadata.get("at_most", np.inf))))
    return found


def construct(planner: type[Planner], values: dict[str, Any], agent: Any) -> Planner:
    """Constructs the planner. Its constructor may take nothing, (config), or (config, agent)."""
    config = planner.Config(**values)
    wanted = [parameter for parameter in inspect.signature(planner).parameters.values()
              if parameter.default is parameter.empty
              and parameter.kind in (parameter.POSITIONAL_ONLY, parameter.POSITIONAL_OR_KEYWORD)]
    if len(wanted) > 2:
        raise Wrong(f"{planner.__name__}.__init__ takes {len(wanted)} arguments; it may take none, (config), or "
                    "(config, agent)")
    return typing.cast(Callable[..., Planner], planner)(*(config, agent)[:len(wanted)])


# ---- what belongs to one UAV -------------------------------------------------------------------------------------


def own_modules(folder: str) -> list[str]:
    """Names of the loaded modules whose files are in a planner's folder, except installed packages."""
    found = []
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if not file or name.partition(".")[0] == "skein" or name == "__main__":
            continue
        path = os.path.abspath(file)
        if path.startswith(folder + os.sep) and not any(f"{os.sep}{other}{os.sep}" in path for other in _OTHERS):
            found.append(name)
    return found


def seed(number: int, uav: str) -> None:
    """Seeds the global generators of `random` and NumPy from the run's seed and the UAV's name."""
    digest = hashlib.sha256(f"planner {number} {uav}".encode()).digest()
    random.seed(int.from_bytes(digest, "little"))
    np.random.seed(np.frombuffer(digest, dtype="<u4"))


# ---- exceptions and debuggers ------------------------------------------------------------------------------------


def explain(error: BaseException, frames: types.TracebackType | None) -> str:
    """The traceback as text that UTF-8 can encode, without this package's frames before the first frame of the user's
    code."""
    while frames is not None and _is_ours(frames.tb_frame.f_code.co_filename) and frames.tb_next is not None:
        frames = frames.tb_next
    linecache.checkcache()
    text = "".join(traceback.format_exception(type(error), error, frames)).rstrip("\n")
    return text.encode(errors="backslashreplace").decode()  # a message may hold half of a surrogate pair


def _is_ours(file: str) -> bool:
    return file.startswith("<frozen") or os.path.dirname(file) == os.path.dirname(__file__)


def _refuse_breakpoint(*_: Any, **__: Any) -> None:
    raise RuntimeError("breakpoint() has no terminal here: fly with --debug UAV=pdb")


def _audit(event: str, _: tuple[Any, ...]) -> None:
    if event in ("os.fork", "os.forkpty"):
        raise RuntimeError(f"{event}() in a planner would fork the agent, and a fork of it belongs to no fleet; "
                           "subprocess starts other programs")


def prepare() -> None:
    """Prepares the interpreter for planners. Call it once."""
    sys.dont_write_bytecode = True
    sys.breakpointhook = _refuse_breakpoint
    sys.addaudithook(_audit)
    sys.path.insert(0, "")


class Debugger:
    """Runs the calls of one planner under pdb, in this terminal. `from_s`: simulated time of the first stop [s]."""

    def __init__(self, from_s: float) -> None:
        import pdb
        self._pdb = pdb.Pdb(nosigint=True, stdin=sys.__stdin__, stdout=sys.__stdout__)
        self._pdb.prompt = "(pdb) "
        self._from_s = from_s
        self._begun = False
        sys.breakpointhook = self._stop

    def _stop(self, *_: Any, **__: Any) -> None:
        self._pdb.set_trace(sys._getframe(1))

    def call(self, plan: Callable[[Any], Any], inputs: Any) -> Any:
        try:
            if not self._begun and inputs.time_s >= self._from_s:
                self._begun = True
                return self._pdb.runcall(plan, inputs)
            return plan(inputs)
        except Exception:
            import bdb
            error = sys.exc_info()
            if not issubclass(typing.cast(type, error[0]), bdb.BdbQuit):
                self._pdb.message("".join(traceback.format_exception(*error)))
                self._pdb.interaction(None, error[2])
            raise


def generators() -> tuple[Any, Any]:
    """The internal objects of the global generators: that of `random`, and NumPy's legacy generator."""
    return random._inst, np.random.mtrand._rand


def names_of(values: Sequence[Any]) -> list[str]:
    """Checks the result of `debug_names()`: a sequence of texts. Otherwise raises Wrong."""
    if isinstance(values, str) or not all(isinstance(value, str) for value in values):
        raise Wrong(f"debug_names() must return a sequence of texts, not {values!r}")
    return list(values)
