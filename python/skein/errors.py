"""What goes wrong, as exceptions. All of them are `skein.Error`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .run import Run
    from .study import Study


class Error(Exception):
    """Base of all exceptions of this package.

    `exit_code` is the launcher's, or None where no launcher was asked. `run` and `study` are what it left behind all
    the same, or None.
    """

    def __init__(self, message: str, exit_code: int | None = None) -> None:
        super().__init__(message)
        self.exit_code = exit_code
        self.run: Run | None = None
        self.study: Study | None = None


class InputError(Error):
    """The input is wrong (exit code 2); the message says where and what would be right. Nothing was flown."""


class CheckError(Error):
    """A check did not hold (exit code 1), a requirement of `skein.compare(require=...)` say."""


class ProcessError(Error):
    """A process failed (exit code 3). The results are complete all the same, in `run` or `study`."""


class Interrupted(Error):
    """Somebody else than this program's user ended it (exit code 130). What was flown is in `run` or `study`."""


class MissingError(Error):
    """A file is not there; the message says why, and what brings it."""


class DamagedError(Error):
    """A file does not hold what it must; the message names file and line."""


class DependencyError(Error, ImportError):
    """A package is not installed; the message names Debian's."""


def missing_package(name: str) -> DependencyError:
    """For `name`, which Debian has as python3-`name`."""
    return DependencyError(f"this needs {name}, which is not installed: apt-get install python3-{name}")
