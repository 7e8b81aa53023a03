"""The exceptions of this package. All of them derive from `skein.Error`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .run import Run
    from .study import Study


class Error(Exception):
    """Base of all exceptions of this package.

    `exit_code` is the launcher's exit code, or None if no launcher ran. `run` or `study` holds the results that the
    launcher wrote despite the error, or None.
    """

    def __init__(self, message: str, exit_code: int | None = None) -> None:
        super().__init__(message)
        self.exit_code = exit_code
        self.run: Run | None = None
        self.study: Study | None = None


class InputError(Error):
    """The input is wrong (exit code 2). The message says where, and what would be right. Nothing was flown."""


class CheckError(Error):
    """A check failed (exit code 1), for example a requirement of `skein.compare(require=...)`."""


class ProcessError(Error):
    """A process failed (exit code 3). The results are complete nevertheless, in `run` or `study`."""


class Interrupted(Error):
    """Something other than Ctrl-C in this program ended the launcher (exit code 130). The results so far are in `run`
    or `study`."""


class MissingError(Error):
    """A file is missing. The message says why, and what creates it."""


class DamagedError(Error):
    """A file or a message is damaged. Of a file, the text names file and line."""


class DependencyError(Error, ImportError):
    """A Python package is not installed. The message names the Debian package."""


def missing_package(name: str) -> DependencyError:
    """The error for a missing package `name`, whose Debian package is python3-`name`."""
    return DependencyError(f"this needs {name}, which is not installed: apt-get install python3-{name}")
