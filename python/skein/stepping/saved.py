"""Writes the actions of a learner to a file that the planner `hand` flies again (core/planners/hand_file.hpp)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..errors import InputError

_COLUMNS = "step,tick,ahead,left,up,yaw_rate,gimbal_pitch_rate,gimbal_yaw_rate"
_TICK_S = 0.0025


def hand_file(uav: str, log: list[tuple[int, dict[str, Any]]], period_s: float, file: Path) -> Path:
    lines = [_COLUMNS]
    numbers = [0.0] * 6
    for step, values in log:
        if values.get("trigger") or values.get("gimbal_kind", 1) != 1:
            raise InputError(f"{uav} got an action with trigger, gimbal or look_at, which a file of the planner hand "
                             "cannot contain")
        if "velocity" in values:
            numbers[:3] = map(float, values["velocity"])
        if "yaw_rate" in values:
            numbers[3] = float(values["yaw_rate"])
        if "gimbal" in values:
            numbers[4:] = map(float, values["gimbal"][:2])
        lines.append(",".join([str(step), str(round(step * period_s / _TICK_S)), *map(repr, numbers)]))
    try:
        file.write_text("\n".join(lines) + "\n")
    except (OSError, ValueError) as error:
        raise InputError(f"{str(file)!r:.200} cannot be written: {error}") from None
    return file
