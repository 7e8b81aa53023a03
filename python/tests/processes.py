"""Finds the processes whose working folder is in a folder, and waits for their ends without a clock."""

from __future__ import annotations

import os
import select
from pathlib import Path

PATIENCE_S = 120


def processes_in(folder: Path) -> dict[int, str]:
    """Names of the processes, by id."""
    found = {}
    for entry in Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and Path(os.readlink(entry / "cwd")).is_relative_to(folder):
                found[int(entry.name)] = (entry / "comm").read_text().strip()
        except OSError:  # the process has ended, or belongs to another user
            continue
    return found


class Watch:
    """Watches the processes that exist now."""

    def __init__(self, folder: Path) -> None:
        self.names: list[str] = []
        self._descriptors: dict[int, str] = {}
        for pid, name in processes_in(folder).items():
            try:
                self._descriptors[os.pidfd_open(pid)] = name
                self.names.append(name)
            except ProcessLookupError:
                continue

    def still_there_after_waiting(self) -> list[str]:
        """Waits for the ends of all processes. Returns the names of those that do not end."""
        left = []
        for descriptor, name in self._descriptors.items():
            poll = select.poll()
            poll.register(descriptor, select.POLLIN)
            if not poll.poll(1000 * PATIENCE_S):
                left.append(name)
            os.close(descriptor)
        return left
