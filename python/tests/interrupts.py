"""Ctrl-C at a chosen bytecode instruction of the package's code."""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import sys
from collections.abc import Iterator
from typing import Any

import skein

# The functions of `socket` that the package calls are Python code, too, so an interrupt may come within them.
_SOURCES = (os.path.dirname(skein.__file__), socket.__file__)
_UNSEEN = ("__del__", "_end")  # exceptions raised in these are only printed


class Interrupts:
    """Raises SIGINT at a chosen instruction of the package's code."""

    def __init__(self) -> None:
        self._chosen = 0
        self.instructions = 0

    @contextlib.contextmanager
    def at_instruction(self, number: int) -> Iterator[None]:
        """Raises SIGINT at the `number`-th instruction that is executed within the context (0: never). Counts the
        instructions."""
        self._chosen, self.instructions = number, 0
        sys.settrace(self._trace)
        try:
            yield
        finally:
            sys.settrace(None)

    def _trace(self, frame: Any, event: str, argument: Any) -> Any:
        if not frame.f_code.co_filename.startswith(_SOURCES) or frame.f_code.co_name in _UNSEEN:
            return None
        frame.f_trace_opcodes = True
        if event == "opcode":
            self.instructions += 1
            if self.instructions == self._chosen:
                sys.settrace(None)
                signal.raise_signal(signal.SIGINT)
        return self._trace
