"""Finds and loads the compiled part of this package, `_skein_client`."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import os
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Protocol, cast

from ..errors import MissingError

_NAME = "_skein_client"
_INTERFACE = 1  #: as in uav_agent/client/module_node.cpp


class Member(Protocol):
    """A member of the lock-step, which receives and sends serialised messages."""

    k: int
    tick: int
    final_step: bool
    station_linked: bool
    undelivered: int
    joins: int

    def next(self) -> bool: ...
    def messages(self) -> list[tuple[str, bytes]]: ...
    def say(self, topic: str, payload: bytes) -> str: ...
    def open(self, topic: str, type: str, targets: Sequence[str]) -> None: ...
    def listen(self, topic: str, type: str) -> None: ...
    def sending(self, topic: str) -> tuple[bool, str, list[str]]: ...
    def listening(self, topic: str) -> tuple[bool, str, list[str]]: ...
    def close(self) -> None: ...


class Listener(Protocol):
    """Receives serialised messages of one DDS domain."""

    def next(self, timeout_s: float) -> tuple[str, bytes] | None: ...
    def has_writers(self) -> bool: ...
    def missed(self) -> int: ...
    def close(self) -> None: ...


class Native(Protocol):
    """The compiled module (uav_agent/client/module_node.cpp)."""

    interface: int
    WrongUse: type[Exception]
    WrongInput: type[Exception]
    Lost: type[Exception]

    def definition(self, type: str) -> str: ...
    def config(self, scenario: str, name: str) -> dict[str, Any]: ...
    def radio(self, scenario: str, name: str) -> list[tuple[str, str, bool]]: ...
    def type_of(self, topic: str, id: str) -> str: ...
    def Member(self, scenario: str, name: str, domain: int, dds: str, run: int, security: str, reads: Sequence[str],
               writes: Sequence[str], lease_s: int) -> Member: ...
    def Listener(self, domain: int, dds: str, run: int, security: str, id: str, topics: Sequence[tuple[str, str]],
                 most: int) -> Listener: ...


def _places() -> Iterator[Path]:
    """Folders that may contain the module: of a build, of an installation, of a pack."""
    if named := os.environ.get("SKEIN_BIN_DIR"):
        yield Path(named)
        yield Path(named).parent / "lib" / "skein"
    package = Path(__file__).resolve().parents[1]
    yield from (package.parents[1] / "build" / kind / "bin" for kind in ("release", "debug"))
    yield package.parents[2] / "skein"  # of /usr/lib/python3/dist-packages/skein: /usr/lib/skein
    yield package.parents[3] / "bin"    # of share/skein/python/skein


def _find_configuration() -> None:
    """Sets SKEIN_CONFIG_DIR, if unset, to the folder of scenarios and vehicles."""
    package = Path(__file__).resolve().parents[1]
    for folder in (package.parents[1] / "config",                       # of a checkout, and of a pack
                   package.parents[3] / "share" / "skein" / "config"):  # as installed
        if (folder / "scenarios").is_dir():
            os.environ.setdefault("SKEIN_CONFIG_DIR", str(folder))


def _load() -> Native:
    _find_configuration()
    for place in _places():
        file = place / f"{_NAME}.so"
        if not file.is_file():
            continue
        loader = importlib.machinery.ExtensionFileLoader(_NAME, str(file))
        spec = importlib.util.spec_from_file_location(_NAME, file, loader=loader)
        assert spec is not None
        try:
            module = importlib.util.module_from_spec(spec)
            loader.exec_module(module)
        except ImportError as error:
            raise MissingError(f"{file} cannot be loaded: {error}\nIt is made for Debian's Python 3.11; this is "
                               f"{sys.version.split()[0]}, {sys.executable}") from error
        if getattr(module, "interface", None) != _INTERFACE:
            raise MissingError(f"{file} is of another version of Skein than {Path(__file__).parent}: build it anew")
        return cast(Native, module)
    raise MissingError(f"there is no {_NAME}.so: a build of Skein makes it (./skein, or ninja skein_client), and "
                       "Debian's package python3-skein has it")


native: Native = _load()
